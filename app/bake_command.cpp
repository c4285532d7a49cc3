// `seascape bake`: records the waves of a scene as a loop of displacement, one EXR a frame.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <string>

#include "app/commands.h"
#include "app/loop_file.h"
#include "app/progress.h"
#include "app/scene.h"
#include "app/sea_remarks.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/image_file.h"
#include "engine/output_folder.h"
#include "ocean/effects.h"

namespace seascape {

int run_bake(const Arguments& arguments) {
  namespace fs = std::filesystem;
  const Scene scene = scene_from(arguments, arguments.preset);
  tell_remarks(scene);
  LoopRecorder recorder(limited_sea(scene).sea, {arguments.frames, arguments.fps, arguments.width, arguments.tile_m});
  for (const EffectEntry& entry : closure(scene.effects))
    for (const std::string_view source : {"gerstner", "wave_particles", "baked"})
      if (entry.name == source) spdlog::warn("{} has a tile of its own and is not in the loop", entry.name);
  const LoopRequest& request = recorder.request();
  const fs::path out = arguments.out;
  const OutputFolder held(out);
  std::error_code ignored;
  // While frames are of two loops there is no manifest, so that nobody plays them.
  fs::remove(out / loop_manifest, ignored);
  BakedLoop loop{request.samples, request.frames, request.fps, request.side_m, {}};
  std::vector<float> texels(loop.frame_floats());
  const std::size_t count = std::size_t(request.samples) * std::size_t(request.samples);
  ImageF image{request.samples, request.samples, std::vector<float>(4 * count, 1.0f)};
  {
    Progress progress("bake: frame", std::size_t(request.frames));
    for (int frame = 0; frame < request.frames; ++frame) {
      recorder.record(frame, texels);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c) image.pixels[4 * i + c] = texels[c * count + i];
      write_exr(out / loop_frame_name(frame), image);
      progress.step(std::size_t(frame) + 1);
    }
  }
  for (int frame = request.frames; fs::remove(out / loop_frame_name(frame), ignored); ++frame) {
  }  // of a longer loop that was here
  write_atomically(out / loop_manifest,
                   loop_manifest_text(loop, {scene.name, recorder.frequency_error(), recorder.height_m()}));
  fmt::print("{}: {} frames of {}x{} texels, {:.4g} m a side, a loop of {:.4g} s\n", out.string(), request.frames,
             request.samples, request.samples, request.side_m, request.frames / request.fps);
  fmt::print("waves from {:.3g} m down to {:.3g} m, {:.3g} m significant height of the sea's {:.3g} m\n",
             request.side_m, 4.0 * request.side_m / request.samples, recorder.height_m(), recorder.sea_height_m());
  fmt::print(
      "frequencies moved by {:.2g} % (root mean square by energy), the most by {:.2g} %, so that the loop closes\n",
      100.0 * recorder.frequency_error(), 100.0 * recorder.worst_frequency_error());
  return 0;
}

}  // namespace seascape
