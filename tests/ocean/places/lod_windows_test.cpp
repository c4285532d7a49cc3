// Windows of local data: what a place reads, and that nothing in a field moves, pops or is lost as the viewer moves and
// rises.
#include "ocean/places/lod_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/expect_error.h"

namespace seascape {
namespace {

constexpr double pi = std::numbers::pi;

LodWindowSettings small() {
  return {.resolution = 64, .slices = 5, .texel_m = 0.25, .scale_height_m = 4.0, .most_octaves = 10};
}

LodPlacement at(const LodWindowSettings& s, glm::dvec2 viewer, double height) {
  return lod_placement(s, viewer, lod_scale(s, height));
}

// A smooth sea of three waves, 16 m and longer, and the most that straight lines between its values `texel` apart can
// miss: texel^2 / 8 (max |f_xx| + max |f_zz|).
struct Smooth {
  static constexpr double kx[3] = {0.31, -0.12, 0.05}, kz[3] = {0.2, 0.33, -0.07}, a[3] = {0.4, 0.3, 0.8};
  static double value(glm::dvec2 p) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += a[i] * std::sin(kx[i] * p.x + kz[i] * p.y + i);
    return sum;
  }
  static double missed(double texel) {
    double bend = 0.0;
    for (int i = 0; i < 3; ++i) bend += a[i] * (kx[i] * kx[i] + kz[i] * kz[i]);
    return texel * texel / 8.0 * bend + 2e-6;
  }
};
const auto smooth_fill = [](glm::dvec2 place, double, float) { return float(Smooth::value(place)); };

LodField<float> smooth_field(const LodWindowSettings& s, const LodPlacement& placement) {
  LodField<float> field(s, 0.0f, placement);
  for (int i = 0; i < s.slices; ++i)
    field.each(i, [&](LodIndex w) { field.texel(i, w) = float(Smooth::value(field.middle(i, w))); });
  return field;
}

// Weights are 1 in sum, to the bit, and change with the place by no more than their ramps are steep; what is read lies
// in its window with all four texels. Controls seen: a border of 0.6 of the reach (levels jump by 0.17); a reach of
// half the window (11,176 reads outside); a logarithm rounded down (levels jump by 1).
TEST(LodWindows, ReadsAreOneInSumContinuousAndInside) {
  const LodWindowSettings s = small();
  int outside = 0;
  double jump = 0.0, steepest_out = 0.0;
  bool all_one = true;
  for (const double height : {0.0, 5.0, 6.5, 7.99}) {
    for (const glm::dvec2 viewer : {glm::dvec2(0.0), glm::dvec2(13.37, -4.11), glm::dvec2(-1e6 + 0.124, 7e5 + 3.13)}) {
      const LodPlacement placement = at(s, viewer, height);
      const gpu::LodWindows w = lod_windows(s, placement, viewer);
      for (const double angle : {0.0, 0.3, 0.785, 2.2, 4.0}) {
        for (const double footprint : {0.0, 0.6, 3.0, 100.0}) {
          double before = -1.0, out_before = -1.0;
          for (int i = 0; i < 4000; ++i) {
            const double r = 0.05 * i;
            const glm::dvec2 p(r * std::cos(angle), r * std::sin(angle));
            const gpu::LodRead read =
                gpu::lod_read(w.reach, w.slices, gpu::lod_distance(glm::vec2(p) - w.viewer), float(footprint));
            const double of_coarser = double(read.present) * read.coarser,
                         of_fine = double(read.present) * (1.0 - read.coarser), of_outside = 1.0 - read.present;
            all_one = all_one && of_coarser + of_fine + of_outside == 1.0 && of_fine >= 0.0 && of_coarser >= 0.0 &&
                      of_outside >= 0.0;
            const double level = read.fine + read.coarser;
            // A ramp is a quarter of a reach wide; the shortest, of slice 0, is 1.875 m, where 0.05 m are 0.027 levels.
            if (before >= 0.0) jump = std::max(jump, std::abs(level - before) * read.present);
            if (out_before >= 0.0) steepest_out = std::max(steepest_out, std::abs(read.present - out_before));
            before = level, out_before = read.present;
            if (read.present <= 0.0f) continue;
            for (int k = 0; k < (read.coarser > 0.0f ? 2 : 1); ++k) {
              const double texel = lod_texel_m(s, placement, read.fine + k);
              const LodIndex low(glm::floor((viewer + p) / texel - 0.5)),
                  first = placement.first[std::size_t(read.fine + k)];
              if (low.x < first.x || low.y < first.y || low.x + 1 >= first.x + s.resolution ||
                  low.y + 1 >= first.y + s.resolution)
                ++outside;
            }
          }
        }
      }
    }
  }
  EXPECT_TRUE(all_one);
  EXPECT_EQ(outside, 0);
  EXPECT_LT(jump, 0.03);
  EXPECT_GT(jump, 0.02) << "the ramps were crossed";
  EXPECT_LT(steepest_out, 0.0034) << "a quarter of 60 m";
}

// Height turns the level and the reach without a step where texels double. Control seen: a blend that starts anew at
// 0.1 (a blend of 0.1 instead of 0).
TEST(LodWindows, DoublingTexelsChangesNothingThatIsRead) {
  const LodWindowSettings s = small();
  double off = 0.0, out = 0.0;
  for (const double doubled : {8.0, 16.0, 64.0}) {
    const LodPlacement below = at(s, {3.0, 5.0}, doubled * (1 - 1e-9)), above = at(s, {3.0, 5.0}, doubled);
    ASSERT_EQ(below.scale.octave + 1, above.scale.octave);
    EXPECT_NEAR(below.scale.blend, 1.0, 1e-6);
    EXPECT_NEAR(above.scale.blend, 0.0, 1e-6);
    const gpu::LodWindows a = lod_windows(s, below, {0.0, 0.0}), b = lod_windows(s, above, {0.0, 0.0});
    for (int i = 0; i < 3000; ++i) {
      const glm::vec2 p(float(doubled * 0.013 * i), float(i % 7));
      for (const float footprint : {0.0f, 7.0f}) {
        const gpu::LodRead fine = gpu::lod_read(a.reach, a.slices, gpu::lod_distance(p - a.viewer), footprint),
                           coarse = gpu::lod_read(b.reach, b.slices, gpu::lod_distance(p - b.viewer), footprint);
        out = std::max(out, double(std::abs(fine.present - coarse.present)));
        const double was = below.scale.octave + fine.fine + fine.coarser,
                     is = above.scale.octave + coarse.fine + coarse.coarser;
        off = std::max(off, std::abs(was - is) * fine.present);
      }
    }
  }
  EXPECT_LT(off, 1e-5);
  EXPECT_LT(out, 1e-5);
  EXPECT_EQ(lod_scale(s, std::numeric_limits<double>::quiet_NaN()).octave, 0);
  EXPECT_EQ(lod_scale(s, 1e30).octave, s.most_octaves);
}

// The relative rms error of waves read between texels. Control seen: reading the nearest texel (45, 23 and 11 %).
TEST(LodField, LosesOfAWaveWhatItSays) {
  const LodWindowSettings s = small();
  const LodPlacement placement = at(s, {0.0, 0.0}, 0.0);
  for (const auto& [texels, want] : {std::pair{4.0, 0.213}, {8.0, 0.0556}, {16.0, 0.0141}}) {
    LodField<float> field(s, 0.0f, placement);
    const double k = 2.0 * pi / (texels * s.texel_m);
    field.each(0, [&](LodIndex w) { field.texel(0, w) = float(std::cos(k * field.middle(0, w).x)); });
    double error = 0.0, power = 0.0;
    for (int i = 0; i < 4000; ++i) {  // whole waves: 4 m
      const double x = 0.001 * i, truth = std::cos(k * x);
      error += std::pow(field.bilinear(0, {x, 0.4}) - truth, 2);
      power += truth * truth;
    }
    EXPECT_NEAR(std::sqrt(error / power), want, 0.01 * want) << texels;
    const double sinc = std::sin(pi / texels) / (pi / texels);
    EXPECT_NEAR(std::sqrt(1.0 - 2.0 * sinc * sinc + (2.0 + std::cos(2.0 * pi / texels)) / 3.0), want, 0.01 * want)
        << "as stated";
  }
}

// A viewer glides; places that stay are read to the same bit while one slice reads them, and at every step all places
// are as near the truth as straight lines between the coarser slice's texels. Controls seen: texels that come in are
// left as they were (1.95 m off); a reach of half the window (0.04 m).
TEST(LodField, NothingPopsAsTheViewerMoves) {
  const LodWindowSettings s = small();
  glm::dvec2 viewer(-11.3, 7.7);
  LodField<float> field = smooth_field(s, at(s, viewer, 0.0));
  const glm::dvec2 fixed = viewer + glm::dvec2(1.3, 0.6);  // within the finest slice all along
  const float first = field.sample(fixed, 0.0);
  double excess = -1.0, step = -1.0;
  std::array<double, 200> last{};
  int moved_texels = 0;
  for (int n = 0; n < 80; ++n) {
    const LodIndex was = field.first(0);
    field.follow(at(s, viewer, 0.0), smooth_fill);
    moved_texels += was != field.first(0);
    if (n < 12) {
      EXPECT_EQ(field.sample(fixed, 0.0), first) << n;
    }
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 p(-11.3 + 0.61 * i - 60.0, 7.7 + 0.37 * std::sin(3.0 * i) * i);
      const gpu::LodRead read =
          gpu::lod_read(field.windows().reach, field.windows().slices, gpu::lod_distance(glm::vec2(p - viewer)), 0.0f);
      if (read.present < 1.0f) continue;
      const double value = field.sample(p, 0.0),
                   miss = Smooth::missed(field.texel_m(read.fine + (read.coarser > 0.0f ? 1 : 0)));
      excess = std::max(excess, std::abs(value - Smooth::value(p)) - miss);
      if (n > 0 && last[std::size_t(i)] != 0.0)
        step = std::max(step, std::abs(value - last[std::size_t(i)]) - 2.0 * miss);
      last[std::size_t(i)] = value;
    }
    viewer += glm::dvec2(0.31, -0.17);
  }
  EXPECT_GT(moved_texels, 60);
  EXPECT_LT(excess, 0.0);
  EXPECT_LT(step, 0.0);
}

// The same without a fill: what comes in is what the coarser slice has, within its error; of the coarsest the value of
// outside. Control seen: inherited from the slice itself (1.7 m).
TEST(LodField, WhatComesInIsInheritedFromTheCoarserSlice) {
  const LodWindowSettings s = small();
  LodField<float> field = smooth_field(s, at(s, {0.0, 0.0}, 0.0));
  field.follow(at(s, {6.3, -6.1}, 0.0));  // more than half of the finest slice is new
  double worst = 0.0;
  field.each(0, [&](LodIndex w) {
    worst = std::max(worst, std::abs(double(field.texel(0, w)) - Smooth::value(field.middle(0, w))));
  });
  EXPECT_GT(worst, 1e-4) << "some are inherited";
  EXPECT_LT(worst, Smooth::missed(field.texel_m(1)));
  const LodIndex far = field.first(4) + LodIndex(s.resolution - 1, 0);
  EXPECT_EQ(field.texel(4, far), 0.0f) << "beyond what the coarsest slice knew";
}

// Twice the height: what slices had they keep, to the bit, one number lower; the new coarsest has means where the finer
// one reached. Down again: only what was finer than all is interpolated. Controls seen: layers that do not turn with
// the octave (no texel kept); one texel of the four for their mean (0.55 m).
TEST(LodField, AChangeOfScaleMovesWholeSlices) {
  const LodWindowSettings s = small();
  const glm::dvec2 viewer(5.2, -3.9);
  LodField<float> field = smooth_field(s, at(s, viewer, 0.0));
  const LodField<float> before = field;
  field.follow(at(s, viewer, 9.0));
  ASSERT_EQ(field.placement().scale.octave, 1);
  for (int i = 0; i + 1 < s.slices; ++i) {
    int same = 0;
    field.each(i, [&](LodIndex w) { same += field.texel(i, w) == before.texel(i + 1, w); });
    EXPECT_EQ(same, s.resolution * s.resolution) << i;
  }
  const int last = s.slices - 1;
  double worst = 0.0;
  int known = 0;
  field.each(last, [&](LodIndex w) {
    if (field.texel(last, w) == 0.0f) return;
    ++known;
    // A mean over a texel differs from its middle by texel^2 / 24 (f_xx + f_zz) at most.
    worst = std::max(worst, std::abs(double(field.texel(last, w)) - Smooth::value(field.middle(last, w))));
  });
  EXPECT_NEAR(known, s.resolution * s.resolution / 4, 64 + 1);
  EXPECT_LT(worst, Smooth::missed(field.texel_m(last)) / 3.0);
  field.follow(at(s, viewer, 0.0));
  for (int i = 1; i + 1 < s.slices; ++i) {
    int same = 0;
    field.each(i, [&](LodIndex w) { same += field.texel(i, w) == before.texel(i, w); });
    EXPECT_EQ(same, s.resolution * s.resolution) << i;
  }
  worst = 0.0;
  field.each(0, [&](LodIndex w) {
    worst = std::max(worst, std::abs(double(field.texel(0, w)) - Smooth::value(field.middle(0, w))));
  });
  EXPECT_LT(worst, Smooth::missed(field.texel_m(1)));
  EXPECT_GT(worst, 1e-4) << "the finest was lost";
  // From low to high above in one step, and back: nothing is known there but what is given.
  field.follow(at(s, viewer, 4.0 * 1024.0), smooth_fill);
  ASSERT_EQ(field.placement().scale.octave, 10);
  EXPECT_NEAR(field.sample(viewer, 0.0), 0.0, 3.0);
}

// A million metres away everything is the same to the bit, and 2^50 texels away texels are still told apart. Control
// seen: places in float (7 of 400 reads the same).
TEST(LodField, IsAsExactFarAway) {
  const LodWindowSettings s = small();
  const glm::dvec2 far(1048576.0, -1048576.0 * 4.0);  // whole texels of every slice
  const auto shifted = [&](glm::dvec2 place, double, float) { return float(Smooth::value(place - far)); };
  LodField<float> near_field = smooth_field(s, at(s, {0.0, 0.0}, 0.0)), far_field(s, 0.0f, at(s, far, 0.0));
  for (int i = 0; i < s.slices; ++i)
    far_field.each(i, [&](LodIndex w) { far_field.texel(i, w) = shifted(far_field.middle(i, w), 0.0, 0.0f); });
  int same = 0;
  for (int n = 0; n < 400; ++n) {
    const glm::dvec2 viewer(0.125 * (n % 50), -0.0625 * n);
    near_field.follow(at(s, viewer, 0.0), smooth_fill);
    far_field.follow(at(s, far + viewer, 0.0), shifted);
    const glm::dvec2 p = viewer + glm::dvec2(0.03125 * n, 0.0078125 * n);
    same += near_field.sample(p, 0.0) == far_field.sample(far + p, 0.0);
  }
  EXPECT_EQ(same, 400);

  const double most = std::ldexp(s.texel_m, 50);
  LodField<float> edge(s, 0.0f, at(s, {most, -most}, 0.0));
  edge.each(0, [&](LodIndex w) { edge.texel(0, w) = float(w.x & 1); });
  const glm::dvec2 place(most, -most);
  EXPECT_EQ(edge.bilinear(0, place + glm::dvec2(0.5 * s.texel_m, 0.0)), 0.0f);
  EXPECT_EQ(edge.bilinear(0, place + glm::dvec2(1.5 * s.texel_m, 0.0)), 1.0f);
  EXPECT_NE(test::error_of([&] { lod_placement(s, {2.0 * most, 0.0}, {}); }).find("viewer"), std::string::npos);
  EXPECT_NE(test::error_of([&] { lod_placement(s, {std::nan(""), 0.0}, {}); }).find("viewer"), std::string::npos);
}

// What shaders are given finds the texels that the processor has, from an origin that is not the viewer. Control seen:
// coordinates without the texel's fraction (0.97 texels off).
TEST(LodWindows, ShadersFindTheSameTexels) {
  const LodWindowSettings s = small();
  double off = 0.0;
  for (const glm::dvec2 origin : {glm::dvec2(0.0), glm::dvec2(-777777.24, 1234567.89)}) {
    const LodPlacement placement = at(s, origin + glm::dvec2(3.3, 8.1), 5.0);
    const gpu::LodWindows w = lod_windows(s, placement, origin);
    for (int slice = 0; slice < s.slices; ++slice)
      for (int i = 0; i < 100; ++i) {
        const glm::vec2 p(0.37f * float(i - 50), 0.11f * float(i));
        const glm::dvec2 texels = (origin + glm::dvec2(p)) / lod_texel_m(s, placement, slice);
        const glm::dvec2 difference =
            glm::dvec2(gpu::lod_coordinates(w.slice[slice], p)) * double(s.resolution) - texels;
        for (int axis = 0; axis < 2; ++axis)
          off = std::max(off, std::abs(difference[axis] - s.resolution * std::round(difference[axis] / s.resolution)));
      }
  }
  EXPECT_LT(off, 2e-4);
}

// Control seen: a fixed share a call instead of by seconds (0.31 octaves between 30 and 60 Hz).
TEST(LodViewer, FollowsHeightAlikeAtAnyRate) {
  double first = 0.0;
  for (const int rate : {30, 60, 72, 90, 120}) {
    LodViewer viewer(small());
    viewer.follow({0.0, 0.0}, 10.0, 0.0);
    EXPECT_NEAR(viewer.placement().scale.octave + viewer.placement().scale.blend, std::log2(2.5), 1e-9)
        << "at once at first";
    for (int i = 0; i < rate / 2; ++i) viewer.follow({0.0, 0.0}, 30.0, 1.0 / rate);
    const double octaves = viewer.placement().scale.octave + viewer.placement().scale.blend;
    if (rate == 30) first = octaves;
    EXPECT_NEAR(octaves, first, 1e-9) << rate;
    EXPECT_NEAR(octaves, std::log2(2.5) + std::log2(3.0) * (1.0 - std::exp(-1.0)), 1e-9);
    viewer.follow({0.0, 0.0}, 4000.0, 1.0 / rate);
    EXPECT_NEAR(viewer.placement().scale.octave + viewer.placement().scale.blend, std::log2(1000.0), 1e-9) << "a jump";
    const LodPlacement kept = viewer.placement();
    viewer.follow({std::numeric_limits<double>::infinity(), 0.0}, 10.0, 0.01);
    viewer.follow({0.0, 0.0}, std::nan(""), 0.01);
    EXPECT_EQ(viewer.placement().scale.octave, kept.scale.octave);
    EXPECT_EQ(viewer.placement().viewer, kept.viewer);
  }
}

// Each check was taken out in turn: "nothing was thrown".
TEST(LodWindows, FaultsAreNamed) {
  const auto named = [](const char* name, auto change) {
    LodWindowSettings s = small();
    change(s);
    EXPECT_NE(test::error_of([&] { validate(s); }).find(name), std::string::npos) << name;
  };
  named("resolution", [](auto& s) { s.resolution = 100; });
  named("slices", [](auto& s) { s.slices = 1; });
  named("texel_m", [](auto& s) { s.texel_m = std::nan(""); });
  named("scale_height_m", [](auto& s) { s.scale_height_m = 0.0; });
  named("most_octaves", [](auto& s) { s.most_octaves = 41; });
  named("follow_s", [](auto& s) { s.follow_s = -1.0; });
}

}  // namespace
}  // namespace seascape
