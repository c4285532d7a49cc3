#include "ocean/bodies/hull_wake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <vector>

#include "tests/support/body_waves.h"
#include "tests/support/hull_wake_truth.h"

namespace seascape {
namespace {

using namespace test;

double flow(const WaveSource& s) { return s.rise_mps * s.length_m * s.length_m / std::numbers::pi; }

std::vector<WaveSource> sources_of(
    const HullWake& wake, const HullMotion& motion, double least_m = 0.5,
    const HullWake::Height& height = [](const glm::dvec2&) { return 0.0; }) {
  std::vector<HullSection> cut(std::size_t(wake.sections()));
  std::vector<WaveSource> sources;
  wake.cut(motion, height, cut);
  wake.add_sources(motion, cut, least_m, sources);
  return sources;
}

HullMotion ahead(double speed_mps, double degrees = 0.0) {
  const double turn = -degrees * std::numbers::pi / 180.0;  // courses are counted clockwise seen from above
  HullMotion motion;
  motion.pose.to_world = about({0.0, 1.0, 0.0}, turn);
  motion.velocity.linear = speed_mps * (motion.pose.to_world * glm::dvec3(0.0, 0.0, -1.0));
  return motion;
}

// The drag of the waves that the sources send, by what each of them sends in every direction.
double drag_of(std::span<const WaveSource> sources, const HullMotion& motion) {
  const glm::dvec3 v = motion.velocity.linear;
  const double u = std::hypot(v.x, v.z);
  const glm::dvec2 along(v.x / u, v.z / u), across(-along.y, along.x);
  return truth::wave_drag(u, g, rho, [&](double kx, double kz) {
    std::complex<double> sum = 0.0;
    for (const WaveSource& s : sources) {
      const double k = std::hypot(kx, kz);
      sum += flow(s) * std::polar(std::exp(-k * s.depth_m - std::pow(k * s.length_m / (2.0 * truth::pi), 2)),
                                  glm::dot(kx * along + kz * across, s.place_m));
    }
    return sum;
  });
}

double michell(double u) {
  return truth::wave_drag(u, g, rho,
                          [&](double kx, double kz) { return truth::wigley_sends(10.0, 1.0, 0.625, u, kx, kz); });
}

// Michell's integral gives facts/boats.md's figures: coefficients on the wetted surface, 14.879 m^2.
TEST(HullWake, MichellsIntegralIsThatOfTheBooks) {
  for (const auto& [froude, coefficient] : {std::pair{.25, 1.064e-3},
                                            {.30, 2.142e-3},
                                            {.35, 1.248e-3},
                                            {.40, 2.734e-3},
                                            {.50, 4.517e-3},
                                            {1.0, 1.836e-3}}) {
    const double u = froude * std::sqrt(10.0 * g);
    EXPECT_NEAR(michell(u) / (0.5 * rho * u * u * 14.8791), coefficient, 0.003 * coefficient) << froude;
  }
}

// The sources of Wigley's hull make its waves: their drag is Michell's within 4 % at 20 sections, on any course, and
// within 10 % where no source is shorter than 1 m. Controls: the mean
// depth alone; sections of breadth times draught; parts a tenth longer; all seen.
TEST(HullWake, SourcesMakeMichellsDrag) {
  const HullWake wake(wigley_hull(10.0, 1.0, 0.625, 0.4, 64, 40), 20);
  for (const double froude : {0.25, 0.30, 0.35, 0.40, 0.5, 0.8, 1.0}) {
    const double u = froude * std::sqrt(10.0 * g), want = michell(u);
    for (const double course : {0.0, 17.0, 45.0, 90.0}) {
      const HullMotion motion = ahead(u, course);
      EXPECT_NEAR(drag_of(sources_of(wake, motion), motion) / want, 1.0, 0.04) << froude << " " << course;
    }
    EXPECT_NEAR(drag_of(sources_of(wake, ahead(u), 1.0), ahead(u)) / want, 1.0, 0.1) << froude;
  }
}

// A hull that lies still in still water pushes nothing, and one that drifts with its water neither, to the bit; under
// way on flat water it pushes the same at any place and time. Controls: the water's own velocity forgotten;
// seen.
TEST(HullWake, AtRestNothingAndUnderWaySteady) {
  const HullWake wake(wigley_hull(10.0, 1.0, 0.625, 0.4, 64, 40));
  HullMotion still = ahead(0.0, 30.0);
  EXPECT_TRUE(sources_of(wake, still).empty());
  still.velocity.linear = still.water_mps = {0.7, 0.0, -0.3};
  EXPECT_TRUE(sources_of(wake, still).empty());
  HullMotion motion = ahead(3.0);
  const std::vector<WaveSource> first = sources_of(wake, motion);
  EXPECT_GT(first.size(), 10u);
  motion.pose.centre_m.z -= 64.0;
  const std::vector<WaveSource> later = sources_of(wake, motion);
  ASSERT_EQ(first.size(), later.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].rise_mps, later[i].rise_mps);
    EXPECT_EQ(first[i].depth_m, later[i].depth_m);
    EXPECT_EQ(first[i].velocity_mps, glm::dvec2(0.0, -3.0));
  }
}

double sum_of(std::span<const WaveSource> sources) {
  double sum = 0.0;
  for (const WaveSource& s : sources) sum += flow(s);
  return sum;
}

// Of the hull's volume as the sections have it.
double volume(const HullWake& wake, const HullMotion& motion, const HullWake::Height& height, double length) {
  std::vector<HullSection> cut(std::size_t(wake.sections()));
  wake.cut(motion, height, cut);
  double sum = 0.0;
  for (const HullSection& s : cut) sum += s.area_m2 * length / wake.sections();
  return sum;
}

// Together the sources give what the hull comes to displace: none going ahead or sideways, and going down, pitching and
// rolling the change of its volume under water, on waves and heeled too. Controls: the spin left out;
// two sources sideways and no sink; both seen.
TEST(HullWake, SumsToTheChangeOfWhatIsDisplaced) {
  const HullWake wake(wigley_hull(10.0, 1.0, 0.625, 0.4, 64, 40), 40);
  const HullWake::Height waves = [](const glm::dvec2& at) { return 0.05 * std::sin(0.8 * at.y + 0.3 * at.x); };
  const double scale = 4.2 * 0.4;  // of the strongest flow
  EXPECT_NEAR(sum_of(sources_of(wake, ahead(4.2, 33.0))), 0.0, 1e-12 * scale);
  HullMotion sideways;
  sideways.velocity.linear = {0.8, 0.0, 0.0};
  EXPECT_GT(sources_of(wake, sideways).size(), 10u);
  EXPECT_NEAR(sum_of(sources_of(wake, sideways)), 0.0, 1e-12);
  for (const double heel : {0.0, 0.4, 2.9}) {
    HullMotion motion;
    motion.pose.to_world = about({0.0, 0.0, 1.0}, heel);
    for (int axis = 0; axis < 3; ++axis) {
      motion.velocity = {};
      (axis == 0 ? motion.velocity.linear.y : axis == 1 ? motion.velocity.angular.x : motion.velocity.angular.z) = 0.2;
      constexpr double dt = 1e-3;
      HullMotion before = motion, after = motion;
      for (HullMotion* moved : {&before, &after}) {
        const double t = moved == &after ? 0.5 * dt : -0.5 * dt;
        moved->pose.centre_m += t * motion.velocity.linear;
        const double spin = glm::length(motion.velocity.angular);
        if (spin > 0.0) moved->pose.to_world = about(motion.velocity.angular / spin, spin * t) * moved->pose.to_world;
      }
      const double change = (volume(wake, after, waves, 10.0) - volume(wake, before, waves, 10.0)) / dt;
      EXPECT_NEAR(sum_of(sources_of(wake, motion, 0.5, waves)), change, 0.01) << heel << " " << axis;
      if (axis == 0) {
        EXPECT_LT(change, -0.5);
      }
    }
  }
}

// Sections cut at any heel have the volume that the clipped mesh has. Control: lines that go on above the waterline;
// seen.
TEST(HullWake, SectionsHoldTheHullsVolume) {
  const HullMesh hull = wigley_hull(10.0, 1.0, 0.625, 0.4, 64, 40);
  const HullWake wake(hull, 64);
  for (const double heel : {0.0, 0.3, 1.2, 1.7, 3.1}) {
    HullMotion motion;
    motion.pose = {{0.3, 0.1, -2.0}, about({0.0, 1.0, 0.0}, 0.7) * about({0.0, 0.0, 1.0}, heel)};
    const double want = pressed(hull, motion.pose, FormulaWater{}, 10.0).submerged_m3;
    EXPECT_NEAR(volume(
                    wake, motion, [](const glm::dvec2&) { return 0.0; }, 10.0),
                want, 0.002 * want)
        << heel;
  }
}

// Hulls on end, high in the air, deep in the sea, and water that is no number: finite sources or none. Control:
// a depth that is the logarithm of what is below 0; seen.
TEST(HullWake, OddPosesAndWater) {
  const HullWake wake(wigley_hull(10.0, 1.0, 0.625, 0.4, 16, 8), 12);
  for (const double height : {-100.0, -0.3, 0.0, 50.0})
    for (const double pitch : {0.0, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.7, 1.5, 0.5 * std::numbers::pi}) {
      HullMotion motion;
      motion.pose = {{0.0, height, 0.0}, about({1.0, 0.0, 0.0}, pitch)};
      motion.velocity = {{1.0, 2.0, -3.0}, {0.1, 0.2, 0.3}};
      if (height == 0.0) motion.velocity = {{0.0, 0.0, -3.0}, {}};
      const double nan = std::nan("");
      for (const WaveSource& s : sources_of(wake, motion))
        EXPECT_TRUE(std::isfinite(s.rise_mps + s.depth_m + s.place_m.x + s.place_m.y + s.velocity_mps.x) &&
                    s.length_m > 0.0);
      EXPECT_TRUE(sources_of(wake, motion, 0.5, [&](const glm::dvec2&) { return nan; }).empty());
      if (height == 50.0) {
        EXPECT_TRUE(sources_of(wake, motion).empty());
      }
    }
}

}  // namespace
}  // namespace seascape
