// The view from outside shows what the experience shows from there: solid things and their shadows too.
#include "app/outside_view.h"

#include <gtest/gtest.h>

#include "app/frame.h"
#include "app/program.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

class OutsideViewDrawn : public test::GpuTest {};

constexpr std::uint32_t width = 160, height = 120;

Scene scene_of(bool things) {
  Scene scene = load_scene("calm", "low");
  scene.effects = {"waves", "models"};
  for (const auto& [key, value] : test::Set{{"waves.resolution", "32"},
                                            {"msaa", test::device().facts().software ? "1" : "4"},
                                            {"frame.shape", "tile"},
                                            {"models.seen_in_water", "false"},
                                            {"models.shadow_texels", "1024"},
                                            {"sky.sun_elevation_deg", "45"},
                                            {"sky.sun_to_deg", "65"}})
    set_from_text(scene.settings, key, value, "test");
  const double away = things ? 0.0 : 5000.0;
  const char* const glass =
      R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.2,0.9,0.4,0.5],"roughnessFactor":0.3}})";
  const char* const rough = R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.9}})";
  test::stand(scene.objects, test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), rough), Pose{{away, 1.6, -6.0}});
  test::stand(scene.objects, test::solid_model(test::solid_plate(3.0f), rough), Pose{{away, 0.6, -6.0}});
  test::stand(scene.objects, test::solid_model(test::solid_box({0.6f, 0.6f, 0.02f}), glass),
              Pose{{away + 1.5, 1.4, -4.5}});
  return scene;
}

Image8 outside(Experience& experience, const Viewpoint& own, const Viewpoint& from) {
  Frame& frame = experience.frame();
  frame.begin();
  draw_frame(experience, frame, own, 1.0);
  frame.submit();
  frame.finish();
  Frame second(test::device());
  OutsideView view(test::device(), test::shaders(), experience, second, {width, height});
  second.begin();
  view.draw(second, experience, from);
  second.submit();
  second.finish();
  Image8 made{int(width), int(height), 4, read_image(test::device(), view.picture().colour(), 0)};
  view.release();
  return made;
}

// From where the experience's own viewer stands, and from elsewhere. Controls seen: nothing drawn of solids_; the
// sun's map not described (describe_sun); no glass.
TEST_F(OutsideViewDrawn, ShowsThingsAndTheirShadows) {
  ExperienceOptions options{width, height, 1};
  options.seen_elsewhere = true;
  const Scene scene = scene_of(true), bare = scene_of(false);
  Experience experience(test::device(), test::shaders(), scene, options),
      empty(test::device(), test::shaders(), bare, options);
  const auto viewpoint = [](const Pose& head) {
    const View eye{head, symmetric_fov(60.0, double(width) / height)};
    return Viewpoint{head, {eye}, pixels_per_radian({eye}, height)};
  };
  const Viewpoint own = viewpoint(test::pose({0.0, 3.5, 0.0}, 0.0, -20.0)),
                  other = viewpoint(test::pose({5.0, 4.0, -2.0}, 300.0, -25.0));
  for (const Viewpoint& from : {own, other}) {
    const Image8 seen = outside(experience, own, from), without = outside(empty, own, from);
    Frame& frame = experience.frame();
    frame.begin();
    draw_frame(experience, frame, from, 1.0);
    frame.submit();
    frame.finish();
    const Image8 truth = picture_of(test::device(), experience, 0);
    EXPECT_GT(test::differing_pixels(seen, without), 2000) << "nothing is there";
    EXPECT_LT(test::difference(seen, truth).mean, 0.0015)
        << test::leave(seen, "outside") << test::leave(truth, "outside_truth");
  }
}

}  // namespace
}  // namespace seascape
