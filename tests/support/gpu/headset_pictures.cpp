#include "tests/support/gpu/headset_pictures.h"

#include "app/frame.h"
#include "app/program.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape::test {

const Pose HeadsetScene::carrier{{12.0, 0.5, -7.0}, glm::angleAxis(0.4, glm::dvec3(0.0, 1.0, 0.0))};

Scene scene_of(const HeadsetLook& look, bool for_depth) {
  Scene scene = load_scene("calm", look.preset);
  const auto set = [&](const auto& all) {
    for (const auto& [key, value] : all) set_from_text(scene.settings, key, value, "test");
  };
  set(std::vector<std::pair<std::string, std::string>>{{"waves.cascades", "3"}});
  set(look.set);
  if (for_depth) set(look.depth_of);
  if (look.underwater && !for_depth) scene.effects.push_back("underwater");
  return scene;
}

ExperienceOptions options_of(const Headset& headset) {
  ExperienceOptions options{headset.system().facts().width, headset.system().facts().height, 2};
  options.colour = headset.colour();
  options.show_depth = headset.shows_depth();
  return options;
}

namespace {

ExperienceOptions with_room(const Headset& headset) {
  ExperienceOptions options = options_of(headset);
  options.most_width = headset.most_size().x;
  options.most_height = headset.most_size().y;
  options.hidden = headset.hidden() != nullptr;
  return options;
}

}  // namespace

HeadsetScene::HeadsetScene(Device& device, Headset& headset, const Scene& scene)
    : device_(device), headset_(headset), experience_(device, shaders(), scene, with_room(headset)), copy_(device) {}

DisplayFrame HeadsetScene::step(bool kept) {
  const DisplayFrame shown = headset_.begin();
  Frame& frame = experience_.frame();
  if (!shown.should_render) {
    headset_.end(frame, nullptr);
    return shown;
  }
  experience_.resize(shown.width, shown.height);
  experience_.draw_into(shown.lent);
  experience_.choose(shown.colour, shown.depth);
  drawn_ = {};
  drawn_.width = shown.width;
  drawn_.height = shown.height;
  drawn_.time_s = 3.0 + shown.time_s;
  frame.begin();
  drawn_.viewpoint = headset_.viewpoint(carrier);
  if (headset_.hidden()) experience_.hide(*headset_.hidden());
  draw_frame(experience_, frame, drawn_.viewpoint, drawn_.time_s);
  if (kept) copy_.record(frame, experience_.picture());  // the runtime takes its image at the frame's end
  headset_.end(frame, &experience_.picture(), experience_.shown_depth());
  if (kept) {
    frame.finish();
    for (int eye = 0; eye < 2; ++eye) drawn_.pictures[std::size_t(eye)] = copy_.read(eye);
  }
  return shown;
}

std::vector<HeadsetPicture> drawn_without(Device& device, const Scene& scene, ExperienceOptions options,
                                          const std::vector<HeadsetPicture>& as, const HiddenMesh* hidden) {
  options.hidden = hidden != nullptr;
  Experience experience(device, shaders(), scene, options);
  std::vector<HeadsetPicture> all;
  for (const HeadsetPicture& one : as) {
    HeadsetPicture& drawn = all.emplace_back(HeadsetPicture{one.viewpoint, one.time_s, one.width, one.height, {}, {}});
    experience.resize(one.width, one.height);
    Frame& frame = experience.frame();
    frame.begin();
    if (hidden) experience.hide(*hidden);
    draw_frame(experience, frame, one.viewpoint, one.time_s);
    frame.submit();
    frame.finish();
    for (std::size_t eye = 0; eye < 2; ++eye) {
      drawn.pictures[eye] = read_picture(device, experience.picture().colour(), {one.width, one.height}, int(eye));
      if (const Image* depth = experience.shown_depth()) drawn.depths[eye] = depths_of(device, *depth, drawn, eye);
    }
  }
  return all;
}

std::vector<std::uint8_t> depths_of(Device& device, const Image& depth, const HeadsetPicture& of, std::size_t eye) {
  return read_image(device, depth, std::uint32_t(eye), 0, {of.width, of.height});
}

}  // namespace seascape::test
