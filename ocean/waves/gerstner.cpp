#include "ocean/waves/gerstner.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/text.h"
#include "ocean/waves/dispersion.h"
#include "ocean/waves/gaussian.h"
#include "ocean/waves/ladder.h"
#include "ocean/waves/wave_tiles_simd.h"

namespace seascape {

namespace {
constexpr int tile = Gerstner::tile_samples;
constexpr double turn = 2.0 * std::numbers::pi;
constexpr double most_ratio = 8.0;  // of the longest wave to the shortest

void require(double value, double least, double most, const std::string& name) {
  if (!(value >= least && value <= most))
    throw Error(name, text_from(value) + " is not in the range " + text_from(least) + " to " + text_from(most),
                "give a value in that range");
}

struct Asked {
  glm::dvec2 k;
  double amplitude_m, phase_turns, reverse;
};

// The waves of a set, the longest first.
std::vector<Asked> asked_of(const GerstnerSet& set, int number, std::uint32_t seed) {
  const int count = set.octaves == 0 ? 1 : set.octaves * set.waves;
  const auto random = [&](int wave, int which) {
    return uniform_number(seed, std::uint32_t((number * 64 + wave) * 4 + which));
  };
  // Each wave has its own share of the spread, in an order that does not follow the wavelengths (Fisher and Yates
  // 1938).
  std::vector<int> share(std::size_t(count), 0);
  for (int i = 0; i < count; ++i) share[std::size_t(i)] = i;
  for (int i = count - 1; i > 0; --i) std::swap(share[std::size_t(i)], share[std::size_t(random(i, 0) * (i + 1))]);
  std::vector<Asked> list;
  double squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const bool alone = count == 1;
    const double length = set.wavelength_m * std::exp2(alone ? 0.0 : -(i + random(i, 1)) / set.waves);
    const double off = alone ? 0.0 : (share[std::size_t(i)] + random(i, 2)) / count - 0.5;
    const double to = (set.to_deg + off * set.spread_deg) * std::numbers::pi / 180.0;
    list.push_back({turn / length * glm::dvec2(std::sin(to), -std::cos(to)), length, random(i, 3), set.reverse});
    squares += length * length;
  }
  // Variance is half the squares' sum, and a significant height four deviations; what comes the other way takes its
  // part of it.
  const double a_metre = 0.25 * set.height_m * std::sqrt(2.0 / (squares * (1.0 + set.reverse * set.reverse)));
  for (Asked& wave : list) wave.amplitude_m *= a_metre;
  return list;
}

struct Lattice {
  double side_m, rotation_rad;
  // Whole numbers of a wave vector that fits, others of one that does not.
  glm::dvec2 m(glm::dvec2 k) const { return side_m / turn * rotate_xz(k, -rotation_rad); }
  glm::dvec2 k(glm::dvec2 m) const { return turn / side_m * rotate_xz(m, rotation_rad); }
};

// The lattice that has the highest wave, and the others as nearly as any: their mean square distance from it, over
// their own vectors, by energy. `turned`: at any angle.
Lattice best_lattice(const std::vector<Asked>& waves, int most, bool turned) {
  const Asked& highest = *std::max_element(
      waves.begin(), waves.end(), [](const Asked& a, const Asked& b) { return a.amplitude_m < b.amplitude_m; });
  const auto through = [&](int mx, int mz) {
    return Lattice{turn * std::hypot(double(mx), double(mz)) / glm::length(highest.k),
                   turned ? std::atan2(highest.k.y, highest.k.x) - std::atan2(double(mz), double(mx)) : 0.0};
  };
  Lattice best = through(4, 0);
  const glm::dvec2 first = best.m(highest.k);
  if (waves.size() == 1 && glm::distance(first, glm::round(first)) < 1e-9) return best;
  double least = 1e300;
  for (int mz = 0; mz <= most; ++mz)
    for (int mx = 1; mx <= most; ++mx) {  // the other quadrants have the same lattices
      const Lattice lattice = through(mx, mz);
      double sum = 0.0, energy = 0.0, furthest = 0.0;
      for (const Asked& wave : waves) {
        const glm::dvec2 m = lattice.m(wave.k), off = m - glm::round(m);
        const double e = wave.amplitude_m * wave.amplitude_m;
        sum += e * glm::dot(off, off) / glm::dot(m, m);
        energy += e;
        furthest = std::max({furthest, std::abs(m.x), std::abs(m.y)});
      }
      if (furthest < 0.6 * most || furthest > most) continue;
      if (energy > 0.0 && sum / energy < least) least = sum / energy, best = lattice;
    }
  return best;
}

std::uint64_t turns_of(double k, double gravity_mps2, double depth_m, double loop_s) {
  const long double w = wave_frequency(static_cast<long double>(k), static_cast<long double>(gravity_mps2),
                                       static_cast<long double>(depth_m));
  const long double turns_a_second = w / (2.0L * std::numbers::pi_v<long double>);
  const std::int64_t loop = std::llround(loop_s * double(gpu::ticks_per_second));
  if (loop > 0) return loop_turns(std::max<std::int64_t>(1, std::llround(turns_a_second * loop_s)), loop);
  return static_cast<std::uint64_t>(
      std::round(turns_a_second * 0x1p64L / static_cast<long double>(gpu::ticks_per_second)));
}

[[noreturn]] void refuse_fold(double chop, double steepness) {
  throw Error("gerstner.chop",
              text_from(chop) + " would fold the surface over: the steepnesses of its waves come to " +
                  text_from(std::round(steepness * 1e3) / 1e3) + " and may come to 1",
              "take " + text_from(std::floor(1e3 * chop / steepness) / 1e3) + " or less, or lower or longer waves");
}

}  // namespace

void validate_together(const Gerstner& everywhere, const Gerstner& shore, double chop) {
  if (const double steepness = everywhere.steepness() + shore.steepness(); steepness > 1.0)
    refuse_fold(chop, steepness);
}

void validate(const GerstnerSettings& s) {
  std::array<double, 2> longest_of{}, shortest_of{1e300, 1e300};  // of the sets that share a tile
  for (int i = 0; i < GerstnerSettings::sets; ++i) {
    const GerstnerSet& set = i == 0 ? s.set1 : s.set2;
    const std::string name = "gerstner.set" + std::to_string(i + 1) + "_";
    require(set.height_m, 0.0, 30.0, name + "height_m");
    require(set.wavelength_m, 0.25, 1000.0, name + "wavelength_m");
    require(set.to_deg, 0.0, 360.0, name + "to_deg");
    require(set.spread_deg, 0.0, 360.0, name + "spread_deg");
    require(set.octaves, 0, 3, name + "octaves");
    require(set.waves, 1, 16, name + "waves");
    require(set.reverse, 0.0, 1.0, name + "reverse");
    if (set.height_m == 0.0) continue;
    double &longest_m = longest_of[set.shore], &shortest_m = shortest_of[set.shore];
    longest_m = std::max(longest_m, set.wavelength_m);
    shortest_m = std::min(shortest_m, set.wavelength_m / std::exp2(set.octaves));
    if (longest_m > most_ratio * shortest_m)
      throw Error(name + "wavelength_m",
                  text_from(set.wavelength_m) + " makes waves from " + text_from(shortest_m) + " to " +
                      text_from(longest_m) + " m, and one tile carries three octaves",
                  "take lengths of both sets within a factor of 8");
  }
  require(s.chop, 0.0, 2.0, "gerstner.chop");
}

Gerstner::Gerstner(const GerstnerSettings& settings, double gravity_mps2, double depth_m, double loop_s, bool shore)
    : shore_(shore) {
  validate(settings);
  std::vector<Asked> asked;
  for (int i = 0; i < GerstnerSettings::sets; ++i)
    if (const GerstnerSet& set = i == 0 ? settings.set1 : settings.set2; set.height_m > 0.0 && set.shore == shore)
      for (const Asked& wave : asked_of(set, i, settings.seed)) asked.push_back(wave);
  plan_ = make_fft_plan(tile, 16);
  laying_ = {1.0, 1.0, 0.0, 1.0, 1.0};
  if (asked.empty() || !(depth_m > 0.0)) return;
  const auto spectrum = [&](const GerstnerSet& set) {
    return set.height_m > 0.0 && set.octaves > 0 && set.shore == shore;
  };
  const bool spectra = spectrum(settings.set1) || spectrum(settings.set2);
  const int reach = spectra ? most_m : most_m_alone;
  const Lattice lattice = best_lattice(asked, reach, !shore);
  laying_.side_m = lattice.side_m;
  laying_.rotation_rad = lattice.rotation_rad;

  // Each wave takes the bin nearest to it, of those that no wave before it has: two in one would be one wave of another
  // height.
  std::vector<bool> taken(std::size_t(64 * 64), false);
  const auto place = [](int mx, int mz) { return std::size_t((mz + 32) * 64 + mx + 32); };
  taken[place(0, 0)] = true;
  int most = 0;
  const auto add = [&](glm::dvec2 k, double amplitude_m, double phase_turns) {
    if (amplitude_m == 0.0) return;
    const glm::dvec2 m = lattice.m(k);
    int best_x = 0, best_z = 0;
    double least = 1e300;
    for (int mz = -reach; mz <= reach; ++mz)
      for (int mx = -reach; mx <= reach; ++mx) {
        const glm::dvec2 off = glm::dvec2(mx, mz) - m;
        if (taken[place(mx, mz)] || glm::dot(off, off) >= least) continue;
        least = glm::dot(off, off);
        best_x = mx, best_z = mz;
      }
    taken[place(best_x, best_z)] = true;
    most = std::max({most, std::abs(best_x), std::abs(best_z)});
    waves_.push_back({best_x, best_z, amplitude_m, phase_turns, k});
  };
  for (const Asked& wave : asked) {
    add(wave.k, wave.amplitude_m, wave.phase_turns);
    add(-wave.k, wave.reverse * wave.amplitude_m, wave.phase_turns);
  }

  plan_ = make_fft_plan(tile, std::max(16, int(std::bit_ceil(unsigned(2 * most + 1)))));
  const int band = plan_.band;
  const std::size_t bins = std::size_t(band) * std::size_t(band);
  for (auto* list : {&table_.amplitude_re, &table_.amplitude_im, &table_.raise, &table_.kx, &table_.kz, &table_.shift_x,
                     &table_.shift_z, &table_.frequency})
    list->assign(bins, 0.0f);
  table_.turns.assign(bins, 0);
  double moments = 0.0, of_texels = 0.0, longest_m = 0.0, shortest_m = 1e300;
  for (int mz = -band / 2; mz < band / 2; ++mz)  // bins without a wave too: they mirror the others
    for (int mx = -band / 2; mx < band / 2; ++mx) {
      const std::size_t at = std::size_t((mz + band / 2) * band + mx + band / 2);
      const glm::dvec2 k = lattice.k({mx, mz});
      const double length = glm::length(k);
      if (length == 0.0) continue;
      const glm::dvec2 towards = settings.chop * orbit_width(length, depth_m) / length * k;
      table_.kx[at] = float(k.x);
      table_.kz[at] = float(k.y);
      table_.shift_x[at] = float(towards.x);
      table_.shift_z[at] = float(towards.y);
      table_.turns[at] = turns_of(length, gravity_mps2, depth_m, loop_s);
      table_.frequency[at] = float(double(table_.turns[at]) * 0x1p-64 * gpu::ticks_per_second * turn);
    }
  for (const GerstnerWave& wave : waves_) {
    const std::size_t at = std::size_t((wave.mz + band / 2) * band + wave.mx + band / 2);
    const glm::dvec2 vector = drawn(wave);
    const double k = glm::length(vector), a = wave.amplitude_m;
    const double raise = 1.0 / sampled_share(wave.mx, wave.mz, tile), width = settings.chop * orbit_width(k, depth_m);
    table_.raise[at] = float(raise);
    table_.amplitude_re[at] = float(raise * a * std::cos(turn * wave.phase_turns));
    table_.amplitude_im[at] = float(raise * a * std::sin(turn * wave.phase_turns));
    const glm::dvec2 slope = a * vector;
    statistics_.height_variance += 0.5 * a * a;
    statistics_.slope_moments += 0.5 * glm::dvec3(slope.x * slope.x, slope.y * slope.y, slope.x * slope.y);
    statistics_.largest_height_m += a;
    statistics_.largest_shift_m += width * a;
    statistics_.largest_curvature_per_m += std::max(1.0, width) * a * k * k;
    steepness_ += width * k * a;
    moments += a * a * k * k;
    of_texels += raise * raise * a * a * k * k;
    longest_m = std::max(longest_m, turn / k);
    shortest_m = std::min(shortest_m, turn / k);
  }
  if (steepness_ > 1.0) refuse_fold(settings.chop, steepness_);
  if (of_texels > 0.0)
    table_.moment_share = float(moments / of_texels);  // else no double holds the square of so low a wave
  table_.shear_length_m = std::exp2(std::round(std::log2(float(longest_m / turn))));
  laying_.longest_m = longest_m;
  laying_.shortest_m = shortest_m;
}

glm::dvec2 Gerstner::drawn(const GerstnerWave& wave) const {
  return Lattice{laying_.side_m, laying_.rotation_rad}.k({wave.mx, wave.mz});
}

std::size_t Gerstner::workspace_floats(bool velocity) const {
  return seascape::workspace_floats(plan_, {.velocity = velocity}) + 16;
}

void Gerstner::evaluate(std::int64_t ticks, bool velocity, std::span<const PlaneLevel> levels,
                        std::span<float> workspace) const {
  assert(workspace.size() >= workspace_floats(velocity) &&
         levels.size() == std::size_t(std::bit_width(unsigned(tile))));
  float* const work = workspace.data() + (64 - reinterpret_cast<std::uintptr_t>(workspace.data()) % 64) % 64 /
                                             sizeof(float);  // a cache line's begin
  constexpr int pairs_a_piece = 4;
  tbb::parallel_for(0, (row_pairs(plan_) + pairs_a_piece - 1) / pairs_a_piece, [&](int i) {
    waves_along_x(table_, plan_, ticks, {.velocity = velocity}, i * pairs_a_piece,
                  std::min((i + 1) * pairs_a_piece, row_pairs(plan_)), work);
  });
  tbb::parallel_for(0, tile / strip_width, [&](int i) {
    strip_along_z(table_, plan_, work, {.velocity = velocity}, i * strip_width, levels[0]);
    strip_mips(plan_, i * strip_width, levels.data());
  });
  for (std::size_t level = strip_levels + 1; level < levels.size(); ++level)
    average_down(levels[level - 1], levels[level], 0, tile >> level, tile >> level);
}

}  // namespace seascape
