#include "ocean/places/refraction.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/error.h"
#include "ocean/waves/dispersion.h"

namespace seascape {

namespace {
constexpr double never = std::numeric_limits<double>::infinity();
constexpr int directions = Refraction::directions;
constexpr double most_drawing_out = 0.25;  // of a metre along its direction, by which a pattern goes on less
constexpr double sector = 2.0 * std::numbers::pi / directions;

// work(wave vector in the world, variance) for each bin of a cascade that has any.
template <class Work>
void each_wave(const WaveBins& bins, int cascade, const Work& work) {
  const Cascade& c = bins.ladder[std::size_t(cascade)];
  const double step = 2.0 * std::numbers::pi / c.side_m;
  const int half = bins_of(cascade) / 2;
  for (int mz = -half; mz < half; ++mz)
    for (int mx = -half; mx < half; ++mx) {
      const glm::dvec2 a(bins.at(cascade, mx, mz).amplitude);
      const double variance = 0.5 * glm::dot(a, a);
      if (variance > 0.0 && (mx != 0 || mz != 0)) work(rotate_xz(step * glm::dvec2(mx, mz), c.rotation_rad), variance);
    }
}

// None along the grid's axes or diagonals, where the shelter's lines would run from node to node without a blur and
// leave streaks.
glm::dvec2 middle_of_sector(int i) { return {std::cos((i + 0.5) * sector), std::sin((i + 0.5) * sector)}; }

// Variance by direction; a wave is shared between the two directions around its own.
using Rose = std::array<double, directions>;
Rose rose_of(const WaveBins& bins, int cascade) {
  Rose rose{};
  each_wave(bins, cascade, [&](glm::dvec2 k, double variance) {
    const double place = std::atan2(k.y, k.x) / sector - 0.5, low = std::floor(place);
    const int i = (int(low) + 2 * directions) % directions;
    rose[std::size_t(i)] += variance * (1.0 - (place - low));
    rose[std::size_t((i + 1) % directions)] += variance * (place - low);
  });
  return rose;
}

// Has no shift fall by more than `most` in a metre along the direction: what comes next on the way bounds it, row after
// row against the direction. Land bounds nothing.
void hold_fall(const BedGrid& grid, std::vector<double>& shift, glm::dvec2 direction, double most) {
  const bool along_x = std::abs(direction.x) >= std::abs(direction.y);
  const double main = along_x ? direction.x : direction.y,
               aslant = (along_x ? direction.y : direction.x) / std::abs(main);
  const int rows = along_x ? grid.nx : grid.nz, columns = along_x ? grid.nz : grid.nx, on = main > 0.0 ? 1 : -1,
            side = aslant > 0.0 ? 1 : -1;
  const double share = std::abs(aslant), fall = most * grid.cell_m / std::abs(main);
  for (int n = 1; n < rows; ++n)
    for (int c = 0; c < columns; ++c) {
      const int row = on > 0 ? rows - 1 - n : n, beside = std::clamp(c + side, 0, columns - 1);
      const auto node = [&](int i, int j) { return along_x ? grid.node(i, j) : grid.node(j, i); };
      const double straight = shift[node(row + on, c)], skew = shift[node(row + on, beside)];
      const double next =
          straight < never && skew < never ? straight + (skew - straight) * share : std::min(straight, skew);
      double& here = shift[node(row, c)];
      if (here < never) here = std::min(here, next + fall);
    }
}

void validate(const RefractionSettings& settings) {
  if (settings.cells < 16 || settings.cells > 2048)
    throw Error("refraction", fmt::format("cells: {} is not from 16 to 2048", settings.cells),
                "choose 256 unless the shallows are very wide");
  if (!(settings.margin_waves >= 0.0 && settings.margin_waves <= 100.0))
    throw Error("refraction", fmt::format("margin_waves: {} is not from 0 to 100", settings.margin_waves), "choose 2");
}
}  // namespace

MeanWave mean_wave(const SeaState& sea, const WaveBins& bins, int cascade) {
  glm::dvec2 towards{0.0};
  double frequency = 0.0, all = 0.0;
  each_wave(bins, cascade, [&](glm::dvec2 k, double variance) {
    const double length = glm::length(k);
    towards += variance * k / length;
    frequency += variance * airy_frequency(length, sea.gravity_mps2, sea.depth_m);
    all += variance;
  });
  MeanWave result;
  result.variance = all;
  if (!(all > 0.0) || !(frequency > 0.0)) return result;
  result.frequency = frequency / all;
  result.wave_number = airy_wave_number(result.frequency, sea.gravity_mps2, sea.depth_m);
  constexpr double prevails = 0.05;  // below this share no direction does
  if (glm::length(towards) > prevails * all) result.direction = glm::normalize(towards);
  return result;
}

void Refraction::lay_grid(const InputBounds& shallows, const RefractionSettings& settings) {
  double longest = 0.0;
  for (const MeanWave& wave : waves_)
    if (wave.wave_number > 0.0) longest = std::max(longest, 2.0 * std::numbers::pi / wave.wave_number);
  const glm::dvec2 size = shallows.most - shallows.least;
  const double wide = std::max({size.x, size.y, 1.0});
  const InputBounds bounds = shallows.grown(std::clamp(settings.margin_waves * longest, 0.25 * wide, wide));
  const glm::dvec2 all = bounds.most - bounds.least;
  grid_.least = bounds.least;
  grid_.cell_m = std::max(all.x, all.y) / settings.cells;
  grid_.nx = std::max(int(std::ceil(all.x / grid_.cell_m - 1e-9)), 2) + 1;
  grid_.nz = std::max(int(std::ceil(all.y / grid_.cell_m - 1e-9)), 2) + 1;
}

Refraction::Refraction(const SeaState& sea, const WaveBins& bins, const ShallowWater& water,
                       const InputBounds& shallows, const DepthOfPlace& depth_m, const RefractionSettings& settings) {
  validate(settings);
  shelters_.resize(std::size_t(bins.cascades) + 1);
  const int bent = std::min(bins.cascades, bent_cascades);
  for (int i = 0; i < bent; ++i) waves_[std::size_t(i)] = mean_wave(sea, bins, i);
  if (shallows.empty()) return;
  lay_grid(shallows, settings);

  std::vector<double> depth(grid_.size());
  tbb::parallel_for(0, grid_.nz, [&](int j) {
    for (int i = 0; i < grid_.nx; ++i) depth[grid_.node(i, j)] = depth_m(grid_.place(i, j), grid_.cell_m);
  });
  for (int j = 0; j < grid_.nz; ++j)
    for (int i = 0; i < grid_.nx; ++i)
      if (const glm::dvec2 at = grid_.place(i, j); !std::isfinite(depth[grid_.node(i, j)]))
        throw Error("sea_depth",
                    fmt::format("the depth at x {:.1f} m, z {:.1f} m is no number or infinite", at.x, at.y),
                    "give the bed finite heights");

  tbb::parallel_for(0, bent, [&](int cascade) {
    const MeanWave& wave = waves_[std::size_t(cascade)];
    if (!(wave.wave_number > 0.0) || wave.direction == glm::dvec2(0.0)) return;
    std::vector<double> slowness(grid_.size());
    for (std::size_t n = 0; n < slowness.size(); ++n)
      slowness[n] = depth[n] > 0.0
                        ? std::min(airy_wave_number(wave.frequency, sea.gravity_mps2, depth[n]) / wave.wave_number,
                                   most_shortening)
                        : never;
    std::vector<double> delay = bent_fronts(grid_, slowness, wave.direction);
    hold_fall(grid_, delay, wave.direction, most_drawing_out);
    Field& field = shifts_[std::size_t(cascade)];
    field.resize(grid_.size());
    std::vector<std::uint8_t> known(grid_.size());
    for (std::size_t n = 0; n < delay.size(); ++n)
      known[n] = delay[n] < never, field[n] = known[n] ? float(delay[n]) : 0.0f;
    // By the water around alone: what stands before a breakwater and behind it has nothing to do with one another.
    Field weight(known.begin(), known.end());
    smooth(grid_, field);
    smooth(grid_, weight);
    for (std::size_t n = 0; n < field.size(); ++n) field[n] = known[n] ? field[n] / weight[n] : 0.0f;
    fill_unknown(grid_, field, std::move(known), 0.0f);
    for (float shift : field)
      most_shift_m_[std::size_t(cascade)] = std::max(most_shift_m_[std::size_t(cascade)], std::abs(double(shift)));
  });

  std::vector<Rose> roses;
  Rose together{};
  for (int i = 0; i < bins.cascades; ++i) {
    roses.push_back(rose_of(bins, i));
    for (std::size_t d = 0; d < directions; ++d) together[d] += roses.back()[d];
  }
  roses.push_back(together);
  Field left(grid_.size());
  std::vector<std::uint8_t> wet(grid_.size());
  for (std::size_t n = 0; n < depth.size(); ++n) wet[n] = depth[n] > 0.0, left[n] = 1.0f - water.breaking(depth[n]);
  std::vector<Field> reached(directions);
  tbb::parallel_for(0, directions, [&](int d) {
    if (together[std::size_t(d)] > 0.0) reached[std::size_t(d)] = sheltered(grid_, left, middle_of_sector(d));
  });
  tbb::parallel_for(std::size_t(0), roses.size(), [&](std::size_t r) {
    double all = 0.0;
    for (double share : roses[r]) all += share;
    if (!(all > 0.0)) return;
    std::vector<double> sum(grid_.size(), 0.0);
    for (std::size_t d = 0; d < directions; ++d)
      if (const double share = roses[r][d] / all; share > 0.0)
        for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += share * reached[d][n];
    Field& field = shelters_[r];
    field.assign(sum.begin(), sum.end());
    fill_unknown(grid_, field, wet, 0.0f);
    for (int pass = 0; pass < 3; ++pass) smooth(grid_, field);
    for (float& share : field) share = std::clamp(share, 0.0f, 1.0f);
  });
}

double Refraction::kept_outside(glm::dvec2 place_m, double over_m) const {
  const glm::dvec2 off = glm::max(glm::max(grid_.least - place_m, place_m - grid_.most()), glm::dvec2(0.0));
  const double t = std::min(glm::length(off) / over_m, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

double Refraction::shift(int cascade, glm::dvec2 place_m) const {
  if (cascade >= bent_cascades || shifts_[std::size_t(cascade)].empty() || !std::isfinite(place_m.x) ||
      !std::isfinite(place_m.y))
    return 0.0;
  const double most = most_shift_m_[std::size_t(cascade)];
  if (!(most > 0.0)) return 0.0;
  const double kept = kept_outside(place_m, 8.0 * most);
  return kept > 0.0 ? kept * grid_.bilinear(shifts_[std::size_t(cascade)], place_m) : 0.0;
}

float Refraction::shelter_at(const Field& field, glm::dvec2 place_m) const {
  if (field.empty() || !std::isfinite(place_m.x) || !std::isfinite(place_m.y)) return 1.0f;
  const double kept = kept_outside(place_m, grid_.cell_m * std::max(grid_.nx - 1, grid_.nz - 1));
  return kept > 0.0 ? float(1.0 + kept * (grid_.bilinear(field, place_m) - 1.0)) : 1.0f;
}

}  // namespace seascape
