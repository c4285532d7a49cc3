// Bodies of actors as they are drawn: a hole where a query says that there is no water, wherever they go, with nothing
// built anew.
#include <cmath>
#include <memory>

#include "app/frame.h"
#include "ocean/sea/sea.h"
#include "tests/support/allocations.h"
#include "tests/support/gpu/drawn_mesh.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/wigley.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

class DrawnClipBodies : public test::GpuTest {};

// A boat under way that turns, and a ball that stays.
class Fleet : public SeaActor {
 public:
  void step(SeaStep& step) override {
    const double since_s = step.time_s - 4.0, turn_rad_s = 0.5, speed_mps = sails ? 4.0 : 0.0;
    ClipBody boat{.hull = 0, .scale = 1.5};
    boat.at_m = {-6.0 + speed_mps * since_s, 0.2, -4.0};
    boat.velocity_mps = {speed_mps, 0.0, 0.0};
    boat.orientation = glm::angleAxis(sails ? turn_rad_s * since_s : 0.3, glm::dvec3(0.0, 1.0, 0.0));
    boat.spin_rad_s = {0.0, sails ? turn_rad_s : 0.0, 0.0};
    step.clip(boat);
    step.clip({.form = VolumeInput::Form::sphere, .radius_m = 2.5, .at_m = {7.0, 0.5, -12.0}});
    step.foam({.at_m = {boat.at_m.x, boat.at_m.z}, .radius_m = 2.0, .per_s = 3.0});
  }
  bool sails = true;
};

// Pixels whose water a query says to be clipped, of the drawn detail and at the same time, show the sky beneath, and no
// others do: at a time of a step and between two, beside a volume of the scene and by itself, in both frame shapes, and
// where patches within a body may be left out. What differs lies along edges, as in VolumesClipWhatStandsWithinThem.
// Nothing is built for it, and a frame in which no body moves copies none. Controls seen: bodies copied once only (863
// pixels wrong and more); copied where the scene's volumes lie; the number of nodes that of the scene's alone; bodies
// copied in every frame.
TEST_F(DrawnClipBodies, LeaveHolesWhereTheQuerySays) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  constexpr int width = 160, height = 120;
  InputSpec rock;
  rock.to = InputTarget::clip;
  rock.blend = InputBlend::replace;
  rock.value.x = 1.0f;
  rock.shape = VolumeInput{.form = VolumeInput::Form::cylinder, .at_m = {-9.0, 0.0, -14.0}, .radius_m = 2.0};
  for (const bool with_rock : {false, true}) {
    const auto shot_of = [&](std::vector<std::string> effects) {
      InputSpec far = rock;  // for a scene's own inputs would be there without any
      std::get<VolumeInput>(far.shape).at_m = {-9.0, 4000.0, -14.0};
      return SeaShot({.scene = "open_sea",
                      .preset = "high",
                      .width = width,
                      .height = height,
                      .probe = true,
                      .set = {{"msaa", with_rock ? "4" : "1"}, {"debug.view", "holes"}, {"waves.where", "cpu"}},
                      .effects = std::move(effects),
                      .inputs = {with_rock ? rock : far},
                      .clip_room = {8, {test::wigley_model({})}}});
    };
    SeaShot with = shot_of({"waves", "clip"}), without = shot_of({"waves"});
    Sea& sea = *with.experience().sea();
    const auto fleet = std::make_shared<Fleet>();
    sea.add(fleet);
    const Viewpoint view = with.viewpoint(pose({0.0, 25.0, 3.0}, 0.0, -65.0));
    with.draw(view, 4.0);
    with.draw(view, 4.1);
    const std::size_t objects = test::device().objects().size();
    const std::uint64_t moving = with.counts().passes;
    for (const double time_s : {4.5, 6.5 + 0.4 / 60.0}) {
      const Image8 picture = with.picture(view, time_s);
      without.draw(view, time_s);
      const auto shown = test::DrawnMesh(without, view).shown(width, height);
      const SeaView water = sea.view_at(time_s, SeaDetail::drawn);
      int wrong = 0, holes = 0, by_bodies = 0;
      for (std::size_t i = 0; i < shown.size(); ++i) {
        if (!shown[i].any) continue;
        const glm::dvec2 at(shown[i].point.at.x, shown[i].point.at.z);
        const glm::dvec3 light = test::light_at(picture, i);
        const bool want = water.query(at).clipped;
        holes += want;
        by_bodies += want && !water.query(at, {.history = false}).clipped;
        wrong += want ? light.x - light.y < 0.3 : light.x - light.y > 0.7;  // holes are magenta
      }
      EXPECT_GT(by_bodies, 600) << test::leave(picture, "bodies");
      EXPECT_EQ(holes > by_bodies + 50, with_rock);
      EXPECT_LE(wrong, 40) << "of " << shown.size() << " at " << time_s << ' ' << test::leave(picture, "bodies");
    }
    fleet->sails = false;
    with.draw(view, 6.6);
    with.draw(view, 6.7);
    EXPECT_EQ(with.counts().passes + 1, moving) << "bodies that rest are copied again";
    EXPECT_EQ(with.experience().builds(), 1u);
    EXPECT_EQ(test::device().objects().size(), objects);
    sea.take_away(*fleet);
    with.draw(view, 6.71);
    EXPECT_EQ(sea.clip_volumes()->bodies().size(), 0u);
    const Image8 empty = with.picture(view, 6.72);
    without.draw(view, 6.72);
    int holes = 0;
    for (std::size_t i = 0; i < std::size_t(width * height); ++i) {
      const glm::dvec3 light = test::light_at(empty, i);
      holes += light.x - light.y > 0.7;
    }
    EXPECT_EQ(holes > 50, with_rock) << test::leave(empty, "no_bodies");
  }
}

// A patch wholly within a body is not drawn while the body is there. Control seen: patches asked of the scene's
// volumes.
TEST_F(DrawnClipBodies, PatchesWithinThemAreNotDrawn) {
  class Raft : public SeaActor {
    void step(SeaStep& step) override {
      step.clip({.form = VolumeInput::Form::box, .size_m = {400.0, 200.0, 300.0}, .at_m = {0.0, 0.0, -150.0}});
    }
  };
  SeaShot shot({.scene = "open_sea", .width = 64, .height = 48, .effects = {{"waves", "clip"}}, .clip_room = {1, {}}});
  const Viewpoint view = shot.viewpoint(pose({0.0, 6.0, 0.0}, 0.0, -10.0));
  shot.draw(view, 1.0);
  const std::uint64_t before = shot.counts().triangles;
  const auto raft = std::make_shared<Raft>();
  shot.experience().sea()->add(raft);
  shot.draw(view, 1.1);
  EXPECT_LT(double(shot.counts().triangles), 0.7 * double(before));
}

// Foam of actors is drawn: brighter water where they have been. Control seen: foam not kept for actors.
TEST_F(DrawnClipBodies, FoamWhereTheyWere) {
  SeaShot shot({.scene = "open_sea", .width = 96, .height = 72, .effects = {{"waves", "foam"}}, .actors_foam = true});
  const Viewpoint view = shot.viewpoint(pose({0.0, 20.0, -4.0}, 0.0, -89.0));
  const auto fleet = std::make_shared<Fleet>();
  shot.experience().sea()->add(fleet);
  for (int i = 0; i <= 8; ++i) shot.draw(view, 4.0 + 0.25 * i);
  ASSERT_NE(shot.experience().ocean().foam(), nullptr);
  const FoamSea& foam = shot.experience().ocean().foam()->sea();
  EXPECT_GT(foam.foam().covered({0.0, -4.0}, 0.0), 0.3f);
  EXPECT_LT(foam.foam().covered({0.0, 6.0}, 0.0), 0.2f);
}

// Frames in which bodies move and foam allocate nothing. Control seen: volumes made anew for each frame.
TEST(SteadyFrame, AllocatesNothingWhileBodiesMove) {
  Device device{DeviceOptions{}};
  SeaShot shot(device, {.scene = "storm",
                        .width = 64,
                        .height = 48,
                        .set = {{"waves.resolution", "32"}, {"lod.patch_quads", "16"}},
                        .effects = {{"waves", "foam", "clip"}},
                        .clip_room = {4, {test::wigley_model({})}},
                        .actors_foam = true});
  shot.experience().sea()->add(std::make_shared<Fleet>());
  Frame& frame = shot.experience().frame();
  for (int i = 0; i <= 60; ++i) {
    const Viewpoint viewpoint = shot.viewpoint(pose({2.0, 8.0, 0.1 * i}, 20.0, -8.0));
    const test::AllocationCounter counter;
    frame.begin();
    draw_frame(shot.experience(), frame, viewpoint, 0.05 * i);
    frame.submit();
    EXPECT_TRUE(i < 30 || counter.ours() == 0) << "frame " << i;
  }
  EXPECT_EQ(shot.experience().sea()->clip_volumes()->bodies().size(), 2u);
  frame.finish();
  device.wait_idle();
}

}  // namespace
}  // namespace seascape
