// Curves of what is local: dynamic waves, windows of data; and Fresnel's reflection.
#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <optional>
#include <random>

#include "app/lab/lab.h"
#include "ocean/places/dynamic_waves.h"
#include "ocean/places/lod_field.h"
#include "ocean/waves/spectrum.h"
#include "shaders/shared/fresnel.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;

// ---- dynamic waves

// A pressure that comes, runs in a circle and goes over still water, as large and as fast as the waves of the sea are,
// at a rate of steps. It comes and goes smoothly: where a push begins and ends is told no better than to a step.
struct Pushed {
  Pushed(double wind_mps, double rate_hz, bool quick) : wind(wind_mps), rate(rate_hz) {
    settings.windows = {.resolution = quick ? 64 : 128, .slices = 2, .texel_m = 0.05 * wind};
    settings.damping_per_s = 0.0;
    settings.idle_m = 0.0;
    settings.rate_hz = rate_hz;
    settings.most_steps = 1000;
  }
  glm::dvec2 place(double s) const { return 0.3 * wind * glm::dvec2(std::cos(s / period()), std::sin(s / period())); }
  double period() const { return 0.3 * std::sqrt(wind); }
  double seconds() const { return 0.2 * std::round(10.0 * period()); }  // whole steps of every rate
  WaveSource source(double s) const {
    const double before = s - 1.0 / rate;
    return {place(s), (place(s) - place(before)) * rate, 0.6 * wind,
            0.05 * std::pow(std::sin(pi * 0.5 * (s + before) / seconds()), 2), 0.0};
  }
  int steps() const { return int(std::lround(seconds() * rate)); }
  // As the effect has it: two levels, and a border that absorbs after each step.
  void run() {
    DynamicWaves waves(settings);
    const LodPlacement here = lod_placement(settings.windows, glm::dvec2(0.0), {});
    for (int i = 1; i <= steps(); ++i) {
      const WaveSource now = source(i / rate);
      waves.advance(1.0 / rate, here, std::span(&now, 1));
    }
    result.clear();
    for (int level = 0; level < waves.levels(); ++level)
      result.insert(result.end(), waves.level(level).modes().begin(), waves.level(level).modes().end());
  }
  // One level by itself, on a sea that has no border.
  void run_alone() {
    WaveLevel level(settings.windows.resolution);
    level.shape(settings.windows.texel_m, true, 9.81, 1e6);
    const LodIndex first = lod_placement(settings.windows, glm::dvec2(0.0), {}).first[0];
    for (int i = 1; i <= steps(); ++i) {
      const WaveSource now = source(i / rate);
      level.turn(1.0 / rate, 0.0, first, std::span(&now, 1));
    }
    result.assign(level.modes().begin(), level.modes().end());
  }
  double wind, rate;
  DynamicWavesSettings settings;
  std::vector<std::complex<double>> result;
};

// Waves of the sea's own lengths left to themselves for ten seconds: their phase against w = sqrt(g k), and their
// energy.
struct Free {
  static constexpr int least = 5;  // waves a window: longer ones the level does not carry
  Free(double wind_mps, double rate_hz) : wind(wind_mps), rate(rate_hz) {}
  void run() {
    WaveLevel level(64);
    level.shape(0.05 * wind, true, 9.81, 1e6);
    const int band = level.samples() / 4;
    for (int m = least; m < band / 2; ++m) level.modes()[std::size_t((band / 2) * band + band / 2 + m)] = 0.1;
    const double before = level.energy_m2();
    for (int i = 0; i < int(std::lround(10.0 * rate)); ++i) level.turn(1.0 / rate, 0.0, {0, 0}, {});
    drift = std::abs(level.energy_m2() / before - 1.0);
    phase = 0.0;
    for (int m = least; m < band / 2; ++m) {
      const double w = std::sqrt(9.81 * 2.0 * pi * m / (64 * 0.05 * wind)),
                   turned = std::arg(level.modes()[std::size_t((band / 2) * band + band / 2 + m)]);
      phase = std::max(phase, std::abs(std::remainder(turned + 10.0 * w, 2.0 * pi)));
    }
  }
  double wind, rate, phase = 0.0, drift = 0.0;
};

std::vector<LabTask> dynamic_tasks(double wind_mps, const LabOptions& options) {
  std::vector<LabTask> tasks;
  const double finest = options.quick ? 480.0 : 960.0;
  for (const bool alone : {false, true}) {
    const auto truth = std::make_shared<Pushed>(wind_mps, finest, options.quick);
    alone ? truth->run_alone() : truth->run();
    for (const double rate : {10.0, 15.0, 30.0, 60.0, 120.0}) {
      const auto pushed = std::make_shared<Pushed>(wind_mps, rate, options.quick);
      const auto missed = [=]() -> std::vector<LabError> {
        double miss = 0.0, size = 0.0;
        for (std::size_t i = 0; i < truth->result.size(); ++i)
          miss += std::norm(pushed->result[i] - truth->result[i]), size += std::norm(truth->result[i]);
        return {{std::sqrt(miss / size), alone ? "of one level's waves, without a border, rms" : "of the waves, rms"}};
      };
      tasks.push_back({alone ? "rate in Hz, one level without a border" : "dynamic_waves.rate_hz", rate,
                       [=] { alone ? pushed->run_alone() : pushed->run(); }, pushed->seconds(), missed,
                       !alone && rate == 60.0 ? "low medium high ultra" : "",
                       alone ? "" : "dynamic_waves.rate_hz=" + std::to_string(int(rate))});
    }
  }
  for (const double rate : {10.0, 15.0, 30.0, 60.0, 120.0}) {
    const auto freely = std::make_shared<Free>(wind_mps, rate);
    // What double leaves of nothing is held above 1e-16, below which it says nothing.
    tasks.push_back({"rate in Hz, waves left to themselves", rate, [=] { freely->run(); }, 10.0,
                     [=] {
                       return std::vector<LabError>{{std::max(freely->phase, 1e-16), "rad of phase after 10 s, worst"},
                                                    {std::max(freely->drift, 1e-16), "of the energy after 10 s"}};
                     },
                     "", ""});
  }
  return tasks;
}

// ---- windows of local data

// A hump of the bed 8 wind lengths wide: as smooth data of places are.
double hump(double wind_mps, glm::dvec2 place) {
  return 5.0 * std::exp(-glm::dot(place, place) / (2.0 * std::pow(0.8 * wind_mps, 2)));
}

std::vector<LabTask> texel_tasks(double wind_mps, const LabOptions& options) {
  struct Window {
    Window(double wind_mps, double texel) : wind(wind_mps), settings{.resolution = 256, .slices = 2, .texel_m = texel} {
      run();
    }
    void run() {  // as place_fields fills a window that the viewer enters
      const LodPlacement here = lod_placement(settings, glm::dvec2(0.0), {});
      field.emplace(settings, 0.0f, lod_placement(settings, glm::dvec2(1e5), {}));
      field->follow(here, [this](glm::dvec2 middle, double, float) { return float(hump(wind, middle)); });
    }
    double wind;
    LodWindowSettings settings;
    std::optional<LodField<float>> field;
  };
  std::vector<LabTask> tasks;
  for (const double share : {0.01, 0.02, 0.04, 0.08, 0.16}) {
    const double texel = share * wind_mps;
    const auto window = std::make_shared<Window>(wind_mps, texel);
    const auto missed = [=]() -> std::vector<LabError> {
      std::mt19937 random(options.seed);
      std::uniform_real_distribution<double> within(-1.0, 1.0);
      double sum = 0.0, worst = 0.0;
      constexpr int count = 4000;
      for (int i = 0; i < count; ++i) {
        const glm::dvec2 place = wind_mps * glm::dvec2(within(random), within(random));
        const double miss = std::abs(double(window->field->bilinear(0, place)) - hump(wind_mps, place));
        sum += miss * miss / count, worst = std::max(worst, miss);
      }
      // A window covers resolution^2 texels: finer ones cost what they take per square metre.
      return {{std::sqrt(sum), "m of a hump of 5 m, rms"}, {worst, "m of a hump of 5 m, worst"}};
    };
    const double area = std::pow(256.0 * texel, 2) * (1.0 + 4.0) / std::pow(wind_mps, 2);
    tasks.push_back(
        {"texel over the distance the wind goes in a second", share, [=] { window->run(); }, area, missed, "", ""});
  }
  return tasks;
}

// ---- Fresnel's reflection

constexpr double water = 1.333;

double exact(double cosine) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / water, inside = std::sqrt(1.0 - sine * sine);
  const double s = (cosine - water * inside) / (cosine + water * inside),
               p = (water * cosine - inside) / (water * cosine + inside);
  return 0.5 * (s * s + p * p);
}

constexpr double head_on = (water - 1.0) * (water - 1.0) / ((water + 1.0) * (water + 1.0));

// Facets of the sea as an eye 1.7 m above it sees them: rows of a picture from 0.05 to 40 degrees below the horizon,
// slopes of the sea's variance.
std::vector<float> cosines_seen(double wind_mps, const LabOptions& options) {
  const glm::dvec3 slopes = slope_moments(lab_sea(wind_mps, options));
  const double deviation = std::sqrt(0.5 * (slopes.x + slopes.y));
  std::mt19937 random(options.seed);
  std::normal_distribution<double> slope(0.0, deviation);
  std::uniform_real_distribution<double> below(0.05, 40.0);
  std::vector<float> cosines;
  while (cosines.size() < 8192) {
    const double angle = below(random) * pi / 180.0;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(slope(random), 1.0, slope(random)));
    const double cosine = glm::dot(normal, glm::dvec3(std::cos(angle), std::sin(angle), 0.0));
    if (cosine > 0.0) cosines.push_back(float(cosine));  // others face away
  }
  return cosines;
}

template <class Reflect>
LabTask reflection(const std::string& knob, double value, const std::shared_ptr<const std::vector<float>>& cosines,
                   const Reflect& reflect) {
  const auto got = std::make_shared<std::vector<float>>(cosines->size());
  const auto errors = [=]() -> std::vector<LabError> {
    double sum = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < got->size(); ++i) {
      const double miss = std::abs(double((*got)[i]) - exact(double((*cosines)[i])));
      sum += miss * miss / double(got->size()), worst = std::max(worst, miss);
    }
    return {{std::sqrt(sum), "of the reflectance, rms over facets seen"},
            {worst, "of the reflectance, worst of facets seen"}};
  };
  const auto run = [=] {
    for (std::size_t i = 0; i < got->size(); ++i) (*got)[i] = reflect((*cosines)[i]);
  };
  return {knob, value, run, double(cosines->size()), errors, "", ""};
}

std::vector<LabTask> fresnel_tasks(double wind_mps, const LabOptions& options) {
  const auto cosines = std::make_shared<const std::vector<float>>(cosines_seen(wind_mps, options));
  std::vector<LabTask> tasks;
  tasks.push_back(reflection("exact, as shaders have it", 1.0, cosines, [](float c) { return gpu::fresnel(c); }));
  tasks.back().preset = "low medium high ultra";
  tasks.push_back(reflection("Schlick (1994)", 1.0, cosines, [](float c) {
    const float m = 1.0f - c, square = m * m;
    return float(head_on) + float(1.0 - head_on) * square * square * m;
  }));
  for (const int entries : {4, 8, 16, 32, 64, 128}) {
    std::vector<float> table;
    for (int i = 0; i <= entries; ++i) table.push_back(float(exact(double(i) / entries)));
    tasks.push_back(
        reflection("entries of a table over the cosine", double(entries), cosines, [table, entries](float c) {
          const float at = c * float(entries);
          const int i = std::min(int(at), entries - 1);
          return table[std::size_t(i)] + (at - float(i)) * (table[std::size_t(i) + 1] - table[std::size_t(i)]);
        }));
  }
  return tasks;
}

}  // namespace

std::vector<LabCurve> local_curves() {
  return {
      {"dynamic",
       "Rate of dynamic waves",
       "a second of the sea",
       {{"rate in Hz, one level", false, -2.0, 0.2, 15.0, 120.0,
         "a push that lasts for a step and stands at its middle is of second order; the border, taken after each step, "
         "is of first",
         "of one level's waves, without a border, rms"}},
       true,
       false,
       dynamic_tasks},
      {"texel",
       "Texels of local data",
       "the same area",
       {{"texel over", false, 2.0, 0.15, 0.01, 0.08,
         "straight lines between texels are of second order (lod_field.h)"}},
       true,
       false,
       texel_tasks},
      {"fresnel",
       "Fresnel's reflection",
       "one facet",
       {{"entries of a table", false, -2.0, 0.35, 8.0, 128.0, "straight lines between entries are of second order"}},
       true,
       false,
       fresnel_tasks},
  };
}

}  // namespace seascape
