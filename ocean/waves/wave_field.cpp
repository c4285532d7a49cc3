#include "ocean/waves/wave_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "ocean/waves/dispersion.h"
#include "ocean/waves/pattern_moments.h"
#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_tiles.h"
#include "ocean/waves/wave_tiles_simd.h"

namespace seascape {

namespace {
// Of a cascade whose tile has `samples` texels a side; `band` x `band` of its bins.
WaveTable make_table(const SeaState& sea, const WaveBins& bins, int index, int samples, int band) {
  const Cascade& cascade = bins.ladder[index];
  const double step = 2.0 * std::numbers::pi / cascade.side_m;
  const glm::dvec2 along = rotate_xz({1.0, 0.0}, cascade.rotation_rad),
                   across = rotate_xz({0.0, 1.0}, cascade.rotation_rad);
  WaveTable table;
  table.moment_share = moment_share(bins, index, samples);
  table.shear_length_m = std::exp2(std::round(std::log2(float(1.0 / (12.0 * step)))));
  std::vector<double> sampled;  // sampled_share is a product of this of both axes
  for (int m = 0; m <= band / 2; ++m) sampled.push_back(sampled_share(m, 0, samples));
  for (int mz = -band / 2; mz < band / 2; ++mz)
    for (int mx = -band / 2; mx < band / 2; ++mx) {
      const gpu::WaveBin& bin = bins.at(index, mx, mz);
      const bool carried = mx * mx + mz * mz < samples * samples / 4;
      const float raise =
          carried ? float(1.0 / (sampled[std::size_t(std::abs(mx))] * sampled[std::size_t(std::abs(mz))])) : 0.0f;
      const glm::vec2 amplitude = raise * bin.amplitude;
      const glm::dvec2 k = step * (double(mx) * along + double(mz) * across);
      const double length = glm::length(k);
      const glm::dvec2 towards =
          length > 0.0 ? sea.chop * orbit_width(length, sea.depth_m) / length * k : glm::dvec2(0.0);
      table.raise.push_back(raise);
      table.amplitude_re.push_back(amplitude.x);
      table.amplitude_im.push_back(amplitude.y);
      table.turns.push_back((std::uint64_t(bin.turns_high) << 32) | bin.turns_low);
      table.kx.push_back(float(k.x));
      table.kz.push_back(float(k.y));
      table.shift_x.push_back(float(towards.x));
      table.shift_z.push_back(float(towards.y));
      // From the turns that it runs by, so that velocity is the displacement's rate of change at every depth and in a
      // loop.
      table.frequency.push_back(
          float(double(table.turns.back()) * 0x1p-64 * gpu::ticks_per_second * 2.0 * std::numbers::pi));
    }
  return table;
}
}  // namespace

WaveField::WaveField(const SeaState& sea, const WaveQuality& quality, TileSources others)
    : WaveField(sea, quality, make_wave_bins(sea, quality), std::move(others)) {}

WaveField::WaveField(const SeaState& sea, const WaveQuality& quality, WaveBins bins, TileSources others)
    : WaveField(sea, quality, std::move(bins), std::nullopt, std::move(others)) {}

WaveField::WaveField(const SeaState& sea, const WaveQuality& quality, WaveBins bins,
                     const std::optional<SeaStatistics>& statistics, TileSources others)
    : sea_(sea),
      quality_(quality),
      bins_(std::move(bins)),
      statistics_(statistics ? *statistics : sea_statistics(sea, bins_)) {
  for (int i = 0; i < quality.cascades; ++i) {
    const Cascade& cascade = bins_.ladder[i];
    const int samples = tile_samples(quality, i);
    plans_.push_back(make_fft_plan(samples, std::min(samples, bins_of(i))));
    tables_.push_back(make_table(sea, bins_, i, samples, plans_.back().band));
    places_.push_back({std::cos(cascade.rotation_rad), std::sin(cascade.rotation_rad), 1.0 / cascade.side_m,
                       cascade.side_m / samples, i, 0.0, 1.0, longest_wave(cascade),
                       pattern_moments(bins_, i).decay_per_m2()});
  }
  if (quality.cascades > 0) warp_ = PatternWarp(bins_.ladder);
  feed(std::move(others));
}

void WaveField::feed(TileSources others) {
  others_ = std::move(others);
  std::erase_if(others_, [](const auto& source) { return source->still(); });
  assert(others_.size() <= std::size_t(most_sources));
  laid_ = std::size_t(quality_.cascades);
  places_.resize(laid_);
  // What is laid along curves comes last.
  std::stable_partition(others_.begin(), others_.end(), [](const auto& source) { return !source->along_curves(); });
  for (std::size_t s = 0; s < others_.size(); ++s) {
    if (!others_[s]->along_curves()) laid_ = places_.size() + others_[s]->layings().size();
    for (const Laying& laying : others_[s]->layings())
      places_.push_back({std::cos(laying.rotation_rad), std::sin(laying.rotation_rad), 1.0 / laying.side_m,
                         laying.side_m / others_[s]->samples(), quality_.cascades + int(s), laying.offset, laying.size,
                         laying.longest_m, pattern_moments(*others_[s], laying).decay_per_m2()});
  }
  assert(places_.size() <= std::size_t(most_places));
}

void WaveField::take(const WaveBins& bins, double chop, const SeaStatistics& statistics) {
  const bool turned = chop != sea_.chop;
  sea_.chop = chop;
  statistics_ = statistics;
  tbb::parallel_for(0, quality_.cascades, [&](int cascade) {
    WaveTable& table = tables_[cascade];
    const int band = plans_[cascade].band;
    std::size_t at = 0;
    for (int mz = -band / 2; mz < band / 2; ++mz)
      for (int mx = -band / 2; mx < band / 2; ++mx, ++at) {
        const glm::vec2 amplitude = bins.at(cascade, mx, mz).amplitude;
        bins_.at(cascade, mx, mz).amplitude = table.raise[at] > 0.0f ? amplitude : glm::vec2(0.0f);
        table.amplitude_re[at] = table.raise[at] * amplitude.x;
        table.amplitude_im[at] = table.raise[at] * amplitude.y;
        if (!turned) continue;
        const float k = std::hypot(table.kx[at], table.kz[at]),
                    towards = k > 0.0f ? float(chop * orbit_width(double(k), sea_.depth_m)) / k : 0.0f;
        table.shift_x[at] = towards * table.kx[at];
        table.shift_z[at] = towards * table.kz[at];
      }
    places_[std::size_t(cascade)].decay_per_m2 = pattern_moments(bins_, cascade).decay_per_m2();
  });
}

void WaveField::begin(std::int64_t ticks, WaveTiles& tiles, std::span<const BorrowedTile> borrowed) const {
  tiles.shape(quality_, others_);
  tiles.ticks_ = ticks;
  tiles.borrowed_.fill(false);
  for (const BorrowedTile& loan : borrowed) {
    const WaveTiles& from = *loan.from;
    assert(from.samples(loan.from_tile) == tiles.samples(loan.tile) && from.planes_ >= tiles.planes_ &&
           from.ticks_ == ticks);
    tiles.first_[std::size_t(loan.tile)] = from.first_[std::size_t(loan.from_tile)];
    tiles.layout_.tiles[std::size_t(loan.tile)] = from.layout_.tiles[std::size_t(loan.from_tile)];
    tiles.borrowed_[std::size_t(loan.tile)] = true;
  }
}

void WaveField::fill(WaveTiles& tiles, int first, int last, bool slopes) const {
  const int cascades = cascade_pieces();
  fill_cascades(tiles, {.slopes = slopes, .velocity = tiles.has_velocity()}, first, std::min(last, cascades));
  fill_others(tiles, std::max(first - cascades, 0), last - cascades);
}

namespace {
// A cascade's pieces of work: those of its rows, then strips of its columns.
constexpr int piece_pairs = 16;
// Tiles of as many texels a side do not stay in a core's cache until they are read.
constexpr int streamed_samples = 256;
int row_pieces(const FftPlan& plan) { return (row_pairs(plan) + piece_pairs - 1) / piece_pairs; }
int strips_of(const FftPlan& plan) { return plan.n / strip_width; }
}  // namespace

int WaveField::cascade_pieces() const {
  int count = 0;
  for (const FftPlan& plan : plans_) count += row_pieces(plan) + strips_of(plan);
  return count;
}

int WaveField::pieces_within(double share) const {
  // A piece costs as its rows and columns are long; a source about as much as a cascade of its size.
  const auto of_source = [](const TileSource& source) { return source.samples() * source.samples() / strip_width; };
  std::int64_t all = 0;
  for (const FftPlan& plan : plans_) all += std::int64_t(row_pieces(plan) + strips_of(plan)) * plan.n;
  for (const auto& source : others_) all += of_source(*source);
  std::int64_t left = std::int64_t(std::clamp(share, 0.0, 1.0) * double(all));
  int count = 0;
  for (const FftPlan& plan : plans_) {
    const std::int64_t here = std::min<std::int64_t>(left / plan.n, row_pieces(plan) + strips_of(plan));
    count += int(here);
    if (here < row_pieces(plan) + strips_of(plan)) return count;
    left -= here * plan.n;
  }
  for (const auto& source : others_) {
    left -= of_source(*source);
    if (left < 0) return count;
    ++count;
  }
  return count;
}

void WaveField::fill_cascades(WaveTiles& tiles, const TileFields& fields, int begin, int end) const {
  const int cascades = quality_.cascades;
  std::array<std::size_t, gpu::max_cascades> workspace{};  // where each cascade's begins
  // How many pieces of rows are before a cascade's, and its first; and strips alike.
  using Firsts = std::array<int, gpu::max_cascades + 1>;
  Firsts pieces{}, strips{}, first_piece{}, first_strip{};
  std::size_t floats = 0;
  int before = 0;
  for (int i = 0; i < cascades; ++i) {
    workspace[std::size_t(i)] = floats;
    floats += workspace_floats(plans_[i], fields);
    const int rows = row_pieces(plans_[i]), columns = strips_of(plans_[i]);
    const bool work = !tiles.borrowed_[std::size_t(i)];
    const auto within = [&](int from, int count, int& first) {
      first = std::clamp(begin - from, 0, count);
      return work ? std::clamp(end - from, first, count) - first : 0;
    };
    pieces[std::size_t(i) + 1] = pieces[std::size_t(i)] + within(before, rows, first_piece[std::size_t(i)]);
    strips[std::size_t(i) + 1] = strips[std::size_t(i)] + within(before + rows, columns, first_strip[std::size_t(i)]);
    before += rows + columns;
  }
  const auto cascade_of = [](const Firsts& firsts, int piece) {
    int cascade = 0;
    while (piece >= firsts[std::size_t(cascade) + 1]) ++cascade;
    return cascade;
  };
  if (tiles.workspace_.size() < floats) tiles.workspace_.assign(floats, 0.0f);
  const bool lent = tiles.lent_tiles_ > 0;
  const auto plane_level = [&](int cascade, int level) { return tiles.plane_level(cascade, level, fields); };
  // Each piece of work writes texels of its own from inputs that are complete: any division into threads gives the same
  // bits.
  tbb::parallel_for(0, pieces[std::size_t(cascades)], [&](int i) {
    const int cascade = cascade_of(pieces, i),
              first = (i - pieces[std::size_t(cascade)] + first_piece[std::size_t(cascade)]) * piece_pairs;
    const FftPlan& plan = plans_[cascade];
    waves_along_x(tables_[cascade], plan, tiles.ticks_, fields, first, std::min(first + piece_pairs, row_pairs(plan)),
                  &tiles.workspace_[workspace[std::size_t(cascade)]]);
  });
  tbb::parallel_for(0, strips[std::size_t(cascades)], [&](int i) {
    const int cascade = cascade_of(strips, i),
              x = (i - strips[std::size_t(cascade)] + first_strip[std::size_t(cascade)]) * strip_width;
    const FftPlan& plan = plans_[cascade];
    const float* const from = &tiles.workspace_[workspace[std::size_t(cascade)]];
    if (lent || plan.n >= streamed_samples)
      return strip_out(tables_[cascade], plan, from, fields, x, tiles.strip_places(cascade, fields, lent));
    PlaneLevel levels[strip_levels + 1];
    for (int level = 0; level <= strip_levels; ++level) levels[level] = plane_level(cascade, level);
    strip_along_z(tables_[cascade], plan, from, fields, x, levels[0]);
    strip_mips(plan, x, levels);
  });
  for (int cascade = 0; cascade < cascades; ++cascade) {
    // Of cascades whose last strip was among them.
    const int done = strips[std::size_t(cascade) + 1] - strips[std::size_t(cascade)];
    if (done == 0 || first_strip[std::size_t(cascade)] + done < strips_of(plans_[cascade])) continue;
    for (int level = strip_levels + 1; level < tiles.levels(cascade); ++level) {
      const int size = plans_[cascade].n >> level;
      average_down(plane_level(cascade, level - 1), plane_level(cascade, level), 0, size, size);
    }
    if (lent && tiles.in_halves()) tiles.finish_halves(cascade);
  }
}

void WaveField::fill_others(WaveTiles& tiles, int begin, int end) const {
  const bool velocity = tiles.has_velocity();
  std::size_t floats = 0;
  for (const auto& source : others_) floats = std::max(floats, source->workspace_floats(velocity));
  if (tiles.workspace_.size() < floats) tiles.workspace_.assign(floats, 0.0f);
  for (int s = begin; s < end; ++s) {
    std::array<PlaneLevel, 10> levels;
    const int tile = quality_.cascades + s, count = tiles.levels(tile);
    if (tiles.borrowed_[std::size_t(tile)]) continue;
    for (int level = 0; level < count; ++level)
      levels[std::size_t(level)] = tiles.plane_level(tile, level, {.velocity = velocity});
    others_[std::size_t(s)]->evaluate(tiles.ticks_, velocity, {levels.data(), std::size_t(count)},
                                      {tiles.workspace_.data(), floats});
  }
}

}  // namespace seascape
