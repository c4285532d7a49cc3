// A lamp's beam in even water against sums that are as fine as they have to be. Controls are named beside each test;
// each was seen to fail.
#include "shaders/shared/lamp_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace seascape {
namespace {

constexpr double pi = 3.14159265358979323846;

// A line of sight from the eye at the origin, a lamp and its water.
struct Line {
  glm::dvec3 lamp_m, ray, beam;
  double narrowness, attenuation, way_m;
  double passes() const { return glm::dot(lamp_m, ray); }
  double apart() const {
    return std::sqrt(std::max(glm::dot(lamp_m, lamp_m) - passes() * passes(),
                              double(gpu::lamp_radius_m) * double(gpu::lamp_radius_m)));
  }
};

// What a metre of it scatters at t metres, for an intensity and a scattering of 1: the light falls off as the square of
// the distance and by the attenuation there and back (Beer), and is scattered as Henyey and Greenstein (1941) have it.
double at(const Line& line, double t) {
  const double off = t - line.passes(), range = std::hypot(off, line.apart()),
               cosine = (t * glm::dot(line.ray, line.beam) - glm::dot(line.lamp_m, line.beam)) / range,
               g = double(gpu::water_forward), turned = -off / range;
  const double phase = (1.0 - g * g) / (4.0 * pi * std::pow(1.0 + g * g - 2.0 * g * turned, 1.5));
  return std::exp(line.narrowness * (std::min(cosine, 1.0) - 1.0)) / (range * range) * phase *
         std::exp(-line.attenuation * (range + t));
}

// Simpson's rule, halved until it does not change.
double halved(const Line& line, double from, double to, double first, double middle, double last, double whole,
              int depth) {
  const double half = 0.5 * (from + to), a = at(line, 0.5 * (from + half)), b = at(line, 0.5 * (half + to)),
               left = (half - from) / 6.0 * (first + 4.0 * a + middle),
               right = (to - half) / 6.0 * (middle + 4.0 * b + last);
  if (depth == 0 || std::abs(left + right - whole) < 1e-13) return left + right;
  return halved(line, from, half, first, a, middle, left, depth - 1) +
         halved(line, half, to, middle, b, last, right, depth - 1);
}

double exactly(const Line& line) {
  double sum = 0.0;
  constexpr int pieces = 300;
  for (int i = 0; i < pieces; ++i) {
    const double a = line.way_m * std::pow(double(i) / pieces, 3.0),
                 b = line.way_m * std::pow(double(i + 1) / pieces, 3.0), first = at(line, a),
                 middle = at(line, 0.5 * (a + b)), last = at(line, b);
    sum += halved(line, a, b, first, middle, last, (b - a) / 6.0 * (first + 4.0 * middle + last), 20);
  }
  return sum;
}

template <class Real>
double by_nodes(const Line& line) {
  const auto passes = Real(line.passes()), apart = Real(line.apart()), along = Real(glm::dot(line.ray, line.beam)),
             ahead = Real(glm::dot(line.lamp_m, line.beam)), narrowness = Real(line.narrowness);
  const glm::vec<2, Real> reach =
      gpu::lamp_reach(passes, apart, along, ahead, narrowness, Real(line.attenuation), Real(line.way_m));
  if (!(reach.y > reach.x)) return 0.0;
  double sum = 0.0;
  for (int i = 0; i < gpu::lamp_nodes; ++i) {
    const glm::vec<2, Real> node = gpu::lamp_scattered(i, passes, apart, along, ahead, narrowness, reach.x, reach.y);
    sum += double(node.x) * std::exp(-line.attenuation * double(node.y));
  }
  return sum;
}

// 3,000 lines of sight by lamps at the head and in a hand, beams of 6 to 90 degrees, waters from the clearest to a
// harbour's, ways of 0.3 to 60 m. No line is off by more than 4 % of itself and 1.5e-4 1/m^2, where the
// brightest has 0.4; half of them are off by less than 0.1 %. Controls: the cosine's sign in the scattering; a node's
// share; the cone's far edge taken for its near one.
TEST(LampLight, TheBeamsSumIsAsGoodAsAFineOne) {
  std::mt19937 random(7);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  const auto around = [&](double spread) {
    std::normal_distribution<> normal(0.0, spread);
    return glm::dvec3{normal(random), normal(random), normal(random)};
  };
  std::vector<double> shares;
  double brightest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    Line line;
    line.narrowness = gpu::lamp_narrowness(std::cos(glm::radians(between(3.0, 45.0))));
    const bool head = i % 2 == 0;
    line.lamp_m = head ? glm::dvec3{between(-0.05, 0.05), between(0.05, 0.2), between(-0.1, 0.1)}
                       : glm::dvec3{between(-0.3, 0.3), between(-0.5, 0.0), between(-0.5, -0.2)};
    line.beam = glm::normalize(glm::dvec3(0.0, 0.0, -1.0) + around(head ? 0.06 : 0.5));
    line.ray = glm::normalize(glm::dvec3(0.0, 0.0, -1.0) + around(0.35));
    line.attenuation = std::exp(between(std::log(0.06), std::log(2.5)));
    line.way_m = std::exp(between(std::log(0.3), std::log(60.0)));
    const double expected = exactly(line), found = by_nodes<double>(line);
    brightest = std::max(brightest, expected);
    ASSERT_NEAR(found, expected, 0.04 * expected + 1.5e-4) << i;
    ASSERT_NEAR(by_nodes<float>(line), found, 1e-4 * found + 1e-8) << i;
    if (expected > 1e-5) shares.push_back(std::abs(found / expected - 1.0));
  }
  std::sort(shares.begin(), shares.end());
  EXPECT_GT(shares.size(), 1000u);
  EXPECT_LT(shares[shares.size() / 2], 1e-3);
  EXPECT_GT(brightest, 0.1);
}

// The beam is half as bright at half its angle, and its light over all directions is 2 pi I / k (1 - exp(-2 k)).
// Control: the whole angle for half of it.
TEST(LampLight, ItsBeamIsAsWideAsItsAngle) {
  for (const double deg : {4.0, 15.0, 60.0, 120.0}) {
    const double k = gpu::lamp_narrowness(std::cos(glm::radians(0.5 * deg)));
    EXPECT_NEAR(gpu::lamp_beam(std::cos(glm::radians(0.5 * deg)), k), 0.5, 1e-9);
    EXPECT_EQ(gpu::lamp_beam(1.0, k), 1.0);
    double sum = 0.0;
    constexpr int steps = 200000;
    for (int i = 0; i < steps; ++i) sum += gpu::lamp_beam(-1.0 + 2.0 * (i + 0.5) / steps, k) * 4.0 * pi / steps;
    EXPECT_NEAR(sum, 2.0 * pi / k * -std::expm1(-2.0 * k), 1e-4 * sum);
  }
}

}  // namespace
}  // namespace seascape
