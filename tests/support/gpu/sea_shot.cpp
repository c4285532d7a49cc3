#include "tests/support/gpu/sea_shot.h"

#include "app/frame.h"
#include "app/program.h"
#include "platform/headless.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape::test {

Pose pose(glm::dvec3 position_m, double yaw_deg, double pitch_deg, double roll_deg) {
  return {position_m, orientation_from_angles({yaw_deg, pitch_deg, roll_deg})};
}

SeaShot::SeaShot(const ShotOptions& options) : SeaShot(test::device(), options) {}

SeaShot::SeaShot(Device& device, const ShotOptions& options) : device_(device), options_(options) {
  Scene scene = load_scene(options.scene, options.preset);
  if (options.preset == "ultra") scene.settings.render.shape = FrameShape::desktop;  // so that both shapes are drawn
  if (options.effects) scene.effects = *options.effects;
  if (!options.inputs.empty()) scene.inputs = options.inputs;
  if (!options.objects.empty()) scene.objects = options.objects;
  if (!options.shapes.empty()) scene.shapes = options.shapes;
  scene.clip_room = options.clip_room;
  scene.actors_foam = options.actors_foam;
  for (const auto& [key, value] : options.set) set_from_text(scene.settings, key, value, "test");
  ExperienceOptions wanted{options.width, options.height, options.views, options.per_eye, options.probe};
  wanted.comfort = options.comfort;
  wanted.hands = options.hands;
  wanted.hidden = options.hidden;
  wanted.show_depth = options.show_depth;
  wanted.most_width = options.most_width;
  wanted.most_height = options.most_height;
  experience_ = std::make_unique<Experience>(device, shaders(), scene, wanted);
}

Viewpoint SeaShot::viewpoint(const Pose& head) const {
  const RenderSettings& render = scene().settings.render;
  HeadlessOptions display;
  display.width = options_.width;
  display.height = options_.height;
  display.views = options_.views;
  display.vertical_fov_deg = render.vertical_fov_deg;
  display.eye_distance_m = render.eye_distance_m;
  display.eye = options_.eye;
  return Headless(display).viewpoint(head);
}

void SeaShot::draw(const Viewpoint& eyes, double time_s) {
  if (options_.actor != nullptr && acted_on_.lock() != experience_->sea()) {
    acted_on_ = experience_->sea();
    experience_->sea()->add(options_.actor());
  }
  Frame& frame = experience_->frame();
  frame.begin();
  draw_frame(*experience_, frame, eyes, time_s);
  frame.submit();
  frame.finish();
}

std::vector<Image8> SeaShot::pictures(const Viewpoint& eyes, double time_s) {
  draw(eyes, time_s);
  std::vector<Image8> views;
  for (int view = 0; view < options_.views; ++view) views.push_back(picture_of(device_, *experience_, view));
  return views;
}

void SeaShot::set(const std::string& key, const std::string& value) {
  Settings settings = scene().settings;
  set_from_text(settings, key, value, "test");
  experience_->apply(settings);
}

}  // namespace seascape::test
