// A runtime of OpenXR that stands before another (the simulated one, or the machine's own) and does it harm: calls
// fail, lie, or are noted down.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/simulated_runtime.h"

#define SEASCAPE_XR_ALL(apply)                                                                                        \
  apply(EnumerateInstanceExtensionProperties) apply(CreateInstance) SEASCAPE_XR_CORE(apply) SEASCAPE_XR_VULKAN(apply) \
      SEASCAPE_XR_OPTIONAL(apply)

namespace seascape::test {

// OpenXR's calls carry no pointer of ours, so there is one at a time in a process.
class HostileRuntime {
 public:
  explicit HostileRuntime(PFN_xrGetInstanceProcAddr behind);
  explicit HostileRuntime(SimulatedRuntime& behind) : HostileRuntime(behind.get()) {}
  ~HostileRuntime();
  HostileRuntime(const HostileRuntime&) = delete;
  HostileRuntime& operator=(const HostileRuntime&) = delete;
  PFN_xrGetInstanceProcAddr get() const;

  XrApi real;  // of the runtime behind, as far as they were asked for
  struct Instead {
#define SEASCAPE_XR_INSTEAD(name) std::function<std::remove_pointer_t<PFN_xr##name>> name;
    SEASCAPE_XR_ALL(SEASCAPE_XR_INSTEAD)
#undef SEASCAPE_XR_INSTEAD
  } instead;  // what is called instead; empty: the runtime behind

  // The call of this name ("xrWaitFrame") fails at its `nth` time (from 1), without having done anything; what destroys
  // does so all the same.
  void fail(const std::string& name, int nth, XrResult result);
  // From then on all calls do, as those of an instance that is lost.
  void fail_from(const std::string& name, int nth, XrResult result);
  void lack(const std::string& name) { lacking_ = name; }  // there is no such call
  const std::string& lacking() const { return lacking_; }
  bool has_failed() const { return has_failed_; }

  const std::vector<std::string>& calls() const { return calls_; }  // by name, in order
  static std::vector<std::string> names();

  std::optional<XrResult> before(const std::string& name);  // notes the call; what it fails with

 private:
  std::vector<std::string> calls_;
  std::map<std::string, int> counts_;
  std::string failing_, lacking_;
  int failing_at_ = 0;
  XrResult result_ = XR_SUCCESS;
  bool has_failed_ = false, for_good_ = false;
};

}  // namespace seascape::test
