// Recorded loops of waves on disk: a folder of EXR frames and a manifest.
#pragma once
#include <filesystem>
#include <string>

#include "ocean/waves/baked_loop.h"

namespace seascape {

// FOLDER/loop.json: {"version": 1, "size_m": side, "texels": a side, "frames": count, "fps": frames a second, ...};
// FOLDER/frame_0000.exr and on, of channels R (metres along x), G (upwards) and B (along z): displacement from rest,
// texel centres being rest positions; rows go along z, columns along x. What else there is to the surface, slopes and
// their second moments, is made of it when a loop is played.
inline constexpr const char* loop_manifest = "loop.json";
std::string loop_frame_name(int frame);

// What of a loop.json only people read.
struct LoopNotes {
  std::string scene;
  double frequency_error = 0.0;  // LoopRecorder
  double height_m = 0.0;         // significant height
};
std::string loop_manifest_text(const BakedLoop& loop, const LoopNotes& notes);

// Where the loop of that name lies: content/loops/NAME, or where the name has a slash, that folder, looked for beside
// `scene` (a file; may be empty) and then in the working directory. Throws Error where there is none, naming those that
// there are.
std::filesystem::path loop_folder(const std::string& name, const std::filesystem::path& scene);

// Throws Error naming the file: missing, no JSON or a wrong value in the manifest; a frame that is missing, truncated,
// of another size or other channels, or holds NaN, infinity or more than a side of displacement.
BakedLoop read_loop(const std::filesystem::path& folder);

}  // namespace seascape
