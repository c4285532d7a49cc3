#include "app/program.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <glm/gtc/packing.hpp>
#include <thread>

#include "app/quality.h"
#include "engine/error.h"
#include "engine/srgb.h"

namespace seascape {

namespace {

bool environment_says(const char* name, bool otherwise) {
  const char* value = std::getenv(name);
  return value && *value ? std::strcmp(value, "0") != 0 : otherwise;
}

std::string processor_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.starts_with("model name"))
      if (const std::size_t colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return {};
}

std::string date_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02} UTC", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday, utc.tm_hour,
                     utc.tm_min);
}

}  // namespace

DeviceClass device_class(const DeviceFacts& facts) {
  if (facts.software) return DeviceClass::software;
  return facts.kind == "discrete" ? DeviceClass::discrete : DeviceClass::integrated;
}

DeviceOptions device_options() {
  DeviceOptions options;
  options.validation = environment_says("SEASCAPE_VALIDATION", debug_build);
  options.core_only = environment_says("SEASCAPE_CORE_ONLY", false);
  options.cache = DiskCache::of_user();
  return options;
}

Program make_program(const Arguments& arguments, const DeviceOptions& options) {
  Program program = make_program(arguments, arguments.preset, options);
  tell_remarks(program.scene);
  return program;
}

Program make_program(const Arguments& arguments, const std::string& preset, const DeviceOptions& options) {
  // The scene is read first: a fault in it is told before a device is looked for. What a preset is on the device needs
  // that.
  (void)scene_from(arguments, preset == "auto" ? "high" : preset);
  Program program;
  program.device = std::make_unique<Device>(options);
  const DeviceClass device = device_class(program.device->facts());
  program.preset = resolve_preset(preset, device);
  program.scene = scene_from(arguments, program.preset, device);
  return program;
}

void expect_no_validation_messages(const Device& device) {
  const auto messages = device.validation_messages();
  if (!messages.empty())
    throw Error("validation", fmt::format("{} messages, the first: {}", messages.size(), messages.front()),
                "this is a fault of seascape");
}

Image8 picture_of(Device& device, const Experience& experience, int view) {
  const TargetSpec& spec = experience.picture().spec();
  return {int(spec.width), int(spec.height), 4,
          read_image(device, experience.picture().colour(), std::uint32_t(view), 0, {spec.width, spec.height})};
}

ImageF linear_picture_of(Device& device, const Experience& experience, int view) {
  const RenderTarget* lit = experience.lit();
  const TargetSpec& spec = experience.picture().spec();
  ImageF image{int(spec.width), int(spec.height), {}};
  image.pixels.resize(std::size_t(spec.width) * spec.height * 4);
  const auto bytes = read_image(device, lit ? lit->colour() : experience.picture().colour(), std::uint32_t(view), 0,
                                {spec.width, spec.height});
  if (lit) {  // scene light before tone mapping
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      std::uint16_t half;
      std::memcpy(&half, &bytes[2 * i], 2);
      image.pixels[i] = glm::unpackHalf1x16(half);
    }
  } else {  // the tile frame keeps none: the picture's own light
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const double c = bytes[i] / 255.0;
      image.pixels[i] = i % 4 == 3 ? float(c) : float(srgb_to_light(c));
    }
  }
  return image;
}

const char* view_suffix(int views, int view) { return views == 1 ? "" : view == 0 ? "_left" : "_right"; }

int frames_of(const CameraPath& path, double fps) { return int(std::floor(path.duration_s() * fps + 1e-9)) + 1; }

HeadlessOptions headless_options(const Arguments& arguments, const RenderSettings& render) {
  HeadlessOptions options;
  if (arguments.width) options.width = std::uint32_t(arguments.width);
  if (arguments.height) options.height = std::uint32_t(arguments.height);
  options.views = arguments.views;
  options.vertical_fov_deg = render.vertical_fov_deg;
  options.eye_distance_m = render.eye_distance_m;
  options.eye = arguments.eye == Eye::left ? -1 : arguments.eye == Eye::right ? 1 : 0;
  return options;
}

Machine machine_of(const DeviceFacts& facts, std::uint64_t seed) {
  Machine machine;
  machine.device = facts.name;
  machine.driver = facts.driver;
  machine.cpu = processor_name();
  machine.cores = int(std::thread::hardware_concurrency());
  machine.build = build_name();
  machine.date = date_utc();
  machine.seed = seed;
  return machine;
}

std::string build_name() {
  const char* configuration = debug_build ? "debug" : "release";
#ifdef __clang__
  const char* compiler = "Clang " __clang_version__;
#else
  const char* compiler = "GCC " __VERSION__;
#endif
  return fmt::format("seascape " SEASCAPE_VERSION ", {}, {}", configuration, compiler);
}

}  // namespace seascape
