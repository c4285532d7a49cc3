// Hulls that keep water out of things: as queries find them, what a scene calls for because of them, and their limits.
#include "app/scene_hulls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/camera_path.h"
#include "app/sea_remarks.h"
#include "app/sea_spec.h"
#include "engine/error.h"
#include "ocean/sea/sea.h"

namespace seascape {
namespace {

using testing::HasSubstr;

Scene scene_of(const std::string& objects, const std::string& effects = "\"models\"", const std::string& more = "") {
  return parse_scene("{\"version\": 1, \"effects\": [" + effects + "], " + more + "\"objects\": [" + objects + "]}",
                     "s.json", "low");
}

QueryAnswer answer(const Scene& scene, glm::dvec2 at) {
  Sea sea(sea_spec(scene));
  sea.advance(3.0, glm::dvec3(0.0));
  return sea.view_at(3.0, SeaDetail::drawn).query(at);
}

bool clips(const Scene& scene, glm::dvec2 at) { return answer(scene, at).clipped; }

// A rowing boat of 3.2 m, half 0.6 m wide: dry amidships, wet beside it; turned, it is dry where its bow is now; rolled
// on its side, not where its other side was; twice as large, further out; held over the water or sunk, nowhere.
// Controls seen: hull_body() without orientation; without scale.
TEST(SceneHulls, KeepWaterOutWhereTheThingStands) {
  const auto boat = [](const std::string& pose, const std::string& at = "[20, 0, -30]") {
    return scene_of(R"({"model": "rowing_boat", "at_m": )" + at + pose + "}");
  };
  const Scene still = boat("");
  EXPECT_TRUE(clips(still, {20.0, -30.0}));
  EXPECT_TRUE(clips(still, {20.0, -31.0}));
  EXPECT_FALSE(clips(still, {20.8, -30.0}));
  EXPECT_FALSE(clips(still, {21.0, -30.0}));
  const Scene turned = boat(R"(, "yaw_deg": 90)");
  EXPECT_TRUE(clips(turned, {21.0, -30.0}));
  EXPECT_FALSE(clips(turned, {20.0, -31.0}));
  const Scene rolled = boat(R"(, "roll_deg": 45)"), pitched = boat(R"(, "pitch_deg": 12)");
  EXPECT_FALSE(clips(rolled, {19.6, -30.0})) << "its port side is in the air";
  EXPECT_TRUE(clips(rolled, {20.4, -30.0}));
  EXPECT_FALSE(clips(pitched, {20.0, -31.0})) << "the bow up";
  EXPECT_TRUE(clips(pitched, {20.0, -29.0}));
  EXPECT_TRUE(clips(boat(R"(, "scale": 2)"), {20.8, -30.0}));
  EXPECT_FALSE(clips(boat("", "[20, 0.3, -30]"), {20.0, -30.0}));
  EXPECT_FALSE(clips(boat("", "[20, -2, -30]"), {20.0, -30.0}));
}

// Each of those that are scattered, and both hulls of a model that has two. Control seen: only the first hull of a
// model.
TEST(SceneHulls, EachThingHasAllOfItsHulls) {
  const Scene scene = scene_of(
      R"({"model": "rowing_boat", "at_m": [0, 0, 0], "count": 30, "area_m": [200, 200]}, {"model": "yacht", "at_m": [300, 0, 0]},
                  {"model": "crate", "at_m": [310, 0, 0]})");
  const ClipRoom room = hulls_of(scene);
  EXPECT_EQ(room.hulls.size(), 3u);
  ASSERT_EQ(room.still.size(), 32u);
  Sea sea(sea_spec(scene));
  for (std::size_t i = 0; i < 30; ++i) {
    const glm::dvec3 at = scene.objects.things[i].pose.position_m;
    EXPECT_TRUE(sea.view_at(0.0, SeaDetail::felt).query({at.x, at.z}).clipped) << i;
  }
  EXPECT_EQ(room.still[31].hull, 2);
}

// Over a bed the water within a hull is taken away, but the bed does not lie dry: the height stays that of the water.
// Control seen: ClipVolumes::dry() that asks hulls of bodies too.
TEST(SceneHulls, OverABedTheWatersHeightStays) {
  const Scene scene = scene_of(R"({"model": "rowing_boat", "at_m": [20, 0, -30]})", R"("models", "sea_depth")",
                               R"("waves": {"depth_m": 4},)");
  const QueryAnswer within = answer(scene, {20.0, -30.0});
  EXPECT_TRUE(within.clipped);
  EXPECT_NEAR(within.height_m, 0.0, 0.01);
  EXPECT_NEAR(within.depth_m, 4.0, 0.01);
}

// `clip` is there because of the hulls, and only where water may reach one. Controls seen: called_for() that looks at
// the names alone; things at any height.
TEST(SceneHulls, CallForClipOnlyWhereWaterMayReachThem) {
  const Scene boat = scene_of(R"({"model": "rowing_boat", "at_m": [0, 0, 0]})");
  EXPECT_TRUE(calls_for(boat, "clip"));
  const EffectEntry last = called_for(boat).back();
  EXPECT_EQ(last.name, "clip");
  EXPECT_THAT(last.because, HasSubstr("objects"));
  EXPECT_FALSE(calls_for(scene_of(R"({"model": "crate", "at_m": [0, 0, 0]})"), "clip"));
  EXPECT_EQ(sea_spec(scene_of(R"({"model": "crate", "at_m": [0, 0, 0]})")).place.volumes, nullptr);
  const std::string high = R"({"model": "rowing_boat", "at_m": [0, 500, 0]})";
  EXPECT_FALSE(calls_for(scene_of(high), "clip"));
  EXPECT_TRUE(calls_for(scene_of(high, R"("models", "level")"), "clip")) << "a level may lie there";
  Scene without = boat;
  without.effects = {"waves"};
  EXPECT_FALSE(calls_for(without, "clip")) << "without models there is nothing to keep dry";
  EXPECT_NE(sea_key(without), sea_key(boat));
}

// Control seen: the check left out.
TEST(SceneHulls, MoreThanASeaTakesIsAFault) {
  EXPECT_NO_THROW(scene_of(R"({"model": "rowing_boat", "at_m": [0, 0, 0], "count": 4096, "area_m": [5000, 5000]})"));
  try {
    scene_of(R"({"model": "rowing_boat", "at_m": [0, 0, 0], "count": 4097, "area_m": [5000, 5000]})");
    ADD_FAILURE();
  } catch (const Error& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("4097 inside hulls"));
  }
}

// Of 40 boats with two hulls each the first 32 keep water out, and a remark names the next; of 32 there is none.
// Control seen: things counted instead of hulls.
TEST(SceneHulls, WhatTheSeaIsNotCutOutOfIsTold) {
  const auto fleet = [](int count) {
    return scene_of(R"({"model": "yacht", "at_m": [0, 0, 0], "count": )" + std::to_string(count) +
                        R"(, "area_m": [900, 900], "float": {}}, {"model": "crate", "at_m": [0, 0, 9], "float": {}})",
                    R"("models", "boats")");
  };
  EXPECT_THAT(remarks_of(fleet(32)), testing::IsEmpty());
  const std::vector<std::string> remarks = remarks_of(fleet(40));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_THAT(remarks[0], HasSubstr("cut out of 64 inside hulls"));
  EXPECT_THAT(remarks[0], HasSubstr("8 more things, from 'yacht 33' on"));
}

}  // namespace
}  // namespace seascape
