// A scene at a preset, drawn for a pose and a time into pictures, as the program's commands do it.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/camera_path.h"
#include "app/experience.h"
#include "engine/image_file.h"

namespace seascape::test {

struct ShotOptions {
  std::string scene = "open_sea", preset = "medium";
  std::uint32_t width = 160, height = 90;
  int views = 1;
  int eye = 0;  // of one view: -1 left, 0 centre, 1 right
  bool per_eye = false, probe = false, comfort = false, hands = false, hidden = false, show_depth = false;
  std::uint32_t most_width = 0, most_height = 0;         // room for other sizes
  std::vector<std::pair<std::string, std::string>> set;  // as by --set
  std::optional<std::vector<std::string>> effects = {};  // instead of the scene's
  std::vector<InputSpec> inputs = {};                    // instead of the scene's, where there are any
  SceneObjects objects = {};                             // likewise
  SceneShapes shapes = {};                               // likewise
  ClipRoom clip_room = {};
  bool actors_foam = false;
  // Makes who acts on the sea, in whichever sea there is from the next frame on; null: nobody does.
  std::shared_ptr<SeaActor> (*actor)() = nullptr;
};

// A pose from metres and degrees.
Pose pose(glm::dvec3 position_m, double yaw_deg, double pitch_deg, double roll_deg = 0.0);

class SeaShot {
 public:
  explicit SeaShot(const ShotOptions& options);
  SeaShot(Device& device, const ShotOptions& options);
  // The views of a head, as a headless display hands them out.
  Viewpoint viewpoint(const Pose& head) const;
  // Draws one frame and waits for it; of a head as above, or of any eyes, as many as options.views.
  void draw(const Pose& head, double time_s) { draw(viewpoint(head), time_s); }
  void draw(const Viewpoint& eyes, double time_s);
  // The same, read back: one picture a view.
  std::vector<Image8> pictures(const Pose& head, double time_s) { return pictures(viewpoint(head), time_s); }
  std::vector<Image8> pictures(const Viewpoint& eyes, double time_s);
  Image8 picture(const Pose& head, double time_s) { return pictures(head, time_s).front(); }
  Image8 picture(const Viewpoint& eyes, double time_s) { return pictures(eyes, time_s).front(); }
  // Takes a setting, as by --set.
  void set(const std::string& key, const std::string& value);

  Experience& experience() { return *experience_; }
  Device& device() { return device_; }
  const Scene& scene() const { return experience_->scene(); }
  const FrameCounts& counts() { return experience_->frame().counts(); }

 private:
  Device& device_;
  ShotOptions options_;
  std::unique_ptr<Experience> experience_;
  std::weak_ptr<Sea> acted_on_;
};

}  // namespace seascape::test
