// `seascape doctor`: devices, drivers, displays and the headset runtime, what is missing and how to get it.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/program.h"
#include "app/quality.h"
#include "engine/error.h"
#include "engine/multiview_check.h"

namespace seascape {

namespace {

struct Finding {
  std::string what, state, remedy;  // remedy empty: nothing to do
  bool fault = false;               // the program cannot draw without it
};

bool exists(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

}  // namespace

int run_doctor(const Arguments& arguments) {
  std::vector<Finding> findings;
  nlohmann::json json;
  try {
    Device device(device_options());
    ShaderLibrary shaders{ShaderLibrary::default_directory(), DiskCache::of_user()};
    const DeviceFacts& f = device.facts();
    const bool multiview = multiview_works(device, shaders);
    findings.push_back({"device", fmt::format("{} ({})", f.name, f.kind), "", false});
    findings.push_back({"driver", fmt::format("{}, Vulkan {}", f.driver, f.api_version),
                        f.software ? "a hardware GPU's driver is many times faster" : "", false});
    findings.push_back(
        {"stereo in one pass", multiview ? "works" : "the driver draws it wrongly; a pass per eye is used instead",
         multiview ? "" : "install mesa-vulkan-drivers from bookworm-backports, or use ./run, which fetches it",
         false});
    findings.push_back({"multisampling", fmt::format("up to {} samples", f.max_samples), "", false});
    findings.push_back({"anisotropic filtering",
                        f.max_anisotropy > 1 ? fmt::format("up to {:.0f}", f.max_anisotropy) : "none", "", false});
    findings.push_back({"32-bit tiles",
                        f.float32_linear ? "can be filtered" : "cannot be filtered; 16-bit tiles are used", "", false});
    json["device"] = {{"name", f.name},
                      {"kind", f.kind},
                      {"driver", f.driver},
                      {"api", f.api_version},
                      {"software", f.software},
                      {"multiview", multiview},
                      {"max_samples", f.max_samples},
                      {"max_anisotropy", f.max_anisotropy},
                      {"float32_linear", f.float32_linear},
                      {"timestamps", f.timestamps}};
  } catch (const Error& error) {
    findings.push_back({"device", error.fault(), error.remedy(), true});
    json["device"] = nullptr;
  }
  const bool window = exists("DISPLAY") || exists("WAYLAND_DISPLAY");
  findings.push_back({"display", window ? "a desktop answers" : "none (DISPLAY and WAYLAND_DISPLAY are unset)",
                      window ? "" : "explore needs a desktop; replay and capture do not", false});
  const char* runtime = std::getenv("XR_RUNTIME_JSON");
  const bool headset = (runtime && std::filesystem::exists(runtime)) ||
                       std::filesystem::exists("/etc/xdg/openxr/1/active_runtime.json") ||
                       std::filesystem::exists("/usr/share/openxr/1/active_runtime.json");
  findings.push_back(
      {"headset runtime",
       headset ? "an OpenXR runtime is set up, but this version of seascape does not use headsets yet" : "none found",
       "", false});
  const bool content = std::filesystem::exists(content_directory() / "scenes");
  findings.push_back({"content",
                      content ? content_directory().string() : "not found at " + content_directory().string(),
                      content ? "" : "set SEASCAPE_CONTENT to the folder content/ of the checkout", !content});

  const DiskCache cache = DiskCache::of_user();
  findings.push_back({"cache",
                      cache.folder().empty()
                          ? "none: shaders are prepared anew at each start"
                          : fmt::format("{} (SEASCAPE_CACHE=off does without)", cache.folder().string()),
                      "", false});

  bool fault = false;
  json["findings"] = nlohmann::json::array();
  for (const Finding& f : findings) {
    fault = fault || f.fault;
    json["findings"].push_back({{"what", f.what}, {"state", f.state}, {"remedy", f.remedy}, {"fault", f.fault}});
    if (!arguments.json)
      fmt::print("{:<22} {}{}{}\n", f.what, f.state, f.remedy.empty() ? "" : "\n                       -> ", f.remedy);
  }
  json["ok"] = !fault;
  if (arguments.json) fmt::print("{}\n", json.dump(2));
  return fault ? 1 : 0;
}

}  // namespace seascape
