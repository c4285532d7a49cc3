// Bodies as an actor of the one sea: where they float, that frames, viewers and threads do not matter, and what they
// keep dry.
#include "ocean/bodies/sea_bodies.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "ocean/sea/sea.h"
#include "tests/support/body_waves.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

SeaState breeze() {
  SeaState state;
  state.wind_speed_mps = 8.0;
  state.fetch_m = 30e3;
  return state;
}

SeaSpec spec_of(const SeaState& state, bool waves = true) {
  SeaSpec spec = test::spec_of(state, {.resolution = 32, .cascades = 3});
  spec.has_waves = waves;
  spec.felt_velocity = true;
  return spec;
}

std::shared_ptr<SeaBodies> fleet(int count) {
  std::vector<BodySpec> specs;
  for (int n = 0; n < count; ++n) {
    BodySpec body = test::even_body(box_hull({2.0, 1.0, 4.0}), 0.45 * test::rho);
    body.drag = HullDrag{};
    body.level = BodyLevel(n % 3);
    body.at_m = {7.0 * n, 0.05, -5.0};
    const double m = body.mass.mass_kg;
    body.mass.added = Matrix6::diagonal({m, m, 0.2 * m, m, m, 0.2 * m});
    body.damping = Matrix6::diagonal({m, 2.0 * m, 0.1 * m, 2.0 * m, m, 2.0 * m});
    specs.push_back(body);
  }
  return std::make_shared<SeaBodies>(BodySettings{}, specs, std::vector<BoatSpec>(std::size_t(count)),
                                     std::vector<std::shared_ptr<const HullCourse>>(std::size_t(count)),
                                     std::vector<BodyInsides>(std::size_t(count)));
}

// Somebody else who makes waves where the bodies are.
struct Drops final : SeaActor {
  void step(SeaStep& step) override {
    step.press({.place_m = {3.0, -5.0}, .length_m = 4.0, .head_m = 0.2 * std::sin(3.0 * step.time_s)});
  }
};

// What a sea has come to after some seconds in frames of these lengths, seen from somewhere.
std::uint64_t lived(double seconds, const std::vector<double>& frames_s, const glm::dvec3& viewer, bool dynamic = false,
                    std::vector<Pose>* poses = nullptr) {
  SeaSpec spec = spec_of(breeze());
  if (dynamic) {
    spec.dynamic_waves.emplace();
    spec.dynamic_waves->waves.windows = {.resolution = 64, .slices = 2, .texel_m = 0.5};
  }
  Sea sea(spec);
  const auto bodies = fleet(6);
  sea.add(bodies);
  if (dynamic) sea.add(std::make_shared<Drops>());
  double time = 0.0;
  sea.advance(0.0, viewer);
  for (std::size_t i = 0; time < seconds - 1e-9; ++i) {
    time = std::min(seconds, time + frames_s[i % frames_s.size()]);
    sea.advance(time, viewer);
  }
  if (poses != nullptr)
    for (std::size_t n = 0; n < bodies->size(); ++n) poses->push_back(bodies->pose_at(n, seconds));
  return bodies->hash();
}

// Frames of 20, 72 and 90 Hz and irregular ones, other viewers with dynamic waves around them, one thread or all: the
// same bits. Control seen: dynamic waves asked for.
TEST(SeaBodies, AreTheSameWhateverIsDrawn) {
  const std::uint64_t once = lived(4.0, {1.0 / 60.0}, {});
  EXPECT_EQ(lived(4.0, {1.0 / 20.0}, {}), once);
  EXPECT_EQ(lived(4.0, {1.0 / 72.0}, {}), once);
  EXPECT_EQ(lived(4.0, {1.0 / 90.0}, {500.0, 3.0, -40.0}), once);
  EXPECT_EQ(lived(4.0, {0.003, 0.11, 0.0171, 0.4}, {}), once);
  EXPECT_EQ(lived(4.0, {1.0 / 45.0}, {20.0, 1.0, 0.0}, true), once);
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(lived(4.0, {1.0 / 72.0}, {}), once);
}

// On a flat sea a box stands at the draught of its weight, on waves near the water that query answers. Control seen: a
// view of the step before.
TEST(SeaBodies, FloatOnTheWaterThatIsThere) {
  Sea flat(spec_of(breeze(), false));
  const auto still = fleet(3);
  flat.add(still);
  for (int i = 0; i <= 60 * 30; ++i) flat.advance(i / 60.0, {});
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_NEAR(still->pose_at(n, 30.0).position_m.y, 0.5 - 0.45, 1e-3) << n;
    EXPECT_TRUE(still->bodies().result()[n].asleep) << n;
  }

  Sea waves(spec_of(breeze()));
  const auto bodies = fleet(6);
  waves.add(bodies);
  double squares = 0.0, heights = 0.0;
  int count = 0;
  for (int i = 0; i <= 60 * 20; ++i) {
    waves.advance(i / 60.0, {});
    if (i < 600) continue;
    for (std::size_t n = 0; n < bodies->size(); ++n) {
      const glm::dvec3 at = bodies->pose_at(n, i / 60.0).position_m;
      const double water = waves.view_at(i / 60.0, SeaDetail::felt).query({at.x, at.z}, {.footprint_m = 3.0}).height_m;
      squares += std::pow(at.y - 0.05 - water, 2.0), heights += water * water, ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.45 * std::sqrt(heights / count));
}

// Between steps they are carried on: no frame at any time shows them jump. A jump of the time holds them where they
// are, and says so. Controls seen: carried on twice as far; not held.
TEST(SeaBodies, MoveSteadilyAndHoldOverJumps) {
  Sea sea(spec_of(breeze()));
  const auto bodies = fleet(3);
  sea.add(bodies);
  sea.advance(0.0, {});
  Pose before;
  double most = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double time = i / 400.0;
    sea.advance(time, {});
    const Pose now = bodies->pose_at(0, time);
    if (i > 1200) {
      const double moved = glm::length(now.position_m - before.position_m) * 400.0;
      most = std::max(most, std::abs(moved - glm::length(bodies->velocity_mps(0))));
    }
    before = now;
  }
  EXPECT_LT(most, 0.35) << "m/s off its own speed";
  const int holds = bodies->holds();
  sea.advance(500.0, {});
  EXPECT_EQ(bodies->holds(), holds + 1);
  EXPECT_LT(glm::length(bodies->pose_at(0, 500.0).position_m - before.position_m), 0.05);
  sea.advance(500.0 + 1.0 / 60.0, {});
  EXPECT_LT(glm::length(bodies->pose_at(0, 500.0 + 1.0 / 60.0).position_m - before.position_m), 0.3);
}

}  // namespace
}  // namespace seascape
