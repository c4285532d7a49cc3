// `seascape replay`: draws a camera path frame by frame into files; its time comes from the path, never from the clock.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands.h"
#include "app/frame.h"
#include "app/program.h"
#include "engine/error.h"
#include "engine/files.h"
#include "platform/headless.h"

namespace seascape {

int run_replay(const Arguments& arguments) {
  Program program = make_program(arguments, device_options());
  Device& device = *program.device;
  const CameraPath path = path_from(arguments, program.scene);
  const int path_frames = int(std::floor(path.duration_s() * arguments.fps + 1e-9)) + 1;
  const int end = arguments.frames > 0 ? arguments.start + arguments.frames : path_frames;
  if (arguments.start >= path_frames)
    throw Error("--start", fmt::format("{} is past the path's last frame, {}", arguments.start, path_frames - 1), "choose an earlier one", 2);
  const std::filesystem::path out = arguments.out.empty() ? "out/replay" : arguments.out;
  make_output_directory(out);

  const RenderSettings& render = program.scene.settings.render;
  HeadlessOptions options;
  if (arguments.width) options.width = std::uint32_t(arguments.width);
  if (arguments.height) options.height = std::uint32_t(arguments.height);
  options.views = arguments.views;
  options.vertical_fov_deg = render.vertical_fov_deg;
  options.eye_distance_m = render.eye_distance_m;
  options.eye = arguments.eye == Eye::left ? -1 : arguments.eye == Eye::right ? 1 : 0;
  Headless display(options);
  const bool per_eye = draw_per_eye(device, program.shaders, render.stereo, options.views);
  Experience experience(device, program.shaders, program.scene, {options.width, options.height, options.views, per_eye, false});
  Frame& frame = experience.frame();
  Progress progress("replay: frame", end - arguments.start);
  for (int number = arguments.start; number < end; ++number) {
    const PathSample sample = path.at(number / arguments.fps);
    const double time_s = program.scene.settings.time_start_s + sample.scene_time_s * program.scene.settings.time_scale;
    display.begin();
    frame.begin();
    draw_frame(experience, frame, display.viewpoint(sample.pose), time_s);
    display.end(frame, &experience.picture());
    frame.finish();
    for (int view = 0; view < options.views; ++view) {
      const std::string name = fmt::format("frame_{:04}{}", number, view_suffix(options.views, view));
      if (arguments.format == PictureFormat::png) write_png(out / (name + ".png"), picture_of(device, experience, view));
      else write_exr(out / (name + ".exr"), linear_picture_of(device, experience, view));
    }
    progress.step(number - arguments.start + 1);
  }
  expect_no_validation_messages(device);
  return 0;
}

}  // namespace seascape
