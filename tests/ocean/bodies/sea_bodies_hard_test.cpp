// Bodies in a whole sea while nobody sees them, and while what is seen changes its levels of detail in every frame.
#include <gtest/gtest.h>

#include <cmath>

#include "ocean/bodies/sea_bodies.h"
#include "ocean/sea/sea.h"
#include "tests/support/body_waves.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

constexpr double step_s = 1.0 / 60.0;

// Somebody else who makes waves where the bodies are.
struct Drops final : SeaActor {
  void step(SeaStep& step) override {
    step.press({.place_m = {3.0, -5.0}, .length_m = 4.0, .head_m = 0.2 * std::sin(3.0 * step.time_s)});
  }
};

// Four boxes on a breeze's waves, two of them by their hulls.
struct Afloat {
  explicit Afloat(bool viewers_waves = false) : sea(spec(viewers_waves)) {
    std::vector<BodySpec> specs;
    for (int n = 0; n < 4; ++n) {
      BodySpec body = test::even_body(box_hull({2.0, 1.0, 4.0}), 0.45 * test::rho);
      body.drag = HullDrag{};
      body.level = BodyLevel(n % 2);
      body.at_m = {7.0 * n, 0.05, -5.0};
      const double m = body.mass.mass_kg;
      body.mass.added = Matrix6::diagonal({m, m, 0.2 * m, m, m, 0.2 * m});
      body.damping = Matrix6::diagonal({m, 2.0 * m, 0.1 * m, 2.0 * m, m, 2.0 * m});
      specs.push_back(body);
    }
    bodies =
        std::make_shared<SeaBodies>(BodySettings{}, specs, std::vector<BoatSpec>(4),
                                    std::vector<std::shared_ptr<const HullCourse>>(4), std::vector<BodyInsides>(4));
    sea.add(bodies);
    if (viewers_waves) sea.add(std::make_shared<Drops>());
    sea.advance(0.0, {});
  }
  static SeaSpec spec(bool viewers_waves) {
    SeaState state;
    state.wind_speed_mps = 8.0;
    state.fetch_m = 30e3;
    SeaSpec spec = test::spec_of(state, {.resolution = 32, .cascades = 3});
    spec.felt_velocity = true;
    if (viewers_waves) {
      spec.dynamic_waves.emplace();
      spec.dynamic_waves->waves.windows = {.resolution = 64, .slices = 2, .texel_m = 0.5};
    }
    return spec;
  }
  void run(double to_s, double frame_s, const glm::dvec3& viewer = glm::dvec3(0.0)) {
    while (time < to_s - 1e-9) time = std::min(time + frame_s, to_s), sea.advance(time, viewer);
  }
  std::vector<Pose> poses() const {
    std::vector<Pose> all;
    for (std::size_t n = 0; n < bodies->size(); ++n) all.push_back(bodies->pose_at(n, time));
    return all;
  }
  Sea sea;
  std::shared_ptr<SeaBodies> bodies;
  double time = 0.0;
};

// Bodies in a whole sea while the window is hidden, the headset is off and the device lost. Hidden, the clock stands:
// they go on to the same bits as if nobody had hidden it. Off for three minutes, time goes on: they hold where they
// are, tell of nothing, and then float on without a jump. After a lost device the scene is made anew, and its bodies
// come to the same bits. Controls seen: steps made while the clock stands; held bodies carried on by their velocity.
TEST(SeaBodiesHard, hard_42_bodies_while_nobody_looks) {
  Afloat shown, hidden, anew;
  shown.run(6.0, 1.0 / 72.0);
  hidden.run(3.0, 1.0 / 72.0);
  for (int i = 0; i < 200; ++i) hidden.sea.advance(hidden.time, {double(i), 2.0, 0.0});
  hidden.run(6.0, 1.0 / 72.0);
  EXPECT_EQ(hidden.bodies->hash(), shown.bodies->hash());
  anew.run(6.0, 1.0 / 90.0);
  EXPECT_EQ(anew.bodies->hash(), shown.bodies->hash());

  Afloat& off = shown;
  off.bodies->take_events();
  const std::vector<Pose> before = off.poses();
  const int holds = off.bodies->holds();
  off.time += 180.0;
  off.sea.advance(off.time, {});
  EXPECT_EQ(off.bodies->holds(), holds + 1);
  EXPECT_TRUE(off.bodies->take_events().empty());
  const std::vector<Pose> held = off.poses();
  for (std::size_t n = 0; n < held.size(); ++n) {
    EXPECT_LT(glm::length(held[n].position_m - before[n].position_m), 0.05) << n;
    // As the last step left it, so that nothing is seen to move on.
    EXPECT_EQ(held[n].position_m, off.bodies->bodies().result()[n].at_m) << n;
  }
  double fastest = 0.0;
  for (int i = 0; i < 240; ++i) {
    off.run(off.time + step_s, step_s);
    for (const BodyState& state : off.bodies->bodies().result()) {
      ASSERT_FALSE(state.lost);
      fastest = std::max(fastest, glm::length(state.motion.velocity.linear));
    }
  }
  EXPECT_LT(fastest, 3.0);
  for (std::size_t n = 0; n < held.size(); ++n)
    EXPECT_LT(glm::length(off.poses()[n].position_m - held[n].position_m), 8.0) << n;
}

// The water's velocity is asked, never differenced: a viewer who is somewhere else in every frame, so that windows and
// levels of detail change beneath the bodies each time, changes no bit of them, and no step changes a body's velocity
// by more than twice what its weight could (boats.md, hard case (g): at a change of level differences gave 40 m/s).
// Control seen: the viewer's waves felt (SeaWater's viewer_waves).
TEST(SeaBodiesHard, g_VelocitiesOverChangesOfLevel) {
  Afloat still(true), jumping(true);
  const glm::dvec3 places[] = {{0.0, 2.0, 0.0}, {9.0, 60.0, -4.0}, {400.0, 300.0, -300.0}, {5.0, 1.0, -6.0}};
  std::vector<glm::dvec3> last(still.bodies->size(), glm::dvec3(0.0));
  double most = 0.0;
  for (int i = 1; i <= 300; ++i) {
    still.run(i * step_s, step_s, places[0]);
    jumping.run(i * step_s, step_s, places[i % 4]);
    ASSERT_EQ(jumping.bodies->hash(), still.bodies->hash()) << i;
    for (std::size_t n = 0; n < last.size(); ++n) {
      const glm::dvec3& now = jumping.bodies->bodies().result()[n].motion.velocity.linear;
      if (i > 60) most = std::max(most, glm::length(now - last[n]));
      last[n] = now;
    }
  }
  EXPECT_LT(most, 2.0 * test::g * step_s);
  EXPECT_GT(most, 0.001) << "they move";
}

}  // namespace
}  // namespace seascape
