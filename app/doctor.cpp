// `seascape doctor`: devices, drivers, displays and the headset runtime, what is missing and how to get it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/calibrate.h"
#include "app/commands.h"
#include "app/program.h"
#include "app/quality.h"
#include "engine/error.h"
#include "engine/multiview_check.h"
#include "platform/headset_system.h"

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

// What a headset's runtime says of itself, or why there is none.
void look_at_headset(std::vector<Finding>& findings, nlohmann::json& json) {
  json["headset"] = nullptr;
  try {
    const XrLoader loader;
    HeadsetSystem system(loader.get());
    DeviceOptions options = device_options();
    system.make_device(options);
    const std::vector<float> rates_hz = headset_rates(system, Device(options));
    const HeadsetFacts& f = system.facts();
    findings.push_back({"headset runtime", fmt::format("{} {}", f.runtime, f.runtime_version), "", false});
    findings.push_back({"headset",
                        fmt::format("{}: {} views, {}x{} pixels an eye recommended, {}x{} at most", f.headset, f.views,
                                    f.width, f.height, f.most_width, f.most_height),
                        "", false});
    findings.push_back({"headset rates",
                        rates_hz.empty() ? "its own, which it does not say"
                                         : fmt::format("{:g} pictures a second", fmt::join(rates_hz, ", ")),
                        "", false});
    std::vector<std::string> used, missing;
    for (const std::string_view name : headset_extensions()) (f.has(name) ? used : missing).emplace_back(name);
    findings.push_back({"headset extensions", fmt::format("{}", fmt::join(used, " ")), "", false});
    if (!missing.empty())
      findings.push_back({"", fmt::format("not offered, and done without: {}", fmt::join(missing, " ")), "", false});
    json["headset"] = {{"runtime", f.runtime},       {"version", f.runtime_version},
                       {"name", f.headset},          {"views", f.views},
                       {"width", f.width},           {"height", f.height},
                       {"most_width", f.most_width}, {"most_height", f.most_height},
                       {"rates_hz", rates_hz},       {"extensions", f.extensions},
                       {"extensions_used", used}};
  } catch (const Error& error) {
    findings.push_back({"headset", error.where() + ": " + error.fault(), error.remedy(), false});
  }
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
    const DisplayGoal window{1280, 720, 1, 60.0};
    const Calibration known = arguments.calibrate ? calibrated_anew(device, shaders, window)
                                                  : remembered(DiskCache::of_user(), calibrated_device(f));
    findings.push_back({"quality",
                        "auto takes " + std::string(resolve_preset("auto", device_class(f))) +
                            ", and before a window or a headset what fits its rate: " + calibration_text(known),
                        arguments.calibrate ? "" : "seascape doctor --calibrate measures all presets anew", false});
    json["device"] = {{"name", f.name},
                      {"kind", f.kind},
                      {"driver", f.driver},
                      {"api", f.api_version},
                      {"software", f.software},
                      {"multiview", multiview},
                      {"max_samples", f.max_samples},
                      {"max_anisotropy", f.max_anisotropy},
                      {"float32_linear", f.float32_linear},
                      {"timestamps", f.timestamps},
                      {"calibration", calibration_text(known)}};
  } catch (const Error& error) {
    findings.push_back({"device", error.fault(), error.remedy(), true});
    json["device"] = nullptr;
  }
  const bool window = exists("DISPLAY") || exists("WAYLAND_DISPLAY");
  findings.push_back({"display", window ? "a desktop answers" : "none (DISPLAY and WAYLAND_DISPLAY are unset)",
                      window ? "" : "explore needs a desktop; replay and capture do not", false});
  look_at_headset(findings, json);
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
