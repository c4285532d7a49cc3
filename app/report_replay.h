// replay.json: what a replay drew, from where, how long it took and how much it was.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/eye_crossings.h"
#include "ocean/bodies/body_events.h"
#include "platform/input.h"
#include "platform/input_script.h"

namespace seascape {

// What a path's user did in a frame.
struct ReplayedInput {
  ActionValues values{};
  std::vector<Press> pressed;
  std::array<std::optional<Pose>, 2> hands;  // left, right, in the world; nothing: not tracked
};

// A body as it is at a frame's time.
struct ReplayedBody {
  std::string name;
  Pose pose;
  glm::dvec3 velocity_mps{0.0};
};

struct ReplayFrame {
  int frame = 0;                            // of the path
  double time_s = 0.0, scene_time_s = 0.0;  // along the path; the sea's
  Viewpoint views;                          // the head, then each eye drawn
  std::optional<ReplayedInput> acted;       // of a path that has actions
  std::vector<ReplayedBody> bodies;
  std::vector<BodyEvent> events;      // since the frame before
  std::vector<EyeEvent> eye_events;   // of the views, likewise
  std::uint64_t sea_hash = 0;         // Sea::hash
  std::vector<std::string> files;     // pictures, one an eye
  double cpu_ms = 0.0, gpu_ms = 0.0;  // taken
  std::uint64_t draws = 0, triangles = 0, dispatches = 0, patches = 0;
};

struct ReplayRecord {
  std::string scene, path, preset;
  std::uint64_t seed = 0;
  int width = 0, height = 0;  // per view
  int msaa = 1;
  double fps = 0.0;
  std::string stereo, debug, format;  // as on the command line, resolved: "single", "none", "png" ...
  std::string device, driver, build;
  std::vector<ReplayFrame> frames;
};

// One line a frame. All but `taken`, `device`, `driver` and `build` are the same in every replay of the same request.
// Numbers read back as the same doubles; NaN and infinity are null.
std::string replay_json(const ReplayRecord& record);
void write_replay_record(const std::filesystem::path& file, const ReplayRecord& record);  // atomic; throws Error

}  // namespace seascape
