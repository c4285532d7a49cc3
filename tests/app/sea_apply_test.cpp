// Settings taken by a sea that runs (Sea::apply): it answers as one that is made with them, keeps what its steps have
// done, and goes on.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/sea_spec.h"
#include "engine/error.h"
#include "ocean/sea/sea.h"

namespace seascape {

namespace {

using Set = std::vector<std::pair<std::string, std::string>>;

void set_all(Scene& scene, const Set& set) {
  for (const auto& [key, value] : set) set_from_text(scene.settings, key, value, "test");
}

// The spec of a scene whose settings change, from the one that its sea has.
SeaSpec changed(Scene& scene, const Sea& sea, const Set& set) {
  const Settings before = scene.settings;
  set_all(scene, set);
  const MadeBefore made{before, sea.spec()};
  return sea_spec(scene, &made);
}

struct Case {
  const char* scene;
  Set set;
};
const std::vector<Case> cases{
    {"gerstner", {{"gerstner.set1_height_m", "1"}, {"gerstner.set2_to_deg", "10"}, {"gerstner.seed", "7"}}},
    {"rain_pool",
     {{"wave_particles.height_m", "0.01"},
      {"dynamic_waves.rain_per_m2_s", "1"},
      {"dynamic_waves.damping_per_s", "2"},
      {"dynamic_waves.sharpening", "0.3"},
      {"dynamic_waves.rate_hz", "40"}}},
    {"whirlpool", {{"level.height_m", "3"}, {"flow.speed_mps", "1.5"}, {"flow.to_deg", "40"}}},
    {"rivers", {{"level.height_m", "1"}, {"flow.period_s", "3"}}},
    {"lagoon", {{"gerstner.set1_height_m", "0.2"}, {"gerstner.set1_wavelength_m", "20"}, {"level.height_m", "0.5"}}},
    {"harbour_clip", {{"clip.by_default", "true"}}},
    {"baked", {{"baked.scale", "0.5"}, {"baked.weight", "0.7"}, {"baked.speed", "2"}}},
};

// Controls seen to fail: an apply without take_sources, take_places, dynamic_->apply or the change over a bed.
TEST(SeaApply, AnswersAsASeaThatIsMadeWithThem) {
  for (const Case& one : cases) {
    SCOPED_TRACE(one.scene);
    Scene scene = load_scene(one.scene, "low");
    Sea sea(sea_spec(scene));
    const glm::dvec3 viewer = scene.start.position_m;
    double time_s = 3.0;
    sea.advance(time_s, viewer);
    const SeaView held = sea.view_at(time_s, SeaDetail::felt);
    std::vector<glm::dvec2> places;
    for (int i = 0; i < 400; ++i) places.push_back({viewer.x + 7.3 * (i % 20 - 10), viewer.z + 6.1 * (i / 20 - 10)});
    std::vector<QueryAnswer> was(places.size()), still(places.size()), now(places.size()), fresh(places.size());
    held.query(places, was);
    SeaSpec spec = changed(scene, sea, one.set);
    ASSERT_TRUE(sea.takes(spec));
    sea.apply(std::move(spec));
    held.query(places, still);  // who holds a view keeps what it has
    for (int n = 0; n == 0 || sea.changing(); ++n) {
      ASSERT_LT(n, 1000);
      if (sea.changing()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      sea.advance(time_s += 0.25, viewer);
    }
    time_s += 100.0;  // dynamic waves begin anew
    sea.advance(time_s, viewer);
    Sea other(sea_spec(scene));
    other.advance(time_s, viewer);
    sea.view_at(time_s, SeaDetail::felt).query(places, now);
    other.view_at(time_s, SeaDetail::felt).query(places, fresh);
    int differ = 0, differ_from_before = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      differ += now[i].height_m != fresh[i].height_m || now[i].flow_mps != fresh[i].flow_mps ||
                now[i].clipped != fresh[i].clipped || now[i].depth_m != fresh[i].depth_m;
      differ_from_before += now[i].height_m != was[i].height_m;
      EXPECT_EQ(was[i].height_m, still[i].height_m);
    }
    EXPECT_EQ(differ, 0);
    EXPECT_GT(differ_from_before, 300);
  }
}

// What steps have done goes on: rain that has fallen keeps running in rings when it stops, and another rate goes on at
// the time that it is. Control seen: DynamicSea::apply that leaves tick_ at the old rate's count begins anew.
TEST(SeaApply, KeepsItsDynamicWaves) {
  Scene scene = load_scene("rain_pool", "low");
  Sea sea(sea_spec(scene));
  const glm::dvec3 viewer = scene.start.position_m;
  for (int n = 0; n <= 60; ++n) sea.advance(5.0 + n / 60.0, viewer);
  const double before = sea.dynamic_waves()->waves().energy_m2();
  ASSERT_GT(before, 0.0);
  SeaSpec spec = changed(scene, sea, {{"dynamic_waves.rain_per_m2_s", "1e-6"}, {"dynamic_waves.rate_hz", "20"}});
  ASSERT_TRUE(sea.takes(spec));
  sea.apply(std::move(spec));
  EXPECT_EQ(sea.dynamic_waves()->waves().energy_m2(), before);
  sea.advance(6.2, viewer);
  const double after = sea.dynamic_waves()->waves().energy_m2();
  EXPECT_EQ(sea.dynamic_waves()->tick(), 124);
  EXPECT_LT(after, before);
  EXPECT_GT(after, 0.2 * before);
}

// What needs other memory, images or shaders is refused. Control seen: a takes() that asks for has_waves alone.
TEST(SeaApply, RefusesWhatItCannotTakeAsItRuns) {
  const std::vector<Case> others{{"gerstner", {{"gerstner.set1_height_m", "0"}, {"gerstner.set2_height_m", "0"}}},
                                 {"rain_pool", {{"wave_particles.scales", "2"}}},
                                 {"rain_pool", {{"dynamic_waves.levels", "3"}}},
                                 {"rain_pool", {{"waves.depth_m", "3"}}},
                                 {"open_sea", {{"waves.gravity_mps2", "3"}}}};
  for (const Case& one : others) {
    SCOPED_TRACE(one.set[0].first);
    Scene scene = load_scene(one.scene, "low");
    Sea sea(sea_spec(scene));
    EXPECT_FALSE(sea.takes(changed(scene, sea, one.set)));
  }
  Scene scene = load_scene("gerstner", "low");
  Sea sea(sea_spec(scene));
  EXPECT_THROW(changed(scene, sea, {{"gerstner.set2_wavelength_m", "5"}}), Error);  // one tile has three octaves
}

}  // namespace

}  // namespace seascape
