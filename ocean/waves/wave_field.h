// The sea on the CPU: every deterministic wave at any time, on any thread, with no GPU. The same bins, tiles, mip chain
// and sampling as the compute shaders.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ocean/waves/fft.h"
#include "ocean/waves/ladder.h"
#include "ocean/waves/pattern_warp.h"
#include "ocean/waves/sea_state.h"
#include "ocean/waves/tile_source.h"
#include "shaders/shared/wave_bin.h"

namespace seascape {

// All waves of a sea at a quality: one table of bins_of(cascade)^2 a cascade, cascade after cascade.
struct WaveBins {
  Ladder ladder;
  int cascades = 0;
  std::vector<gpu::WaveBin> bins;

  // Where a cascade's table begins.
  static constexpr std::size_t first(int cascade) {
    std::size_t result = 0;
    for (int i = 0; i < cascade; ++i) result += std::size_t(bins_of(i)) * std::size_t(bins_of(i));
    return result;
  }
  // A bin by its wave numbers, -bins_of(cascade) / 2 and up.
  gpu::WaveBin& at(int cascade, int mx, int mz) { return bins[place(cascade, mx, mz)]; }
  const gpu::WaveBin& at(int cascade, int mx, int mz) const { return bins[place(cascade, mx, mz)]; }

 private:
  static std::size_t place(int cascade, int mx, int mz) {
    const int n = bins_of(cascade);
    return first(cascade) + std::size_t(mz + n / 2) * std::size_t(n) + std::size_t(mx + n / 2);
  }
};

// Bins whose |m| reaches half the tile's samples are left out (a 16^2 tile keeps |m| < 8); a kept bin never depends on
// the quality.
WaveBins make_wave_bins(const SeaState& sea, const WaveQuality& quality);
// The same on the ladder of another sea, whose waves these are to grow out of.
WaveBins make_wave_bins(const SeaState& sea, const WaveQuality& quality, const Ladder& ladder);

// What a lower quality keeps of them; whether it keeps all.
WaveBins kept_bins(const WaveBins& bins, const WaveQuality& quality);
bool keeps_all(const WaveQuality& quality, const WaveBins& bins);

// A bin's amplitude as a tile of `samples` texels a side carries it: higher by what bilinear sampling takes
// (sampled_share).
glm::vec2 drawn_amplitude(const gpu::WaveBin& bin, int mx, int mz, int samples);

// The slope variance of a cascade's waves over that of its texels, which carry them higher.
float moment_share(const WaveBins& bins, int cascade, int samples);

// Turns a tick, times 2^64, of a wave of `turns` whole turns in `ticks` (1 to 2^47, more than turns), rounded up: the
// phase after `ticks` is then a whole turn and less than ticks 2^-64 of one, of which phase_turns sees nothing for
// loops shorter than 4096 s.
std::uint64_t loop_turns(std::int64_t turns, std::int64_t ticks);

// The period nearest to `period_s` (both above 0) that a loop has a whole number of, at most all of it; `period_s`
// where `loop_s` is 0.
double period_in_loop(double period_s, double loop_s);

std::int64_t ticks_from_seconds(double time_s);

// The largest distance in metres at which a mesh of square cells, vertices on the sea and its triangles flat, passes
// the sea itself, of some million points, by its vertices' spacing: rises with it. All zero: unknown.
struct MeshError {
  static constexpr double least_spacing_m = 1.0 / 128.0;
  static constexpr double most_over_spacing = 0.12;  // of any water, over the vertices' spacing
  std::array<double, 20> octave_m{};                 // of spacings of 1, 2, 4, ... times the least
  double operator()(double spacing_m) const;
  bool known() const { return octave_m.back() > 0.0; }
};

// How far the water moves against what the sea, smoothed over `footprint_m`, does at one place: standard deviations in
// metres of the height and of the shift, of all water up to some distance from there.
struct NearMotion {
  static constexpr double footprint_m = 8.0, least_distance_m = 0.25;
  std::array<double, 16> vertical_m{}, horizontal_m{};  // for distances of 1, 2, 4, ... times the least
  glm::dvec2 operator()(double distance_m) const;       // the height's, the shift's
  // Other waves besides, whose height's standard deviation is `height_m`: at every distance.
  void add(double height_m, double chop);
};

// Sums over the drawn bins: what the surface's statistics must come to. Variances in m^2 and (dimensionless) slope^2.
struct SeaStatistics {
  double height_variance = 0.0;        // Hs = 4 sqrt of it
  glm::dvec3 slope_moments{0.0};       // E[hx^2], E[hz^2], E[hx hz] of the drawn waves
  glm::dvec3 tail_slope_moments{0.0};  // of the waves too short to be drawn: the rest of the spectrum's
  double largest_height_m = 0.0;       // a bound for culling: 99.9999 % of crests, chop included
  double largest_shift_m = 0.0;        // the same for horizontal displacement
  MeshError mesh_error;                // what meshes of this sea miss
  NearMotion near_motion;              // its horizontal part with the sea's chop
};
SeaStatistics sea_statistics(const SeaState& sea, const WaveBins& bins);

// Displacement, derivatives and their mip chains of each cascade at one time.
class WaveTiles;  // ocean/waves/wave_tiles.h
struct TileFields;
struct SampledPlaces;  // ocean/waves/tile_sampler_simd.h
struct BorrowedTile;

// The surface at one rest position.
struct SeaSample {
  glm::dvec3 displacement{0.0};     // metres, to add to (x, 0, z)
  glm::dvec2 height_gradient{0.0};  // dh/dx, dh/dz over the rest position
  glm::dvec3 shift_gradient{0.0};   // dDx/dx, dDz/dz, dDx/dz (= dDz/dx)
  glm::dvec3 slope_moments{0.0};    // unresolved E[s^2] below the footprint: xx, zz, xz
  double divergence_moment = 0.0;   // unresolved E[(dDx/dx + dDz/dz)^2] of the drawn waves below the footprint
  glm::dvec2 slope() const;         // of the displaced surface: inverse transpose of (I + grad D) times height_gradient
  double jacobian() const;          // det(I + grad D): 1 at rest, below 0 where the surface folds
};

// What a cascade's transforms need of its waves, planar: [mz + band/2][mx + band/2] without padding.
struct WaveTable {
  std::vector<float> amplitude_re, amplitude_im;
  std::vector<float> raise;  // how much higher tiles carry a wave (drawn_amplitude), 0 beyond the samples' reach
  std::vector<std::uint64_t> turns;     // turns a tick, times 2^64
  std::vector<float> kx, kz;            // world wave vector, rad/m
  std::vector<float> shift_x, shift_z;  // chop kx / k and chop kz / k, each times the orbit's width
  std::vector<float> frequency;         // rad/s
  // Two fields of one transform share its rounding: dDx/dz is carried at the size of Dz, times this length, a power of
  // two.
  float shear_length_m = 1.0f;
  // Second moments are of what sampling leaves of the tile's waves: the squares of its texels times this
  // (drawn_amplitude).
  float moment_share = 1.0f;
};

// Every deterministic wave of a sea, ready to be evaluated at any time. Immutable but for take(): any number of threads
// may use one field, each with its own tiles.
class WaveField {
 public:
  // Throws Error as validate() does (spectrum.h). `others`: what feeds the sea beside its waves.
  WaveField(const SeaState& sea, const WaveQuality& quality, TileSources others = {});
  // A sea of given waves, made for the same quality; of `sea` the chop, gravity, depth and wind count.
  WaveField(const SeaState& sea, const WaveQuality& quality, WaveBins bins, TileSources others = {});
  // The same with the statistics of these waves or more of the same sea, where they are known.
  WaveField(const SeaState& sea, const WaveQuality& quality, WaveBins bins,
            const std::optional<SeaStatistics>& statistics, TileSources others);

  // Other amplitudes of the same waves, and another chop, as a changing sea has them. `bins` may be of a higher
  // quality. Not while another thread uses the field.
  void take(const WaveBins& bins, double chop, const SeaStatistics& statistics);

  // Other sources, of the same shape one by one (alike). Not while another thread uses the field.
  void feed(TileSources others);

  // Fills the tiles for a time in ticks (ticks_from_seconds), on all cores. The result depends on nothing but the sea,
  // the quality and the ticks: not on the number of threads, nor on what the tiles held. No allocation but in tiles of
  // another shape.
  void evaluate(std::int64_t ticks, WaveTiles& tiles, std::span<const BorrowedTile> borrowed = {},
                bool slopes = true) const {
    begin(ticks, tiles, borrowed);
    fill(tiles, 0, piece_count(), slopes);
  }
  // The same in parts: begin() shapes the tiles for a time, and fill() does the pieces of the work from `first` to
  // `last` - 1, of which all before have been done.
  void begin(std::int64_t ticks, WaveTiles& tiles, std::span<const BorrowedTile> borrowed = {}) const;
  void fill(WaveTiles& tiles, int first, int last, bool slopes = true) const;
  int piece_count() const { return cascade_pieces() + int(others_.size()); }
  // How many pieces are within a share (0 to 1) of the work.
  int pieces_within(double share) const;
  int tile_count() const { return quality_.cascades + int(others_.size()); }

  // The surface at a rest position (x, z in metres), of all sources, smoothed over a footprint of `footprint_m`: each
  // cascade is sampled trilinearly at lod = log2(max(footprint, texel) / texel), texel = side / samples, at tile
  // coordinates u + 0.5 / samples (texel centres at (i + 0.5) / size on every level). From half a cascade's longest
  // wave on a footprint fades it (kept_share); one that is gone, or whose lod reaches its last level, adds only its
  // moments.
  SeaSample sea(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const;
  // Displacement alone, and the velocity of the water at a rest position (tiles with velocity only), sampled alike.
  glm::dvec3 displacement(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const;
  glm::dvec3 velocity(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const;

  // The same for many places of one footprint, whose mip levels are found once.
  static constexpr int most_places = gpu::max_cascades + most_layings;
  struct Filter {
    std::array<int, most_places> level;      // the finer of two levels; the tile's last level: moments only
    std::array<float, most_places> between;  // towards the next, 0 to 1
    std::array<float, most_places> share;    // of the place that the footprint keeps (kept_share)
  };
  Filter filter(double footprint_m) const;
  SeaSample sea(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const;
  glm::dvec3 displacement(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const;
  glm::dvec3 velocity(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const;
  // Whether there is a source that is laid along curves (TileSource::along_curves), which these samples leave out.
  bool has_curved() const { return laid_ < places_.size(); }

  const SeaState& state() const { return sea_; }
  const WaveQuality& quality() const { return quality_; }
  const WaveBins& bins() const { return bins_; }
  const SeaStatistics& statistics() const { return statistics_; }
  struct Place {  // from world to tile coordinates, and what is made of the tile there
    double cosine, sine, inverse_side, texel_m;
    int tile;                         // whose: cascades, then sources
    double offset = 0.0, size = 1.0;  // of a laying (tile_source.h)
    double longest_m = 0.0;
    glm::dvec3 decay_per_m2{0.0};  // PatternMoments
  };
  std::span<const Place> places() const {
    return {places_.data(), laid_};
  }  // of each cascade, then of each laying of the other sources
  // Of what is laid along curves, and where a filter has its share.
  const Place& curved_place() const { return places_[laid_]; }
  std::size_t curved() const { return laid_; }
  const TileSources& others() const { return others_; }
  // The warp of the first cascade's pattern, which is the first place; none where it lies straight.
  const PatternWarp& warp() const { return warp_; }

 private:
  SeaState sea_;
  WaveQuality quality_;
  WaveBins bins_;
  SeaStatistics statistics_;
  std::vector<FftPlan> plans_;  // these three a cascade
  std::vector<WaveTable> tables_;
  std::vector<Place> places_;
  PatternWarp warp_;
  std::size_t laid_ = 0;  // of them over the sea; what follows is laid along curves
  TileSources others_;
  SampledPlaces sampled(const WaveTiles& tiles, glm::dvec2 rest_m, const Filter& filter) const;
  int cascade_pieces() const;
  void fill_cascades(WaveTiles& tiles, const TileFields& fields, int begin, int end) const;
  void fill_others(WaveTiles& tiles, int begin, int end) const;
};

}  // namespace seascape
