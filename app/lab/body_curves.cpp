// Curves of what floats: forces on a hull over its triangles and its water's samples, and motion over steps and levels.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "app/lab/lab.h"
#include "ocean/bodies/bodies.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi, g = 9.81, rho = 1025.0;

// A fully developed sea of Pierson and Moskowitz (1964) as 24 waves of Airy, longer than a hull's grid has room for.
class LabWater : public BodyWater {
 public:
  LabWater(double wind_mps, std::uint32_t seed) {
    const double peak = 0.877 * g / (1.026 * wind_mps);  // of the wind at 10 m, for theirs at 19.5 m
    constexpr int count = 24;
    for (int n = 0; n < count; ++n) {
      const double from = peak * std::pow(4.0, double(n) / count - 0.35),
                   to = peak * std::pow(4.0, double(n + 1) / count - 0.35), w = std::sqrt(from * to);
      const double s = 0.0081 * g * g * std::pow(w, -5.0) * std::exp(-1.25 * std::pow(peak / w, 4.0));
      const double turn = 0.9 * std::sin(2.4 * n + seed);
      waves_.push_back({std::sqrt(2.0 * s * (to - from)), w, {std::sin(turn), std::cos(turn)}, 5.1 * n + seed});
    }
  }
  void ask(double t, double, std::span<const glm::dvec2> places, std::span<WaterHere> answers) const override {
    for (std::size_t n = 0; n < places.size(); ++n) {
      WaterHere& a = answers[n] = {};
      for (const Wave& wave : waves_) {
        const double phase = wave.w * wave.w / g * glm::dot(wave.towards, places[n]) - wave.w * t + wave.phase;
        const double c = wave.height_m * std::cos(phase);
        a.height_m += c;
        a.velocity_mps += wave.w * glm::dvec3(c * wave.towards.x, wave.height_m * std::sin(phase), c * wave.towards.y);
      }
    }
  }
  double wave_number() const override {
    double energy = 0.0, sum = 0.0;
    for (const Wave& wave : waves_)
      energy += wave.height_m * wave.height_m, sum += wave.height_m * wave.height_m * wave.w * wave.w / g;
    return sum / energy;
  }
  std::optional<CalmWater> calm(double, const glm::dvec2&, double) const override { return std::nullopt; }

 private:
  struct Wave {
    double height_m, w;
    glm::dvec2 towards;
    double phase;
  };
  std::vector<Wave> waves_;
};

// As round as a hull is where meshes miss it most: an ellipsoid of 1.4 x 1.0 x 4 m.
HullMesh egg(int parts) {
  HullMesh mesh = sphere_hull(1.0, parts);
  for (glm::dvec3& v : mesh.vertices) v *= glm::dvec3(0.7, 0.5, 2.0);
  return mesh;
}
constexpr double egg_m3 = 4.0 / 3.0 * pi * 0.7 * 0.5 * 2.0;

// ---- buoyancy

// The pressure on the hull at sixteen moments and headings, heeled and trimmed, half in the water.
struct Pressed {
  Pressed(double wind_mps, const LabOptions& options, int parts, int water_samples, bool of_columns)
      : water(wind_mps, options.seed), samples(water_samples), columns(of_columns), clip(egg(parts)) {
    probes = columns_of(clip.mesh(), float_upright(clip.mesh(), 0.5 * rho * egg_m3, media));
  }
  void run() {
    HullDrag none;
    none.friction = false, none.form = none.suction = none.wind = 0.0;
    results.clear();
    for (int n = 0; n < moments; ++n) {
      const double turn = 0.4 * n;
      BodyPose pose{{3.0 * n, 0.0, -2.0 * n},
                    glm::mat3_cast(glm::angleAxis(turn, glm::dvec3(0.0, 1.0, 0.0)) *
                                   glm::angleAxis(0.1 * std::sin(2.0 * n), glm::dvec3(0, 0, 1)))};
      WaterHere here;
      const glm::dvec2 place(pose.centre_m.x, pose.centre_m.z);
      water.ask(n, 0.0, {&place, 1}, {&here, 1});
      pose.centre_m.y = here.height_m;
      patch.ask(water, n, {place, {pose.to_world[2].x, pose.to_world[2].z}, {2.6, 1.3}, 1.0}, samples);
      results.push_back(columns ? probe_forces(probes, pose, {}, patch, media, none).pressure
                                : clip.forces(pose, {}, patch, media, none, 4.0).pressure);
    }
  }
  static constexpr int moments = 16;
  LabWater water;
  int samples;
  bool columns;
  HullMedia media;
  ProbeColumns probes;
  HullClip clip;
  WaterPatch patch;
  std::vector<Vector6> results;
};

std::vector<LabTask> buoyancy_tasks(double wind_mps, const LabOptions& options) {
  constexpr int fine_samples = 64;
  const int fine = options.quick ? 96 : 192;
  const auto truth = std::make_shared<Pressed>(wind_mps, options, fine, fine_samples, false);
  truth->run();
  const auto shaped = std::make_shared<Pressed>(wind_mps, options, 24, fine_samples, false);
  shaped->run();
  std::vector<LabTask> tasks;
  const auto add = [&](const std::string& knob, double value, std::shared_ptr<Pressed> of,
                       const std::shared_ptr<Pressed>& against, const std::string& preset) {
    const auto errors = [=]() -> std::vector<LabError> {
      double force = 0.0, moment = 0.0;
      for (std::size_t n = 0; n < of->results.size(); ++n) {
        const Vector6 miss = of->results[n] - against->results[n];
        force += glm::dot(miss.linear, miss.linear), moment += glm::dot(miss.angular, miss.angular);
      }
      const double weight = 0.5 * rho * g * egg_m3, count = double(of->results.size());
      return {{std::sqrt(force / count) / weight, "of the weight, rms of the force"},
              {std::sqrt(moment / count) / weight, "m of lever, rms of the moment"}};
    };
    tasks.push_back({knob, value, [=] { of->run(); }, double(Pressed::moments), errors, preset, ""});
  };
  for (const int parts : {8, 12, 16, 24, 32, 48})
    add("parts of the hull's turn, clipped", parts,
        std::make_shared<Pressed>(wind_mps, options, parts, fine_samples, false), truth, "");
  for (const int samples : {6, 8, 12, 16, 24, 32})
    add("samples of the water along the hull", samples,
        std::make_shared<Pressed>(wind_mps, options, 24, samples, false), shaped,
        samples == 16 ? "low medium high ultra" : "");
  add("four columns, six samples", 4.0, std::make_shared<Pressed>(wind_mps, options, 24, 6, true), truth, "");
  return tasks;
}

// ---- steps

// How a hull moves for some seconds, by its height at fifteen moments a second.
struct Moved {
  Moved(double wind_mps, const LabOptions& options, double rate_hz, BodyLevel of_level)
      : water(wind_mps, options.seed), rate(rate_hz), seconds(options.quick ? 4.0 : 10.0) {
    const auto mesh = std::make_shared<HullMesh>(egg(12));
    const HullVolume volume = volume_of(*mesh);
    spec.name = "egg", spec.hull = mesh, spec.level = of_level;
    const double m = 0.5 * rho * volume.volume_m3;
    spec.mass = {m, 0.5 * rho * volume.inertia_m5, {}};
    spec.mass_centre_m.y = -0.1;
    spec.mass.added = Matrix6::diagonal({0.4 * m, 0.9 * m, 0.1 * m, 0.3 * m, 0.3 * m, 0.05 * m});
    spec.damping = Matrix6::diagonal({0.2 * m, 1.5 * m, 0.1 * m, m, m, 0.2 * m});
    const glm::dvec2 place(0.0);
    WaterHere here;
    water.ask(0.0, 0.0, {&place, 1}, {&here, 1});
    spec.at_m.y = here.height_m, spec.velocity_mps.y = here.velocity_mps.y;
  }
  void run() {
    BodySettings settings;
    settings.rate_hz = rate;
    Bodies bodies(settings, {spec});
    heights.clear();
    const int steps = int(std::lround(rate * seconds)), each = int(std::lround(rate / 15.0));
    for (int n = 1; n <= steps; ++n) {
      bodies.step(n / rate, 1.0 / rate, water);
      if (n % each == 0) heights.push_back(bodies.result()[0].motion.centre_m.y);
    }
  }
  LabWater water;
  BodySpec spec;
  double rate, seconds;
  std::vector<double> heights;
};

std::vector<LabTask> step_tasks(double wind_mps, const LabOptions& options) {
  const auto truth = std::make_shared<Moved>(wind_mps, options, options.quick ? 960.0 : 1920.0, BodyLevel::hull);
  truth->run();
  std::vector<LabTask> tasks;
  const auto add = [&](const std::string& knob, double value, double rate, BodyLevel level, const std::string& preset) {
    const auto moved = std::make_shared<Moved>(wind_mps, options, rate, level);
    const auto errors = [=]() -> std::vector<LabError> {
      double sum = 0.0, worst = 0.0;
      for (std::size_t n = 0; n < moved->heights.size(); ++n) {
        const double miss = std::abs(moved->heights[n] - truth->heights[n]);
        sum += miss * miss / double(moved->heights.size()), worst = std::max(worst, miss);
      }
      return {{std::sqrt(sum), "m of height, rms"}, {worst, "m of height, worst"}};
    };
    tasks.push_back({knob, value, [=] { moved->run(); }, moved->seconds, errors, preset, ""});
  };
  for (const double rate : {15.0, 30.0, 60.0, 120.0, 240.0})
    add("steps a second, clipped hull", rate, rate, BodyLevel::hull, rate == 60.0 ? "low medium high ultra" : "");
  add("level of 60 steps a second: 1 probes, 2 follow", 1.0, 60.0, BodyLevel::probes, "");
  add("level of 60 steps a second: 1 probes, 2 follow", 2.0, 60.0, BodyLevel::follow, "");
  return tasks;
}

}  // namespace

std::vector<LabCurve> body_curves() {
  return {
      {"buoyancy",
       "Forces on a hull",
       "one hull's forces",
       {{"parts of the hull's turn", false, -2.0, 0.25, 8.0, 48.0,
         "flat triangles in a round hull miss its volume by second order"}},
       true,
       false,
       buoyancy_tasks},
      {"body_steps",
       "Steps of a body",
       "a second of one body",
       {{"steps a second", false, -1.0, 0.3, 30.0, 240.0,
         "what damps is taken at a step's end, which is of first order (Euler)"}},
       true,
       false,
       step_tasks},
  };
}

}  // namespace seascape
