#include "tests/support/gpu/hostile_runtime.h"

#include <cassert>
#include <cstring>
#include <string_view>

namespace seascape::test {

namespace {

HostileRuntime* current = nullptr;

#define SEASCAPE_XR_NAME(name) constexpr char name_of_##name[] = "xr" #name;
SEASCAPE_XR_ALL(SEASCAPE_XR_NAME)
#undef SEASCAPE_XR_NAME

template <auto real, auto instead, const char* name, class... Arguments>
XRAPI_ATTR XrResult XRAPI_CALL stand_in(Arguments... arguments) {
  HostileRuntime& runtime = *current;
  const std::optional<XrResult> fault = runtime.before(name);
  if (fault && !std::string_view(name).starts_with("xrDestroy")) return *fault;
  const auto& other = runtime.instead.*instead;
  const XrResult result = other ? other(arguments...) : (runtime.real.*real)(arguments...);
  return fault.value_or(result);
}

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function);

}  // namespace

HostileRuntime::HostileRuntime(PFN_xrGetInstanceProcAddr behind) {
  assert(current == nullptr);
  current = this;
  real.GetInstanceProcAddr = behind;
}

HostileRuntime::~HostileRuntime() { current = nullptr; }

PFN_xrGetInstanceProcAddr HostileRuntime::get() const { return get_instance_proc_addr; }

void HostileRuntime::fail(const std::string& name, int nth, XrResult result) {
  failing_ = name;
  failing_at_ = nth;
  result_ = result;
}

void HostileRuntime::fail_from(const std::string& name, int nth, XrResult result) {
  fail(name, nth, result);
  for_good_ = true;
}

std::vector<std::string> HostileRuntime::names() {
  return {
#define SEASCAPE_XR_LISTED(name) "xr" #name,
      SEASCAPE_XR_ALL(SEASCAPE_XR_LISTED)
#undef SEASCAPE_XR_LISTED
  };
}

std::optional<XrResult> HostileRuntime::before(const std::string& name) {
  calls_.push_back(name);
  const bool now = ++counts_[name] == failing_at_ && name == failing_;
  has_failed_ = has_failed_ || now;
  return now || (for_good_ && has_failed_) ? std::optional(result_) : std::nullopt;
}

namespace {

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function) {
  if (name == current->lacking()) return XR_ERROR_FUNCTION_UNSUPPORTED;
  const XrResult result = current->real.GetInstanceProcAddr(instance, name, function);
  if (XR_FAILED(result)) return result;
#define SEASCAPE_XR_STAND_IN(call)                                                                     \
  if (std::strcmp(name, name_of_##call) == 0) {                                                        \
    current->real.call = reinterpret_cast<PFN_xr##call>(*function);                                    \
    const PFN_xr##call found = stand_in<&XrApi::call, &HostileRuntime::Instead::call, name_of_##call>; \
    *function = reinterpret_cast<PFN_xrVoidFunction>(found);                                           \
  }
  SEASCAPE_XR_ALL(SEASCAPE_XR_STAND_IN)
#undef SEASCAPE_XR_STAND_IN
  return result;
}

}  // namespace

}  // namespace seascape::test
