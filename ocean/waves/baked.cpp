#include "ocean/waves/baked.h"

#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/text.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles_simd.h"

namespace seascape {

namespace {
namespace hn = hwy::HWY_NAMESPACE;
// Four texels at once, which every instruction set has: the same bits on all of them.
using Four = hn::FixedTag<float, 4>;

constexpr int reach = 3;   // texels to either side that a difference takes
constexpr int margin = 4;  // columns kept beyond either end of a row
constexpr int nodes = 6;   // frames

void require(double value, double least, double most, const std::string& name) {
  if (!(value >= least && value <= most))
    throw Error(name, text_from(value) + " is not in the range " + text_from(least) + " to " + text_from(most),
                "give a value in that range");
}

// Lagrange's weights of frames -2 to 3 for a time t between frames 0 and 1, and their derivatives.
struct FrameWeights {
  std::array<float, nodes> at, rate;
};
FrameWeights frame_weights(double t) {
  FrameWeights result{};
  for (int i = 0; i < nodes; ++i) {
    double weight = 1.0, rate = 0.0;
    for (int j = 0; j < nodes; ++j) {
      if (j == i) continue;
      double rest = 1.0 / (i - j);
      for (int k = 0; k < nodes; ++k)
        if (k != i && k != j) rest *= (t + 2.0 - k) / (i - k);
      rate += rest;
      weight *= (t + 2.0 - j) / (i - j);
    }
    result.at[std::size_t(i)] = float(weight);
    result.rate[std::size_t(i)] = float(rate);
  }
  return result;
}

// First derivative over texels (Fornberg 1988, table 1, order 6).
template <class At>
float difference(At at) {
  return (45.0f * (at(1) - at(-1)) - 9.0f * (at(2) - at(-2)) + (at(3) - at(-3))) * (1.0f / 60.0f);
}

// The same of four texels, in the same order.
template <class At>
hn::Vec<Four> differences(At at) {
  const Four d;
  const auto sum = hn::Add(
      hn::Sub(hn::Mul(hn::Set(d, 45.0f), hn::Sub(at(1), at(-1))), hn::Mul(hn::Set(d, 9.0f), hn::Sub(at(2), at(-2)))),
      hn::Sub(at(3), at(-3)));
  return hn::Mul(sum, hn::Set(d, 1.0f / 60.0f));
}

// One component of one frame on its torus.
struct Torus {
  const float* texels;
  int n;
  float operator()(int x, int z) const { return texels[std::ptrdiff_t(z & (n - 1)) * n + (x & (n - 1))]; }
};

// Raises waves by the inverse of what the bilinear filter leaves of them on average, (x / sin x)^2 of half their phase
// a texel x an axis, as its series in s = 4 sin^2 x: 1 + s / 12 + s^2 / 90 + s^3 / 560, within 0.7 % down to four
// texels a wave. s is minus the second difference.
void raise_axis(std::vector<float>& line, std::vector<float>& first, std::vector<float>& second) {
  const int n = int(line.size());
  const auto minus_bend = [&](const std::vector<float>& of, std::vector<float>& to) {
    for (int i = 0; i < n; ++i)
      to[std::size_t(i)] =
          2.0f * of[std::size_t(i)] - of[std::size_t((i + 1) & (n - 1))] - of[std::size_t((i - 1) & (n - 1))];
  };
  minus_bend(line, first);
  for (int i = 0; i < n; ++i) line[std::size_t(i)] += first[std::size_t(i)] / 12.0f;
  minus_bend(first, second);
  for (int i = 0; i < n; ++i) line[std::size_t(i)] += second[std::size_t(i)] / 90.0f;
  minus_bend(second, first);
  for (int i = 0; i < n; ++i) line[std::size_t(i)] += first[std::size_t(i)] / 560.0f;
}

void raise(float* texels, int n) {
  std::vector<float> line(std::size_t(n), 0.0f), first(line), second(line);
  for (const bool across : {false, true})
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int j) -> float& {
        return texels[across ? std::ptrdiff_t(j) * n + i : std::ptrdiff_t(i) * n + j];
      };
      for (int j = 0; j < n; ++j) line[std::size_t(j)] = at(j);
      raise_axis(line, first, second);
      for (int j = 0; j < n; ++j) at(j) = line[std::size_t(j)];
    }
}

}  // namespace

void validate(const BakedSettings& s) {
  require(s.scale, 0.01, 100.0, "baked.scale");
  require(s.weight, 0.0, 4.0, "baked.weight");
  require(s.speed, -8.0, 8.0, "baked.speed");
  require(s.fade_m, 0.0, 1e6, "baked.fade_m");
}

double kept_between_frames(double w) {
  const FrameWeights half = frame_weights(0.5);
  double kept = 0.0;
  for (int i = 0; i < nodes; ++i) kept += double(half.at[std::size_t(i)]) * std::cos(w * (i - 2.5));
  return kept;
}

// All but what the settings make of it.
std::shared_ptr<const Baked::Raised> Baked::raised(BakedLoop recorded) {
  const auto result = std::make_shared<Raised>(Raised{std::move(recorded), {}});
  Raised& loop = *result;
  const int n = loop.samples;
  assert(n >= BakedLoop::least_samples && n <= BakedLoop::most_samples && std::has_single_bit(unsigned(n)));
  assert(loop.frames >= BakedLoop::least_frames &&
         loop.texels.size() == std::size_t(loop.frames) * loop.frame_floats());
  const double texel = loop.side_m / n;
  struct Sums {
    double height = 0.0, raised_slope = 0.0, highest = 0.0, furthest = 0.0;
    glm::dvec3 slope{0.0};
  };
  std::vector<Sums> of_frame(std::size_t(loop.frames));
  tbb::parallel_for(0, loop.frames, [&](int f) {
    Sums& sums = of_frame[std::size_t(f)];
    float* const first = loop.texels.data() + std::size_t(f) * loop.frame_floats();
    const std::ptrdiff_t plane = std::ptrdiff_t(n) * n;
    const Torus height{first + plane, n};
    const auto slope = [&](int x, int z) {
      return glm::dvec2(difference([&](int i) { return height(x + i, z); }),
                        difference([&](int i) { return height(x, z + i); })) /
             texel;
    };
    for (int z = 0; z < n; ++z)
      for (int x = 0; x < n; ++x) {
        const glm::dvec2 s = slope(x, z);
        sums.height += double(height(x, z)) * height(x, z);
        sums.slope += glm::dvec3(s.x * s.x, s.y * s.y, s.x * s.y);
      }
    for (int c = 0; c < 3; ++c) raise(first + c * plane, n);
    for (int z = 0; z < n; ++z)
      for (int x = 0; x < n; ++x) {
        const glm::dvec2 s = slope(x, z);
        sums.raised_slope += glm::dot(s, s);
        sums.highest = std::max(sums.highest, double(std::abs(height(x, z))));
        sums.furthest =
            std::max(sums.furthest, std::hypot(double(first[z * n + x]), double(first[2 * plane + z * n + x])));
      }
  });
  Sums all;
  for (const Sums& sums : of_frame) {
    all.height += sums.height;
    all.slope += sums.slope;
    all.raised_slope += sums.raised_slope;
    all.highest = std::max(all.highest, sums.highest);
    all.furthest = std::max(all.furthest, sums.furthest);
  }
  const double count = double(loop.frames) * n * n;
  loop.statistics.height_variance = all.height / count;
  loop.statistics.slope_moments = all.slope / count;
  constexpr double between = 1.05;  // frames and texels
  loop.statistics.largest_height_m = between * all.highest;
  loop.statistics.largest_shift_m = between * all.furthest;
  if (all.raised_slope > 0.0) loop.moment_share = float((all.slope.x + all.slope.y) / all.raised_slope);
  return result;
}

Baked::Baked(BakedLoop loop, const BakedSettings& settings, double loop_s)
    : Baked(raised(std::move(loop)), settings, loop_s) {}

Baked::Baked(const Baked& same, const BakedSettings& settings, double loop_s) : Baked(same.loop_, settings, loop_s) {}

Baked::Baked(std::shared_ptr<const Raised> loop, const BakedSettings& settings, double loop_s)
    : loop_(std::move(loop)), by_(float(settings.weight * settings.scale)), statistics_(loop_->statistics) {
  validate(settings);
  const double rate = std::abs(settings.speed) / std::sqrt(settings.scale);
  if (rate > 0.0) {
    // At 2^46 ticks, two years, a turn is as long as loop_turns() takes it: what is slower moves by less than anybody
    // waits for.
    const std::int64_t own =
        std::llround(std::clamp(loop_->frames / loop_->fps / rate * double(gpu::ticks_per_second), 1.0, 0x1p46));
    const std::int64_t whole = std::llround(loop_s * double(gpu::ticks_per_second));
    const std::int64_t ticks = whole > 0 ? whole : own,
                       times = whole > 0 ? std::max(std::llround(double(whole) / double(own)), 1ll) : 1;
    turns_ = loop_turns(times, ticks);
    period_ticks_ = double(ticks) / double(times);
    frames_a_second_ = double(loop_->frames) * gpu::ticks_per_second / period_ticks_;
    if (settings.speed < 0.0) turns_ = std::uint64_t(0) - turns_, frames_a_second_ = -frames_a_second_;
  }
  const double side = loop_->side_m * settings.scale;
  laying_ = {1.0, side, 0.0, side, 4.0 * side / loop_->samples};
  statistics_.height_variance *= double(by_) * double(by_);
  statistics_.slope_moments *= settings.weight * settings.weight;
  statistics_.largest_height_m *= double(by_);
  statistics_.largest_shift_m *= double(by_);
  still_ = statistics_.largest_height_m == 0.0 && statistics_.largest_shift_m == 0.0;
}

double Baked::period_s() const { return period_ticks_ / gpu::ticks_per_second; }

std::size_t Baked::workspace_floats(bool) const {
  return 3 * std::size_t(loop_->samples) * std::size_t(loop_->samples + 2 * margin);
}

void Baked::evaluate(std::int64_t ticks, bool velocity, std::span<const PlaneLevel> levels,
                     std::span<float> workspace) const {
  const int n = loop_->samples;
  assert(workspace.size() >= workspace_floats(velocity) && levels.size() == std::size_t(std::bit_width(unsigned(n))));
  // Where in the loop, in frames: exact at any time, since a turn is 2^64.
  const std::uint64_t phase = turns_ * std::uint64_t(ticks), low = (phase & 0xffffffffu) * unsigned(loop_->frames);
  const std::uint64_t place =
      (phase >> 32) * unsigned(loop_->frames) + (low >> 32);  // frames times 2^32; 32 bits more are in low
  const int frame = int(place >> 32);
  FrameWeights weights = frame_weights((double(place & 0xffffffffu) + double(low & 0xffffffffu) * 0x1p-32) * 0x1p-32);
  for (std::size_t i = 0; i < std::size_t(nodes); ++i) weights.at[i] *= by_, weights.rate[i] *= by_;
  std::array<const float*, nodes> frames;
  for (int i = 0; i < nodes; ++i)
    frames[std::size_t(i)] =
        loop_->texels.data() + std::size_t((frame + i - 2 + loop_->frames) % loop_->frames) * loop_->frame_floats();
  const std::ptrdiff_t stride = n + 2 * margin, plane = stride * n;
  float* const first = workspace.data() + margin;
  const Four d;
  const auto weighed = [&](const std::array<float, nodes>& w, std::ptrdiff_t i) {
    const auto part = [&](std::size_t f) { return hn::Mul(hn::Set(d, w[f]), hn::LoadU(d, frames[f] + i)); };
    return hn::Add(hn::Add(hn::Add(part(0), part(1)), hn::Add(part(2), part(3))), hn::Add(part(4), part(5)));
  };
  constexpr int strip = 16;
  tbb::parallel_for(0, n / strip, [&](int part) {
    const float a_second = float(frames_a_second_);
    for (int z = part * strip; z < (part + 1) * strip; ++z) {
      for (int c = 0; c < 3; ++c) {
        const std::ptrdiff_t from = (std::ptrdiff_t(c) * n + z) * n;
        float* const to = first + c * plane + z * stride;
        for (int x = 0; x < n; x += 4) hn::StoreU(weighed(weights.at, from + x), d, to + x);
        for (int x = 0; x < margin; ++x) to[x - margin] = to[n + x - margin], to[n + x] = to[x];
      }
      if (!velocity) continue;
      glm::vec4* const to = levels[0].texels[std::size_t(WavePlane::velocity)] + std::ptrdiff_t(z) * levels[0].stride;
      for (int x = 0; x < n; x += 4) {
        const auto rate = [&](int c) {
          return hn::Mul(hn::Set(d, a_second), weighed(weights.rate, (std::ptrdiff_t(c) * n + z) * n + x));
        };
        hn::StoreInterleaved4(rate(0), rate(1), rate(2), hn::Zero(d), d, &to[x].x);
      }
    }
  });
  const int planes = velocity ? 4 : 3;
  const float texels_a_metre = float(n / laying_.side_m);
  tbb::parallel_for(0, n / strip, [&](int part) {
    for (int z = part * strip; z < (part + 1) * strip; ++z) {
      const auto row = [&](int c, int by) { return first + c * plane + std::ptrdiff_t((z + by) & (n - 1)) * stride; };
      std::array<std::array<const float*, 2 * reach + 1>, 3> rows;
      for (int c = 0; c < 3; ++c)
        for (int by = -reach; by <= reach; ++by) rows[std::size_t(c)][std::size_t(by + reach)] = row(c, by);
      const std::ptrdiff_t to = std::ptrdiff_t(z) * levels[0].stride;
      const auto scale = hn::Set(d, texels_a_metre), share = hn::Set(d, loop_->moment_share);
      for (int x = 0; x < n; x += 4) {
        const auto along = [&](std::size_t c) {
          return hn::Mul(scale, differences([&](int i) { return hn::LoadU(d, rows[c][reach] + x + i); }));
        };
        const auto across = [&](std::size_t c) {
          return hn::Mul(scale, differences([&](int i) { return hn::LoadU(d, rows[c][std::size_t(reach + i)] + x); }));
        };
        const auto here = [&](std::size_t c) { return hn::LoadU(d, rows[c][reach] + x); };
        const auto hx = along(1), hz = across(1), xx = along(0), zz = across(2), divergence = hn::Add(xx, zz);
        const auto moment = [&](auto a, auto b) { return hn::Mul(share, hn::Mul(a, b)); };
        hn::StoreInterleaved4(here(0), here(1), here(2), hn::Mul(hn::Set(d, 0.5f), hn::Add(across(0), along(2))), d,
                              &levels[0].texels[0][to + x].x);
        hn::StoreInterleaved4(hx, hz, xx, zz, d, &levels[0].texels[1][to + x].x);
        hn::StoreInterleaved4(moment(hx, hx), moment(hz, hz), moment(hx, hz), moment(divergence, divergence), d,
                              &levels[0].texels[2][to + x].x);
      }
    }
    for (int level = 1; level <= 4; ++level) {
      const auto from_row = [&](const PlaneLevel& of, int z) {
        PlaneLevel result = of;
        for (int p = 0; p < planes; ++p) result.texels[p] += std::ptrdiff_t(z) * of.stride;
        return result;
      };
      const int rows_here = strip >> level;
      average_down(from_row(levels[std::size_t(level) - 1], 2 * rows_here * part),
                   from_row(levels[std::size_t(level)], rows_here * part), 0, n >> level, rows_here);
    }
  });
  for (std::size_t level = 5; level < levels.size(); ++level)
    average_down(levels[level - 1], levels[level], 0, n >> level, n >> level);
}

}  // namespace seascape
