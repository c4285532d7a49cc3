// Particles that travel and split, against rings written down directly (tests/support/particle_truth.h).
#include "ocean/waves/travelling_particles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/expect_error.h"
#include "tests/support/particle_truth.h"

namespace seascape {
namespace {

TravellingSettings lasting() {
  return {.radius_m = 0.5, .speed_mps = 2.0, .least_amplitude_m = 0.0, .most_particles = 200000};
}

// A ring of as many bumps as it has come to: `pieces`, each tripled as often as its width at `distance` needs.
std::vector<truth::Bump> ring(double radius, double distance, double amplitude, int pieces) {
  int count = pieces;
  double each = amplitude;
  while (2.0 * truth::pi_of_bumps * distance / count > 0.5 * radius) count *= 3, each /= 3.0;
  std::vector<truth::Bump> list;
  // The first piece lies on the x axis, and so does the middle one of its thirds.
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * truth::pi_of_bumps * i / count;
    list.push_back({distance * std::cos(angle), distance * std::sin(angle), each});
  }
  return list;
}

// Control seen: a fourth instead of a third of the height.
TEST(TravellingParticles, AreTheRingThatTheyShouldHaveBecome) {
  TravellingParticles waves(lasting());
  ASSERT_TRUE(waves.add_ring({3.0, -2.0}, 1.0, 0.2, 12));
  for (const double after : {0.05, 0.3, 1.0, 4.0, 12.0}) {
    waves.advance(1.0 + after);
    const double distance = 2.0 * after;
    const std::vector<truth::Bump> want = ring(0.5, distance, 0.2, 12);
    ASSERT_EQ(waves.particles().size(), want.size()) << after;
    double worst = 0.0, crest = 0.0;
    for (int i = 0; i < 400; ++i) {
      const double angle = 0.0157 * i, d = distance + 0.6 * std::sin(1.7 * i);
      const glm::dvec2 place(d * std::cos(angle), d * std::sin(angle));
      const double truth_here = truth::bumps(want, 0.5, 0.0, place.x, place.y);
      crest = std::max(crest, truth_here);
      worst = std::max(worst, std::abs(waves.height_m(place + glm::dvec2(3.0, -2.0), 1.0 + after) - truth_here));
    }
    EXPECT_LE(worst, 1e-9 * crest) << after;
    EXPECT_NEAR(waves.amplitude_sum_m(), 12 * 0.2, 1e-6 * 12 * 0.2) << "thirds lose nothing";
    EXPECT_FALSE(waves.full());
  }
}

// The crest falls as 1 / distance, which is not the wave equation's 1 / sqrt(distance); no ring is thinner than half a
// radius, so that its crest ripples by no more than such a front's 3.5 % (half off the crest). Control seen: pieces
// split at a whole radius (5.9 and 7.5 %).
TEST(TravellingParticles, RingsFallAsOneOverDistance) {
  TravellingParticles waves(lasting());
  ASSERT_TRUE(waves.add_ring({0.0, 0.0}, 0.0, 1.0, 9));
  double first = 0.0;
  for (const double distance : {4.0, 8.0, 16.0, 32.0}) {
    const double time_s = distance / 2.0;
    waves.advance(time_s);
    double least = 1e9, most = 0.0, mean = 0.0;
    constexpr int steps = 500;
    for (int i = 0; i < steps; ++i) {
      const double angle = 0.3 * i / steps;
      const double h = waves.height_m((distance + 0.25) * glm::dvec2(std::cos(angle), std::sin(angle)), time_s);
      least = std::min(least, h);
      most = std::max(most, h);
      mean += h / steps;
    }
    EXPECT_LE((most - least) / mean, 0.04) << distance;
    if (first == 0.0) first = mean * distance;
    EXPECT_NEAR(mean * distance / first, 1.0, 0.03) << distance;
    EXPECT_GT(std::abs(mean * std::sqrt(distance) / (first / std::sqrt(4.0)) - 1.0), distance > 4.0 ? 0.25 : -1.0)
        << "that would be the wave equation's";
  }
}

// The same particles, to the bit, whatever the steps: 30, 60, 72, 90 or 120 a second, or one. Control seen: one
// generation a step.
TEST(TravellingParticles, DoNotKnowTheFrameRate) {
  std::vector<TravellingParticle> reference;
  for (const double rate : {0.1, 30.0, 60.0, 72.0, 90.0, 120.0}) {
    TravellingParticles waves(lasting());
    ASSERT_TRUE(waves.add_ring({1.0, 1.0}, 0.0, 0.3, 7));
    ASSERT_TRUE(waves.add({{2.0, 0.0}, 0.5, 1.0, 0.4, 0.1}));
    for (int i = 1; i <= int(10.0 * rate); ++i) waves.advance(i / rate);
    std::vector<TravellingParticle> now(waves.particles().begin(), waves.particles().end());
    if (reference.empty()) reference = now;
    ASSERT_EQ(now.size(), reference.size()) << rate;
    const auto by_direction = [](const TravellingParticle& a, const TravellingParticle& b) {
      return a.direction_rad != b.direction_rad ? a.direction_rad < b.direction_rad : a.born_s < b.born_s;
    };
    std::sort(now.begin(), now.end(), by_direction);
    std::sort(reference.begin(), reference.end(), by_direction);
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_EQ(now[i].direction_rad, reference[i].direction_rad);
      EXPECT_EQ(now[i].amplitude_m, reference[i].amplitude_m);
    }
    const auto before = waves.particles().size();
    waves.advance(3.0);  // backwards
    waves.advance(std::nan(""));
    EXPECT_EQ(waves.particles().size(), before);
  }
}

// A piece's thirds fill its own width and no more. Control seen: thirds that begin at its middle.
TEST(TravellingParticles, ThirdsFillTheWidthOfThePiece) {
  TravellingParticles waves(lasting());
  ASSERT_TRUE(waves.add({{0.0, 0.0}, 0.0, 0.7, 0.9, 0.1}));
  waves.advance(20.0);
  const auto pieces = waves.particles();
  ASSERT_GT(pieces.size(), 80u);
  double least = 9.0, most = -9.0, mean = 0.0, width = 0.0;
  for (const TravellingParticle& p : pieces) {
    least = std::min(least, p.direction_rad - 0.5 * p.dispersion_rad);
    most = std::max(most, p.direction_rad + 0.5 * p.dispersion_rad);
    mean += p.direction_rad / double(pieces.size());
    width += p.dispersion_rad;
  }
  EXPECT_NEAR(mean, 0.7, 1e-12);
  EXPECT_NEAR(least, 0.7 - 0.45, 1e-12);
  EXPECT_NEAR(most, 0.7 + 0.45, 1e-12);
  EXPECT_NEAR(width, 0.9, 1e-12);
}

// What is taken away for being low is counted; what has no room to split stays, says so, and loses nothing.
// Controls seen: taken_away_m_ not summed; `room` always true (500 becomes 2,187).
TEST(TravellingParticles, CountWhatTheyLoseAndStayWithinTheirRoom) {
  TravellingSettings settings = lasting();
  settings.least_amplitude_m = 1e-3;
  TravellingParticles fading(settings);
  ASSERT_TRUE(fading.add_ring({0.0, 0.0}, 0.0, 0.05, 9));
  fading.advance(2.0);
  EXPECT_EQ(fading.taken_away_m(), 0.0);
  fading.advance(100.0);
  EXPECT_TRUE(fading.particles().empty());
  EXPECT_NEAR(fading.taken_away_m(), 9 * 0.05, 1e-12);

  settings.least_amplitude_m = 0.0;
  settings.most_particles = 500;
  TravellingParticles crowded(settings);
  ASSERT_TRUE(crowded.add_ring({0.0, 0.0}, 0.0, 0.05, 9));
  crowded.advance(100.0);
  EXPECT_LE(crowded.particles().size(), 500u);
  EXPECT_TRUE(crowded.full());
  EXPECT_NEAR(crowded.amplitude_sum_m(), 9 * 0.05, 1e-12);
  EXPECT_FALSE(crowded.add_ring({0.0, 0.0}, 0.0, 0.05, 60));
}

TEST(TravellingParticles, RefuseWhatIsNoNumber) {
  for (const auto& [change, name] :
       {std::pair<void (*)(TravellingSettings&), const char*>{[](TravellingSettings& s) { s.radius_m = 0.0; },
                                                              "radius_m"},
        {[](TravellingSettings& s) { s.speed_mps = -1.0; }, "speed_mps"},
        {[](TravellingSettings& s) { s.speed_mps = INFINITY; }, "speed_mps"},
        {[](TravellingSettings& s) { s.least_amplitude_m = std::nan(""); }, "least_amplitude_m"},
        {[](TravellingSettings& s) { s.most_particles = 0; }, "most_particles"}}) {
    TravellingSettings s = lasting();
    change(s);
    EXPECT_NE(test::error_of([&] { TravellingParticles{s}; }).find(name), std::string::npos);
  }
  TravellingParticles waves(lasting());
  EXPECT_FALSE(waves.add({{std::nan(""), 0.0}, 0.0, 0.0, 0.1, 0.1}));
  EXPECT_FALSE(waves.add({{0.0, 0.0}, INFINITY, 0.0, 0.1, 0.1}));
  EXPECT_FALSE(waves.add({{0.0, 0.0}, 0.0, 0.0, -0.1, 0.1}));
  EXPECT_FALSE(waves.add_ring({0.0, 0.0}, 0.0, 0.1, 0));
  EXPECT_TRUE(waves.particles().empty());
  EXPECT_TRUE(waves.add({{0.0, 0.0}, 0.0, 0.0, 0.0, 0.1})) << "a straight front";
  waves.advance(1e6);
  EXPECT_EQ(waves.particles().size(), 1u);
}

}  // namespace
}  // namespace seascape
