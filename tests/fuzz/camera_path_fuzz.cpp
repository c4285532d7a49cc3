// Any bytes as a camera path: read or refused; what is read is finite at any time and survives being written.
#include "app/camera_path.h"

#include <cmath>

#include "tests/fuzz/fuzz.h"

using namespace seascape;

namespace {
bool same(const PathKey& a, const PathKey& b) {
  return a.time_s == b.time_s && a.scene_time_s == b.scene_time_s && a.pose.position_m == b.pose.position_m &&
         a.pose.orientation == b.pose.orientation;
}

void check_sample(const CameraPath& path, double time_s) {
  const PathSample sample = path.at(time_s);
  const glm::dvec3& p = sample.pose.position_m;
  fuzz::require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "positions are finite");
  fuzz::require(std::abs(glm::length(sample.pose.orientation) - 1.0) < 1e-9, "orientations have length 1");
  fuzz::require(std::isfinite(sample.scene_time_s), "scene times are finite");
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  Faults faults(true);
  parse_camera_path(text, "path.json", faults);
  const bool read = fuzz::reads([&] {
    const CameraPath path = parse_camera_path(text, "path.json");
    for (std::size_t i = 0; i < path.keys.size(); ++i) {
      const double time = path.keys[i].time_s;
      check_sample(path, time);
      if (i + 1 < path.keys.size())
        for (const double part : {1e-9, 0.3, 0.7}) check_sample(path, time + part * (path.keys[i + 1].time_s - time));
    }
    if (path.actions)
      for (const InputEvent& event : path.actions->events) {
        const auto* tracker = std::get_if<TrackerEvent>(&event.what);
        fuzz::require(tracker == nullptr || tracker->tracker != Tracker::head, "a path's keys are its only head");
      }
    const CameraPath again = parse_camera_path(camera_path_text(path), "written.json");
    fuzz::require(again.keys.size() == path.keys.size(), "a written path has the same keys");
    for (std::size_t i = 0; i < path.keys.size(); ++i)
      fuzz::require(same(again.keys[i], path.keys[i]), "a written path reads back to the bit");
    fuzz::require(camera_path_text(again) == camera_path_text(path), "and so do its actions");
  });
  fuzz::require(read == faults.list().empty(), "collecting and throwing agree on whether there is a fault");
  return 0;
}
