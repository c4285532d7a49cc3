// The profile of a meniscus, and where lines leave it. Controls are named beside each test; each was seen to fail.
#include "shaders/shared/meniscus.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

constexpr double pi = 3.14159265358979323846;

// Against a wall that stands upright and is wetted it rises by the root of 2 capillary lengths: 3.8 mm, and at most 3.9
// (facts/underwater.md). Control: the angle for its half.
TEST(Meniscus, RisesAsHighAsItDoes) {
  const double rises_m = double(gpu::capillary_length_m) * gpu::meniscus_height(0.5 * pi);
  EXPECT_NEAR(rises_m, std::sqrt(2.0) * double(gpu::capillary_length_m), 1e-9);
  EXPECT_GT(rises_m, 3.7e-3);
  EXPECT_LT(rises_m, 3.9e-3);
}

// Its shape against the sum of dz / tan(angle), where tension and weight balance: z^2 / 2 = 1 - cos(angle). 1e-5; in
// floats 1e-4. Control: the sign of the cosine in meniscus_out().
TEST(Meniscus, IsTheBalanceOfTensionAndWeight) {
  for (const double from_deg : {150.0, 90.0, 60.0, 20.0})
    for (const double to_deg : {12.0, 5.0, 2.0}) {
      const double from = from_deg * pi / 180.0, to = to_deg * pi / 180.0;
      const double top = gpu::meniscus_height(from), bottom = gpu::meniscus_height(to);
      double out = 0.0;
      constexpr int steps = 200000;
      for (int i = 0; i < steps; ++i) {
        const double z = top + (bottom - top) * (i + 0.5) / steps, cosine = 1.0 - 0.5 * z * z;
        out += (top - bottom) / steps * cosine / std::sqrt(1.0 - cosine * cosine);
      }
      EXPECT_NEAR(gpu::meniscus_out(to) - gpu::meniscus_out(from), out, 1e-5 * std::max(1.0, std::abs(out)))
          << from_deg << " " << to_deg;
      EXPECT_NEAR(double(gpu::meniscus_out(float(to)) - gpu::meniscus_out(float(from))), out, 1e-4);
    }
}

// Lines from plates that lean either way, to all sides ahead: the point found is on the line, within 2e-3, and it is
// the first, as a search in 4,000 steps has it. Control: the plate's own place left out (`out_from`).
TEST(Meniscus, LinesLeaveTheWaterWhereTheyMeetIt) {
  int met = 0, stay = 0;
  for (const double wall_deg : {40.0, 70.0, 90.0, 110.0, 140.0})
    for (const double share : {0.05, 0.3, 0.6, 0.95})
      for (const double pitch_deg : {-50.0, -20.0, -4.0, 0.5, 15.0, 40.0}) {
        const double wall = wall_deg * pi / 180.0, rises = gpu::meniscus_height(wall) / std::sin(wall);
        const double up_plate = share * rises, x = (rises - up_plate) * std::cos(wall), z = up_plate * std::sin(wall);
        // The plate's normal leans as the plate does.
        const double pitch = pitch_deg * pi / 180.0 + 0.5 * pi - wall, dx = std::cos(pitch), dz = std::sin(pitch);
        const double found = gpu::meniscus_met(wall, x, z, dx, dz), begin = gpu::meniscus_out(wall);
        const auto left_of = [&](double angle) {
          return (gpu::meniscus_height(angle) - z) * dx - (gpu::meniscus_out(angle) - begin - x) * dz;
        };
        double first = -1.0;
        for (int i = 1; i <= 4000 && first < 0.0; ++i) {
          const double angle = wall + (double(gpu::meniscus_flattest) - wall) * i / 4000.0;
          if (left_of(angle) <= 0.0) first = angle;
        }
        if (first < 0.0) {
          EXPECT_LE(found, 0.0) << wall_deg << " " << share << " " << pitch_deg;
          EXPECT_EQ(found == 0.0, dz > 0.0);
          ++stay;
          continue;
        }
        ++met;
        EXPECT_NEAR(left_of(found), 0.0, 2e-3) << wall_deg << " " << share << " " << pitch_deg;
        EXPECT_NEAR(found, first, 2e-3) << wall_deg << " " << share << " " << pitch_deg;
        EXPECT_NEAR(double(gpu::meniscus_met(float(wall), float(x), float(z), float(dx), float(dz))), found, 4e-3);
      }
  EXPECT_GT(met, 40);
  EXPECT_GT(stay, 5);
}

}  // namespace
}  // namespace seascape
