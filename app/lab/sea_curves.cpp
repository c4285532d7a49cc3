// Curves of the waves themselves: queries, transforms, cascades.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <numbers>
#include <random>

#include "app/lab/lab.h"
#include "app/quality.h"
#include "ocean/sea/query.h"
#include "ocean/waves/half_floats.h"
#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;

// Memory that begins with a cache line.
struct Floats {
  void resize(std::size_t count) { memory.resize(count + 16); }
  float* data() {
    return memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64 / sizeof(float);
  }
  std::vector<float> memory;
};

double hs_of(const WaveField& field) { return 4.0 * std::sqrt(field.statistics().height_variance); }

// ---- queries

struct QuerySea {
  QuerySea(double wind_mps, const LabOptions& options) : field(lab_sea(wind_mps, options), WaveQuality{256, 5, false}) {
    field.evaluate(ticks_from_seconds(10.0), tiles);
    std::mt19937 random(options.seed + 1);
    std::uniform_real_distribution<double> within(-500.0, 500.0);
    const std::size_t count = options.quick ? 1024 : 4096;
    for (std::size_t i = 0; i < count; ++i) places.emplace_back(within(random), within(random));
    answers.resize(count);
    heights.resize(count);
    // The rest positions by so many steps that nothing more changes. Where the sea folds the steps need not end: such
    // places are left out.
    const WaveField::Filter filter = field.filter(0.0);
    for (const glm::dvec2 place : places) {
      glm::dvec2 rest = place, before = place;
      for (int step = 0; step < 200 && (step == 0 || rest != before); ++step) {
        const glm::dvec3 d = field.displacement(tiles, before = rest, filter);
        rest = place - glm::dvec2(d.x, d.z);
      }
      const bool found = glm::distance(rest, before) < 1e-6;
      truth.push_back(found ? field.displacement(tiles, rest, filter).y : std::nan(""));
      // What a step multiplies a small residual by at most: the norm of grad D (Banach's theorem).
      const glm::dvec3 g = field.sea(tiles, rest, filter).shift_gradient;
      contraction.push_back(std::abs(0.5 * (g.x + g.y)) + std::hypot(0.5 * (g.x - g.y), g.z));
      first_miss.push_back(found ? field.displacement(tiles, place, filter).y - truth.back() : 0.0);
    }
  }
  // Root mean square of what heights miss, over Hs.
  template <class Height>
  double error(Height height) const {
    double sum = 0.0, n = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      if (std::isfinite(truth[i])) sum += std::pow(height(i) - truth[i], 2), n += 1.0;
    return std::sqrt(sum / std::max(n, 1.0)) / hs_of(field);
  }
  WaveField field;
  WaveTiles tiles;
  std::vector<glm::dvec2> places;
  std::vector<QueryAnswer> answers;
  // What contraction leaves of the first miss after so many steps.
  double predicted(int steps) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      sum += std::pow(first_miss[i] * std::pow(contraction[i], steps), 2) / double(truth.size());
    return std::sqrt(sum) / hs_of(field);
  }
  std::vector<double> truth, heights, contraction, first_miss;
};

// One step of the search in double: x <- q - D(x), or Newton's.
glm::dvec2 next_rest(const QuerySea& sea, const WaveField::Filter& filter, glm::dvec2 place, glm::dvec2 rest,
                     bool newton) {
  if (!newton) {
    const glm::dvec3 d = sea.field.displacement(sea.tiles, rest, filter);
    return place - glm::dvec2(d.x, d.z);
  }
  const SeaSample at = sea.field.sea(sea.tiles, rest, filter);
  const glm::dvec2 miss = place - rest - glm::dvec2(at.displacement.x, at.displacement.z);
  const glm::dvec3 g = at.shift_gradient;
  return rest + glm::dvec2((1.0 + g.y) * miss.x - g.z * miss.y, (1.0 + g.x) * miss.y - g.z * miss.x) /
                    std::max(at.jacobian(), 0.1);
}

std::vector<LabTask> query_tasks(double wind_mps, const LabOptions& options) {
  const auto sea = std::make_shared<QuerySea>(wind_mps, options);
  std::vector<LabTask> tasks;
  const double count = double(sea->places.size());
  const auto answered = [=] {
    return std::vector<LabError>{{sea->error([&](std::size_t i) { return sea->answers[i].height_m; }), "of Hs, rms"}};
  };
  for (int steps = 0; steps <= 8; ++steps) {
    const auto ask = [=] {
      query(sea->field, sea->tiles, sea->places, sea->answers, {.most_iterations = steps, .tolerance_m = 0.0});
    };
    tasks.push_back({"query(), fixed point", double(steps), ask, count, answered, "", ""});
    for (const bool newton : {false, true}) {
      if (newton && steps > 5) continue;  // at its floor long before
      const auto search = [=] {
        const WaveField::Filter filter = sea->field.filter(0.0);
        for (std::size_t i = 0; i < sea->places.size(); ++i) {
          glm::dvec2 rest = sea->places[i];
          for (int step = 0; step < steps; ++step) rest = next_rest(*sea, filter, sea->places[i], rest, newton);
          sea->heights[i] = sea->field.displacement(sea->tiles, rest, filter).y;
        }
      };
      tasks.push_back({newton ? "plain loop, Newton" : "plain loop, fixed point", double(steps), search, count,
                       [=] {
                         const double miss = sea->error([&](std::size_t i) { return sea->heights[i]; });
                         if (newton) return std::vector<LabError>{{miss, "of Hs, rms"}};
                         return std::vector<LabError>{{miss, "of Hs, rms"},
                                                      {sea->predicted(steps), "of Hs, rms, as the contraction has it"}};
                       },
                       "", ""});
    }
  }
  const auto shipped = [=] { query(sea->field, sea->tiles, sea->places, sea->answers); };
  tasks.push_back({"query() as shipped, to 1 mm", 8.0, shipped, count, answered, "low medium high ultra", ""});
  return tasks;
}

// ---- transforms

// The cascade that has most of the height's variance.
int highest_cascade(const WaveBins& bins) {
  int best = 0;
  double most = 0.0;
  for (int cascade = 0; cascade < bins.cascades; ++cascade) {
    double sum = 0.0;
    for (std::size_t at = WaveBins::first(cascade); at < WaveBins::first(cascade + 1); ++at)
      sum += double(glm::dot(bins.bins[at].amplitude, bins.bins[at].amplitude));
    if (sum > most) most = sum, best = cascade;
  }
  return best;
}

// A cascade's waves as a spectrum of heights, or of slopes along x.
struct Transformed {
  Transformed(const WaveBins& bins, int of_cascade, int samples, bool of_slopes, bool halves)
      : cascade(of_cascade),
        n(samples),
        band(std::min(samples, bins_of(cascade))),
        slopes(of_slopes),
        half_storage(halves),
        plan(make_fft_plan(samples, band)) {
    for (int mz = -band / 2; mz < band / 2; ++mz)
      for (int mx = -band / 2; mx < band / 2; ++mx) {
        const bool kept = std::max(std::abs(mx), std::abs(mz)) < band / 2;  // the tile's Nyquist waves are none
        const glm::vec2 f = kept ? value(bins, mx, mz) : glm::vec2(0.0f);
        re.push_back(f.x);
        im.push_back(f.y);
      }
    stride = n + 16;
    halves_.resize(std::uint32_t(stride) * std::uint32_t(n));
    field_re.resize(halves_.size());
    field_im.resize(halves_.size());
    workspace.resize(inverse_fft_floats(plan));
  }
  void run() {
    inverse_fft(plan, re.data(), im.data(), field_re.data(), field_im.data(), stride,
                {workspace.data(), inverse_fft_floats(plan)});
    if (half_storage) halves_from_floats(field_re.data(), halves_.data(), halves_.size());
  }
  // Relative L2 over places against the sum in double of all the tile's waves, and of those that the transform carries.
  std::vector<LabError> errors(const WaveBins& bins, std::uint32_t seed) {
    std::mt19937 random(seed);
    double miss = 0.0, miss_own = 0.0, size = 0.0, size_own = 0.0;
    std::vector<std::complex<double>> turn(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) turn[std::size_t(i)] = std::polar(1.0, 2.0 * pi * i / n);
    for (int place = 0; place < 60; ++place) {
      const int x = int(random() % unsigned(n)), z = int(random() % unsigned(n));
      double own = 0.0, whole = 0.0;
      const int half = bins_of(cascade) / 2;
      for (int mz = 1 - half; mz < half; ++mz)
        for (int mx = 1 - half; mx < half; ++mx) {
          const glm::vec2 f = value(bins, mx, mz);
          const std::complex<double>& w = turn[std::size_t(((mx * x + mz * z) % n + n) % n)];
          const double wave = double(f.x) * w.real() - double(f.y) * w.imag();
          whole += wave;
          if (std::max(std::abs(mx), std::abs(mz)) < band / 2) own += wave;
        }
      const std::size_t at = std::size_t(z) * std::size_t(stride) + std::size_t(x);
      const double got = half_storage ? double(glm::unpackHalf1x16(halves_[at])) : double(field_re.data()[at]);
      miss += std::pow(got - whole, 2), miss_own += std::pow(got - own, 2);
      size += whole * whole, size_own += own * own;
    }
    return {{std::sqrt(miss / size), "relative L2 to all waves of the tile"},
            {std::sqrt(miss_own / size_own), "relative L2 by rounding"}};
  }
  // Of a wave: its height's amplitude, or its slope's along x.
  glm::vec2 value(const WaveBins& bins, int mx, int mz) const {
    const glm::vec2 a = bins.at(cascade, mx, mz).amplitude;
    const float k = float(2.0 * pi / bins.ladder[std::size_t(cascade)].side_m * mx);
    return slopes ? glm::vec2(-k * a.y, k * a.x) : a;
  }
  int cascade, n, band, stride = 0;
  bool slopes, half_storage;
  FftPlan plan;
  std::vector<float> re, im;
  Floats field_re, field_im, workspace;
  std::vector<std::uint16_t> halves_;
};

std::vector<LabTask> transform_tasks(double wind_mps, const LabOptions& options) {
  const auto bins =
      std::make_shared<const WaveBins>(make_wave_bins(lab_sea(wind_mps, options), WaveQuality{256, 5, false}));
  const int cascade = highest_cascade(*bins), full = bins_of(cascade);
  std::vector<LabTask> tasks;
  for (const bool slopes : {false, true})
    for (const bool halves : {false, true})
      for (int n = full / 4; n <= 4 * full; n *= 2) {
        const auto work = std::make_shared<Transformed>(*bins, cascade, n, slopes, halves);
        tasks.push_back({std::string(slopes ? "slope, " : "height, ") + (halves ? "16-bit storage" : "32-bit"),
                         double(n), [=] { work->run(); }, 1.0, [=] { return work->errors(*bins, options.seed); }, "",
                         ""});
      }
  return tasks;
}

// ---- cascades

// Variance of the heights of the whole spectrum, by Simpson's rule over ln k.
double height_variance(const SeaState& sea) {
  const Spectrum spectrum(sea);
  constexpr int steps = 20'000;
  const double from = std::log(1e-4), step = (std::log(3e3) - from) / steps;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double k = std::exp(from + step * i), weight = i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    for (int c = 0; c < Spectrum::components; ++c)
      if (spectrum.present(c)) sum += weight * spectrum.radial(c, k) * k * k;
  }
  return sum * step / 3.0;
}

std::vector<LabTask> cascades_tasks(double wind_mps, const LabOptions& options) {
  struct Drawn {
    Drawn(const SeaState& sea, int cascades) : field(sea, WaveQuality{256, cascades, false}) {}
    WaveField field;
    WaveTiles tiles;
  };
  const SeaState sea = lab_sea(wind_mps, options);
  const double whole = height_variance(sea);
  std::vector<LabTask> tasks;
  for (int cascades = 1; cascades <= 5; ++cascades) {
    const auto drawn = std::make_shared<Drawn>(sea, cascades);
    const auto errors = [=]() -> std::vector<LabError> {
      const SeaStatistics& s = drawn->field.statistics();
      const double slopes = s.slope_moments.x + s.slope_moments.y,
                   tail = s.tail_slope_moments.x + s.tail_slope_moments.y;
      // What is shorter than all cascades is shaded, not drawn: the share of slopes that no picture shows as waves.
      return {
          {tail / (slopes + tail), "of the slope variance, not drawn"},
          {std::abs(1.0 - s.height_variance / whole), "of the height variance"},
          {drawn->field.bins().ladder[std::size_t(cascades - 1)].side_m, "m, after which the shortest tile repeats"}};
    };
    tasks.push_back({"waves.cascades", double(cascades),
                     [=] { drawn->field.evaluate(ticks_from_seconds(10.0), drawn->tiles); }, 1.0, errors,
                     presets_with({{"waves.cascades", std::to_string(cascades)}}),
                     "waves.cascades=" + std::to_string(cascades)});
  }
  return tasks;
}

}  // namespace

std::vector<LabCurve> sea_curves() {
  return {
      {"query",
       "Steps of a height query",
       "one point",
       {{"plain loop, fixed point", true, 0.0, 0.15, 1.0, 6.0,
         "at most the contraction of the sea's displacement where it is asked, Banach (1922)", "",
         "of Hs, rms, as the contraction has it"}},
       true,
       false,
       query_tasks},
      {"transform",
       "Precision of the inverse transform",
       "one transform",
       {{"height, 32-bit", false, 0.1, 0.15, 16.0, 1024.0,
         "rounding grows as the root of log2 n (Schatzman 1996), slower than any power", "relative L2 by rounding"},
        {"height, 16-bit storage", false, 0.0, 0.12, 16.0, 1024.0, "11 bits are the same at every size",
         "relative L2 by rounding"}},
       true,
       false,
       transform_tasks},
      {"cascades", "Cascades of waves", "one evaluation of all tiles", {}, true, false, cascades_tasks},
  };
}

}  // namespace seascape
