// Boats that make waves in the sea: whatever the frames, each feels the others' wakes and does not ride on its own
// (facts/boats.md, hard cases (l) and (m)).
#include <gtest/gtest.h>

#include <cmath>

#include "ocean/bodies/sea_bodies.h"
#include "ocean/sea/sea.h"
#include "tests/support/body_waves.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

// Boats of 8 m on flat water, towed along -z at these speeds, 9 m apart.
struct Convoy {
  explicit Convoy(const std::vector<double>& speeds_mps, bool wakes = true) : sea(spec(wakes)) {
    std::vector<BodySpec> specs;
    const HullMesh mesh = test::wigley_hull(8.0, 1.6, 0.6, 0.5, 20, 6);
    for (std::size_t n = 0; n < speeds_mps.size(); ++n) {
      BodySpec body = test::even_body(mesh, 0.4 * test::rho);
      body.mass_centre_m.y = -0.2;
      body.drag = HullDrag{};
      body.at_m = {9.0 * double(n), 0.0, 0.0};
      body.velocity_mps = {0.0, 0.0, -speeds_mps[n]};
      const double m = body.mass.mass_kg;
      const glm::dmat3& i = body.mass.inertia_kg_m2;
      body.mass.added = Matrix6::diagonal({m, m, 0.1 * m, 0.8 * i[0][0], i[1][1], 0.2 * i[2][2]});
      body.damping = Matrix6::diagonal({m, 3.0 * m, 0.1 * m, 3.0 * i[0][0], 2.0 * i[1][1], i[2][2]});
      specs.push_back(body);
    }
    const std::size_t count = specs.size();
    HullMesh about = mesh;
    for (glm::dvec3& v : about.vertices) v -= specs.front().mass_centre_m;
    bodies = std::make_shared<SeaBodies>(BodySettings{}, specs, std::vector<BoatSpec>(count),
                                         std::vector<std::shared_ptr<const HullCourse>>(count),
                                         std::vector<BodyInsides>(count));
    const auto hull = std::make_shared<const HullWake>(about);
    for (std::size_t n = 0; n < count; ++n) {
      bodies->makes_waves(n, hull, 2.0);
      if (speeds_mps[n] > 0.0) bodies->tow(n);
    }
    sea.add(bodies);
    sea.advance(0.0, {});
  }
  static SeaSpec spec(bool wakes) {
    SeaSpec spec = test::spec_of(SeaState{}, {.resolution = 16, .cascades = 1});
    spec.has_waves = false;
    spec.felt_velocity = true;
    if (wakes) spec.wakes.emplace();
    return spec;
  }
  void run(double seconds, const std::vector<double>& frames_s) {
    const double end = time + seconds;
    for (std::size_t i = 0; time < end - 1e-9; ++i) {
      time = std::min(end, time + frames_s[i % frames_s.size()]);
      sea.advance(time, {30.0, 2.0, 5.0});
    }
  }
  double height(std::size_t n) const { return bodies->bodies().result()[n].motion.centre_m.y; }
  Sea sea;
  std::shared_ptr<SeaBodies> bodies;
  double time = 0.0;
};

// The same waves, boats and foam at 20 Hz, 72 Hz and irregular frames. Control seen: sources left out in every seventh
// step that any sea takes.
TEST(SeaWakes, AreTheSameAtAnyFrameRate) {
  const auto lived = [](const std::vector<double>& frames_s) {
    Convoy convoy({3.0, 0.0});
    convoy.run(3.0, frames_s);
    return convoy.sea.hash();
  };
  const std::uint64_t once = lived({1.0 / 60.0});
  EXPECT_EQ(lived({1.0 / 20.0}), once);
  EXPECT_EQ(lived({1.0 / 72.0}), once);
  EXPECT_EQ(lived({0.004, 0.13, 0.0171}), once);
}

// At steady speed on flat water a boat alone trims steadily, as she does where nobody makes waves: her own are not
// under her. At rest she sleeps, though the
// ripples of her settling have not left. Controls seen: her own window asked for; her own ripples keep her awake.
TEST(SeaWakes, NobodyRidesOnHisOwn) {
  Convoy with({4.0}), without({4.0}, false);
  for (Convoy* convoy : {&with, &without}) convoy->run(14.0, {1.0 / 60.0});
  double least = 1e9, most = -1e9;
  for (int i = 0; i < 120; ++i) {
    with.run(1.0 / 60.0, {1.0 / 60.0});
    least = std::min(least, with.height(0)), most = std::max(most, with.height(0));
  }
  without.run(2.0, {1.0 / 60.0});
  EXPECT_LT(most - least, 1e-3);
  EXPECT_NEAR(with.height(0), without.height(0), 1e-3);
  ASSERT_NE(with.sea.view_at(with.time, SeaDetail::felt).wakes(), nullptr) << "she makes waves";

  Convoy still({0.0});
  still.run(30.0, {1.0 / 60.0});
  EXPECT_TRUE(still.bodies->bodies().result()[0].asleep);
}

// One who lies beside the way of another is moved by her wake. Control seen: wakes left out of what is felt.
TEST(SeaWakes, OthersAreMovedByThem) {
  Convoy with({4.0, 0.0}), without({4.0, 0.0}, false);
  double most = 0.0;
  for (int i = 0; i < 60 * 8; ++i) {
    for (Convoy* convoy : {&with, &without}) convoy->run(1.0 / 60.0, {1.0 / 60.0});
    most = std::max(most, std::abs(with.height(1) - without.height(1)));
  }
  EXPECT_GT(most, 0.01);
}

}  // namespace
}  // namespace seascape
