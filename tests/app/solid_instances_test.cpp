// Which solid things are drawn from where, and how finely.
#include "app/solids/solid_instances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/camera_path.h"
#include "tests/support/allocations.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

const char* const plain = R"({"pbrMetallicRoughness":{"metallicFactor":0}})";
constexpr int height = 600;

Viewpoint looking(const Pose& head) {
  Viewpoint viewpoint{head, stereo_views(head, symmetric_fov(60.0, 1.5), 0.063), 0.0};
  viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, height);
  return viewpoint;
}

std::size_t drawn(const std::vector<PlacedModel>& models, const std::vector<SolidThing>& things, const Pose& head,
                  double time_s = 0.0) {
  SolidSelection selection;
  select_solids(models, things, looking(head), time_s, 1.0, selection);
  return selection.instances.size();
}

// Controls seen: may_see() that is always true; the size in pixels not asked for.
TEST(SolidInstances, WhatIsBehindBesideOrTooSmallIsNotDrawn) {
  const std::vector<PlacedModel> models{test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), plain)};
  const auto at = [&](const glm::dvec3& place) { return drawn(models, {{0, Pose{place}, 1.0}}, Pose{}); };
  EXPECT_EQ(at({0.0, 0.0, -10.0}), 1u);
  EXPECT_EQ(at({0.0, 0.0, 10.0}), 0u) << "behind";
  EXPECT_EQ(at({30.0, 0.0, -10.0}), 0u) << "beside";
  EXPECT_EQ(at({0.0, 20.0, -10.0}), 0u) << "above";
  EXPECT_EQ(at({0.0, 0.0, -1000.0}), 1u);
  EXPECT_EQ(at({0.0, 0.0, -3000.0}), 0u) << "smaller than a pixel";
}

// Of any pose and place: a thing of which a corner lies in an eye's picture is drawn. Control seen: half the
// radius.
TEST(SolidInstances, NothingThatIsSeenIsLeftOut) {
  const std::vector<PlacedModel> models{test::solid_model(test::solid_box({1.0f, 0.2f, 3.0f}), plain)};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int seen = 0, unseen = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose head{{0.0, 2.0, 0.0}, orientation_from_angles({180.0 * any(random), 80.0 * any(random), 0.0})};
    const SolidThing thing{0,
                           Pose{glm::dvec3(any(random), 0.3 * any(random), any(random)) * 15.0,
                                orientation_from_angles({180.0 * any(random), 90.0 * any(random), 90.0 * any(random)})},
                           1.5};
    const Viewpoint viewpoint = looking(head);
    bool in_picture = false;
    for (const View& eye : viewpoint.eyes)
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 own(corner & 1 ? 1.0 : -1.0, corner & 2 ? 0.2 : -0.2, corner & 4 ? 3.0 : -3.0);
        const glm::dvec3 at =
            glm::conjugate(eye.pose.orientation) *
            (thing.pose.position_m + thing.pose.orientation * (thing.scale * own) - eye.pose.position_m);
        const double x = at.x / -at.z, y = at.y / -at.z;
        in_picture |= at.z < 0.0 && x > eye.fov.left && x < eye.fov.right && y < eye.fov.up && y > eye.fov.down;
      }
    const bool is_drawn = drawn(models, {thing}, head) == 1;
    EXPECT_TRUE(is_drawn || !in_picture) << i;
    (in_picture ? seen : unseen) += 1;
  }
  EXPECT_GT(seen, 300);
  EXPECT_GT(unseen, 300);
}

// Level by the share of the picture's height that its own mesh's ball covers. Controls seen: 1.1 times that share;
// the ball of the model, in which a far mast stands too.
TEST(SolidInstances, LevelsOfDetailSwitchWhereTheFileSays) {
  const char* const nodes =
      R"({"children":[1,4]},{"mesh":0,"extensions":{"MSFT_lod":{"ids":[2,3]}},)"
      R"("extras":{"MSFT_screencoverage":[0.2,0.05,0.01]}},{"mesh":0},{"mesh":0},{"mesh":0,"translation":[0,0,-20]})";
  const PlacedModel model =
      test::solid_model(test::solid_box({1.0f, 1.0f, 1.0f}), plain, nodes, R"(,"extensionsUsed":["MSFT_lod"])");
  ASSERT_EQ(model.parts().size(), 4u);
  EXPECT_EQ(model.most_parts(), 2u);
  const double tall = looking(Pose{}).eyes[0].fov.up - looking(Pose{}).eyes[0].fov.down;
  const double ball = 2.0 * std::sqrt(3.0);
  const auto level = [&](double share) {
    const std::vector<PlacedModel> models{model};
    SolidSelection selection;
    select_solids(models, std::vector<SolidThing>{{0, Pose{{0.0, 0.0, -ball / (share * tall)}}, 1.0}}, looking(Pose{}),
                  0.0, 1.0, selection);
    int found = -1;
    for (const SolidDraw& draw : selection.draws)
      if (model.parts()[draw.part].chosen_by >= 0) found = model.parts()[draw.part].level;
    return found;
  };
  EXPECT_EQ(level(0.205), 0);
  EXPECT_EQ(level(0.195), 1);
  EXPECT_EQ(level(0.051), 1);
  EXPECT_EQ(level(0.049), 2);
  EXPECT_EQ(level(0.0102), 2);
  EXPECT_EQ(level(0.0098), -1);
}

// Control seen: time left out of nodes_at().
TEST(SolidInstances, WhatTheFileMovesMoves) {
  const PlacedModel still = test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), plain);
  auto moving = std::make_shared<SolidModel>(still.model());
  SolidChannel channel;
  channel.times_s = {0.0f, 2.0f};
  channel.values = {glm::vec4(0.0f), glm::vec4(4.0f, 0.0f, 0.0f, 0.0f)};
  moving->animations.push_back({"over", {channel}, 2.0});
  const std::vector<PlacedModel> models{PlacedModel(moving)};
  const std::vector<SolidThing> things{{0, Pose{{0.0, 0.0, -30.0}}, 1.0}};
  SolidSelection selection;
  for (const double time_s : {0.0, 0.5, 1.5, 2.5}) {
    select_solids(models, things, looking(Pose{}), time_s, 1.0, selection);
    ASSERT_EQ(selection.instances.size(), 1u);
    EXPECT_NEAR(selection.instances[0].row_x.w, 2.0 * std::fmod(time_s, 2.0), 1e-5) << time_s;
  }
}

// Once there is room, choosing what is drawn of things that move takes no memory. Control seen: the room made anew in
// nodes_at().
TEST(SolidInstances, WhatMovesTakesNoMemory) {
  if (!test::AllocationCounter::counts) GTEST_SKIP() << "the sanitizer counts";
  const char* const nodes = R"({"children":[1,2]},{"mesh":0},{"mesh":0,"translation":[0,1,0]})";
  const PlacedModel still = test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), plain, nodes);
  auto moving = std::make_shared<SolidModel>(still.model());
  SolidChannel channel;
  channel.node = 1;
  channel.times_s = {0.0f, 2.0f};
  channel.values = {glm::vec4(0.0f), glm::vec4(4.0f, 0.0f, 0.0f, 0.0f)};
  moving->animations.push_back({"over", {channel}, 2.0});
  const std::vector<PlacedModel> models{PlacedModel(moving)};
  const std::vector<SolidThing> things{{0, Pose{{0.0, 0.0, -30.0}}, 1.0}, {0, Pose{{1.0, 0.0, -20.0}}, 1.0}};
  const Viewpoint viewpoint = looking(Pose{});
  SolidSelection selection;
  select_solids(models, things, viewpoint, 0.0, 1.0, selection);
  const test::AllocationCounter counter;
  for (int i = 1; i < 50; ++i) select_solids(models, things, viewpoint, 0.1 * i, 1.0, selection);
  EXPECT_EQ(counter.ours(), 0u);
  EXPECT_EQ(selection.instances.size(), 4u);
}

// For what lets light through. Controls seen: near things first.
TEST(SolidInstances, FarThingsComeFirst) {
  const PlacedModel box = test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), plain);
  const std::vector<PlacedModel> models{box, box};
  const std::vector<SolidThing> things{{0, Pose{{0.0, 0.0, -5.0}}, 1.0},
                                       {1, Pose{{0.0, 0.0, -20.0}}, 1.0},
                                       {0, Pose{{0.0, 0.0, -9.0}}, 1.0},
                                       {0, Pose{{0.0, 0.0, -7.0}}, 1.0}};
  SolidSelection selection;
  select_solids(models, things, looking(Pose{}), 0.0, 1.0, selection);
  ASSERT_EQ(selection.far_first.size(), 2u);
  EXPECT_EQ(selection.draws[selection.far_first[0]].model, 1u);
  std::vector<float> z;
  for (const gpu::SolidInstance& one : selection.instances) z.push_back(one.row_z.w);
  EXPECT_EQ(z, (std::vector<float>{-9.0f, -7.0f, -5.0f, -20.0f}));
}

// Near the water a line of sight that began in it ends at nothing above its crests without passing the surface, and one
// that began in air at nothing below its troughs; through portals alone water is seen, and no farther than it shows
// anything. A draw of several things has what any of them needs, in water from the farthest on that does. Controls
// seen: each bound's sign turned round; the last thing's alone; a tenth of a part's height; neither portals asked nor
// air that comes up; dry hulls taken for such air; no limit of sight; a ball's middle for its near side; in water all
// instances.
TEST(SolidInstances, DrawsKnowThroughWhichWaterTheyAreSeen) {
  const std::vector<PlacedModel> models{test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), plain)};
  const auto seen = [&](const std::vector<glm::dvec3>& places, const NearWaterSight& water) {
    std::vector<SolidThing> things;
    for (const glm::dvec3& place : places) things.push_back({0, Pose{place}, 1.0});
    SolidSelection selection;
    select_solids(models, things, looking(Pose{}), 0.0, 1.0, selection, water);
    EXPECT_EQ(selection.draws.size(), 1u);
    return std::pair(selection.draws.front().through_air, selection.draws.front().through_water);
  };
  using Seen = std::pair<bool, std::size_t>;
  const glm::dvec3 high(0.0, 3.0, -12.0), low(0.0, -3.0, -12.0), nearer(0.0, 0.0, 2.0);
  const NearWaterSight waves{1.0};
  EXPECT_EQ(seen({high}, waves), Seen(true, 0));
  EXPECT_EQ(seen({low}, waves), Seen(false, 1));
  EXPECT_EQ(seen({{2.0, 1.4, -12.0}}, waves), Seen(true, 1)) << "its lower end is in the crests";
  EXPECT_EQ(seen({{2.0, -1.4, -12.0}}, waves), Seen(true, 1)) << "its upper end is in the troughs";
  EXPECT_EQ(seen({high, low + nearer}, waves), Seen(true, 1)) << "the nearer one alone";
  EXPECT_EQ(seen({low, high + nearer}, waves), Seen(true, 2));
  EXPECT_EQ(seen({low}, {}), Seen(true, 1));
  EXPECT_EQ(seen({low}, {.highest_m = 1.0, .high_air = true}), Seen(true, 1));
  EXPECT_EQ(seen({high}, {.highest_m = 1.0, .high_air = true}), Seen(true, 1));
  EXPECT_EQ(seen({low}, {.highest_m = 1.0, .deep_air = true}), Seen(true, 1));
  EXPECT_EQ(seen({high}, {.highest_m = 1.0, .deep_air = true}), Seen(true, 0));
  EXPECT_EQ(seen({low, low + nearer}, {.highest_m = 1.0, .sight_m = 11.0}), Seen(false, 1)) << "too far in such water";
  EXPECT_EQ(seen({low}, {.highest_m = 1.0, .sight_m = 12.0}), Seen(false, 1)) << "its near side is not";
  PortalSight portal;
  portal.add(glm::dvec3(0.0), {0.0, -1.0, -4.0}, 0.3);
  const NearWaterSight through{.highest_m = 1.0, .portals = &portal};
  EXPECT_EQ(seen({low}, through), Seen(true, 1));
  EXPECT_EQ(seen({high}, through), Seen(true, 0));
}

}  // namespace
}  // namespace seascape
