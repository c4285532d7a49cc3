#include "app/loop_file.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "app/located_json.h"
#include "app/scene.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/image_file.h"
#include "engine/text.h"

namespace seascape {

namespace {
namespace fs = std::filesystem;

int whole(ObjectReader& reader, std::string_view key, int least, int most, const std::string& where) {
  const double value = reader.required_number(key, least, most, "");
  if (value != std::floor(value))
    throw Error(where, std::string(key) + ": " + text_from(value) + " is not a whole number", "give a whole number");
  return int(value);
}

// One frame into its place.
void read_frame(const fs::path& file, int samples, double side_m, float* to) {
  const std::string where = file.string();
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  const std::vector<std::string> channels = exr_channels_from_memory(bytes, where);
  std::string missing;
  for (const char* name : {"R", "G", "B"})
    if (std::find(channels.begin(), channels.end(), name) == channels.end())
      missing += (missing.empty() ? "" : ", ") + std::string(name);
  if (!missing.empty())
    throw Error(where, "lacks the channel " + missing + " of a displacement (R along x, G upwards, B along z)",
                "name its channels R, G and B, or bake the loop anew");
  const ImageF image = read_exr_from_memory(bytes, where);
  if (image.width != samples || image.height != samples)
    throw Error(
        where,
        fmt::format("is {}x{} texels where the manifest says {}x{}", image.width, image.height, samples, samples),
        "take frames of one size, or bake the loop anew");
  const std::size_t count = std::size_t(samples) * std::size_t(samples);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = image.pixels[4 * i + c];
      if (!(std::abs(value) <= side_m))
        throw Error(where,
                    fmt::format("moves the water by {} m at column {}, row {}, more than the loop's side of {} m",
                                value, i % std::size_t(samples), i / std::size_t(samples), side_m),
                    "repair the frame, or the manifest's size_m");
      to[c * count + i] = value;
    }
}

}  // namespace

std::string loop_frame_name(int frame) { return fmt::format("frame_{:04}.exr", frame); }

std::string loop_manifest_text(const BakedLoop& loop, const LoopNotes& notes) {
  const nlohmann::ordered_json json = {{"version", 1},
                                       {"size_m", loop.side_m},
                                       {"texels", loop.samples},
                                       {"frames", loop.frames},
                                       {"fps", loop.fps},
                                       {"scene", notes.scene},
                                       {"significant_height_m", notes.height_m},
                                       {"frequency_error", notes.frequency_error}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::filesystem::path loop_folder(const std::string& name, const fs::path& scene) {
  std::error_code ignored;
  if (name.empty())
    throw Error("baked.loop", "no loop is named", "name a folder that seascape bake wrote, or one of content/loops");
  if (name.find('/') != std::string::npos) {
    const fs::path beside = scene.empty() || fs::path(name).is_absolute() ? fs::path(name) : scene.parent_path() / name;
    for (const fs::path& folder : {beside, fs::path(name)})
      if (fs::is_directory(folder, ignored)) return folder;
    throw Error("baked.loop", in_quotes(name) + " is no folder", "make it with seascape bake --out " + name);
  }
  const fs::path all = content_directory() / "loops";
  if (fs::is_directory(all / name, ignored)) return all / name;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(all, ignored))
    if (entry.is_directory(ignored)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  const std::vector<std::string_view> views(names.begin(), names.end());
  throw Error("baked.loop", "no loop is called " + in_quotes(name) + did_you_mean(name, views),
              "take " + (names.empty() ? std::string() : listed(views) + ", or ") + "a folder as ./" + name +
                  "; names are looked up in " + all.string());
}

BakedLoop read_loop(const fs::path& folder) {
  const std::string where = (folder / loop_manifest).string();
  BakedLoop loop;
  {
    const std::string text = read_text(where, largest_json_bytes);
    const LocatedJson json = parse_located_json(text, where);
    Faults thrown;
    ObjectReader reader(json, "", where, thrown);
    reader.version();
    loop.side_m = reader.required_number("size_m", 1e-3, 1e6, "m");
    loop.samples = whole(reader, "texels", BakedLoop::least_samples, BakedLoop::most_samples, where);
    if (!std::has_single_bit(unsigned(loop.samples)))
      throw Error(where, "texels: " + text_from(loop.samples) + " is no power of two",
                  "give 16, 32, 64, 128, 256 or 512");
    loop.frames = whole(reader, "frames", BakedLoop::least_frames, BakedLoop::most_frames, where);
    loop.fps = reader.required_number("fps", 1e-3, 1e4, "1/s");
    for (const char* note : {"significant_height_m", "frequency_error"}) (void)reader.number(note, 0.0, 1e9, 0.0, "");
    (void)reader.text("scene", "");
    reader.finish();
  }
  if (std::size_t(loop.frames) * loop.frame_floats() * sizeof(float) > largest_file_bytes * 4)
    throw Error(where,
                fmt::format("{} frames of {}x{} texels take {} MiB", loop.frames, loop.samples, loop.samples,
                            (std::size_t(loop.frames) * loop.frame_floats() * sizeof(float)) >> 20),
                "take fewer or smaller frames: at most 1024 MiB");
  std::error_code ignored;
  for (int frame = 0; frame < loop.frames; ++frame)  // told before memory is taken
    if (const fs::path file = folder / loop_frame_name(frame); !fs::is_regular_file(file, ignored))
      throw Error(file.string(), fmt::format("is missing, of {} frames", loop.frames),
                  "copy it there, or bake the loop anew");
  loop.texels.resize(std::size_t(loop.frames) * loop.frame_floats());
  for (int frame = 0; frame < loop.frames; ++frame)
    read_frame(folder / loop_frame_name(frame), loop.samples, loop.side_m,
               loop.texels.data() + std::size_t(frame) * loop.frame_floats());
  return loop;
}

}  // namespace seascape
