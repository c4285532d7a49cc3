// What every command that draws begins with: a device, its shaders, the scene at its preset.
#pragma once
#include <memory>
#include <string>

#include "app/arguments.h"
#include "app/experience.h"
#include "app/report_page.h"
#include "engine/image_file.h"
#include "platform/headless.h"

namespace seascape {

#ifdef SEASCAPE_DEBUG
inline constexpr bool debug_build = true;
#else
inline constexpr bool debug_build = false;
#endif

struct Program {
  std::unique_ptr<Device> device;
  ShaderLibrary shaders{ShaderLibrary::default_directory(), DiskCache::of_user()};
  std::string preset;  // resolved: never "auto"
  Scene scene;
};

// Keeps pipelines in the user's cache folder (DiskCache::of_user). SEASCAPE_VALIDATION=1 turns the
// validation layer on, which a debug build has on unless it is 0; SEASCAPE_CORE_ONLY=1 uses nothing beyond Vulkan 1.1's
// floor.
DeviceOptions device_options();
// With the preset of the command line it tells what in the scene gives nothing; who goes through presets tells it once.
Program make_program(const Arguments& arguments, const DeviceOptions& options);
Program make_program(const Arguments& arguments, const std::string& preset, const DeviceOptions& options);

// What presets and `auto` go by.
DeviceClass device_class(const DeviceFacts& facts);

// Throws Error when the validation layer has said anything: a command under validation must not end well then.
void expect_no_validation_messages(const Device& device);

// The finished picture of one view as 8-bit sRGB RGBA, or as linear light.
Image8 picture_of(Device& device, const Experience& experience, int view);
ImageF linear_picture_of(Device& device, const Experience& experience, int view);

// "left" and "right" of two views; empty for one.
const char* view_suffix(int views, int view);

// Frames of a path at so many a second: the first lies on its start, the last on its end or just before.
int frames_of(const CameraPath& path, double fps);

// The size, eyes and field of view that the command line and the scene ask of a display without a screen.
HeadlessOptions headless_options(const Arguments& arguments, const RenderSettings& render);

// This machine with a device, now.
Machine machine_of(const DeviceFacts& facts, std::uint64_t seed);

// "seascape 0.1, release, GCC 12.2.0".
std::string build_name();

}  // namespace seascape
