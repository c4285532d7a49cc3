// The curves of a hull's wake: into how many sections it is cut, and how large and fine its windows of waves are.
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "app/lab/lab.h"
#include "ocean/bodies/hull_wake.h"
#include "ocean/places/wake_windows.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;

// Of parabolas along and across (Wigley 1942), 10 m long, 1 m wide and 0.625 m deep.
HullMesh parabolic_hull() {
  constexpr int along = 64, down = 12;
  HullMesh soup;
  const auto point = [&](int i, int j, double side) {
    const double z = 2.0 * i / along - 1.0, y = j <= down ? 1.0 - double(j) / down : 0.0;
    return glm::dvec3(side * 0.5 * (1.0 - z * z) * (1.0 - y * y), j <= down ? -0.625 * y : 0.4, 5.0 * z);
  };
  const auto quad = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const auto n = std::uint32_t(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), {a, b, c, d});
    soup.triangles.push_back({n, n + 1, n + 2});
    soup.triangles.push_back({n, n + 2, n + 3});
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j <= down; ++j) {
      quad(point(i, j, 1.0), point(i, j + 1, 1.0), point(i + 1, j + 1, 1.0), point(i + 1, j, 1.0));
      quad(point(i + 1, j, -1.0), point(i + 1, j + 1, -1.0), point(i, j + 1, -1.0), point(i, j, -1.0));
    }
    quad(point(i, down + 1, 1.0), point(i, down + 1, -1.0), point(i + 1, down + 1, -1.0), point(i + 1, down + 1, 1.0));
  }
  return welded(soup);
}

// The hull under way, and the waves that its sources send, in every direction that stands still behind it.
struct Sent {
  explicit Sent(int sections) : wake(parabolic_hull(), sections), cut(std::size_t(wake.sections())) {
    motion.velocity.linear = {0.0, 0.0, -speed};
  }
  void run() {
    sources.clear();
    wake.cut(
        motion, [](const glm::dvec2&) { return 0.0; }, cut);
    wake.add_sources(motion, cut, 1.0, sources);
  }
  std::vector<std::complex<double>> waves() const {
    std::vector<std::complex<double>> all;
    for (int i = 0; i < 90; ++i) {
      const double theta = (i + 0.5) / 90.0 * 0.4 * pi, c = std::cos(theta), k = 9.81 / (speed * speed * c * c);
      std::complex<double> sum = 0.0;
      for (const WaveSource& s : sources)
        sum += s.rise_mps * s.length_m * s.length_m / pi *
               std::polar(std::exp(-k * s.depth_m - std::pow(k * s.length_m / (2.0 * pi), 2)),
                          k * (c * s.place_m.y + std::sin(theta) * s.place_m.x));
      all.push_back(sum * std::pow(c, -1.5));
    }
    return all;
  }
  static constexpr double speed = 4.0;
  HullWake wake;
  HullMotion motion;
  std::vector<HullSection> cut;
  std::vector<WaveSource> sources;
};

std::vector<LabTask> wake_tasks(double, const LabOptions&) {
  Sent finest(64);
  finest.run();
  const auto truth = std::make_shared<const std::vector<std::complex<double>>>(finest.waves());
  std::vector<LabTask> tasks;
  for (const int sections : {6, 8, 10, 12, 14, 16, 20, 24}) {
    const auto sent = std::make_shared<Sent>(sections);
    sent->run();
    const auto missed = [=]() -> std::vector<LabError> {
      const std::vector<std::complex<double>> waves = sent->waves();
      double miss = 0.0, size = 0.0;
      for (std::size_t i = 0; i < waves.size(); ++i)
        miss += std::norm(waves[i] - (*truth)[i]), size += std::norm((*truth)[i]);
      return {{std::sqrt(miss / size), "of the waves that the hull sends, rms"}};
    };
    tasks.push_back({"sections of a hull", double(sections), [=] { sent->run(); }, 1.0, missed, "", ""});
  }
  return tasks;
}

// The wave part of the steady surface behind sources that go along -z at a speed on deep water (m, Havelock 1923): with
// S the sources' transform, h = 1 / (pi U) times the real part of the integral over all directions theta of k / cos
// theta S exp(i k (x cos theta + y sin theta)), k = g / (U cos theta)^2, x behind and y to the right.
class SteadyWake {
 public:
  SteadyWake(std::span<const WaveSource> sources, double speed, double gravity) {
    for (int i = 0; i < pieces; ++i) {
      const double t = (2.0 * (i + 0.5) / pieces - 1.0) * steepest, c = 1.0 / std::sqrt(1.0 + t * t),
                   k = gravity / (speed * speed * c * c), kx = k * c, ky = k * c * t;
      std::complex<double> sum = 0.0;
      for (const WaveSource& s : sources)
        sum += s.rise_mps * s.length_m * s.length_m / pi *
               std::polar(std::exp(-k * s.depth_m - std::pow(k * s.length_m / (2.0 * pi), 2)),
                          kx * s.place_m.y - ky * s.place_m.x);
      // dt = d theta / cos^2 theta
      waves_.push_back({-kx, ky, sum * (k * c * 2.0 * steepest / pieces / (pi * speed))});
    }
  }
  double height(const glm::dvec2& behind_right) const {
    double sum = 0.0;
    for (const Wave& w : waves_)
      sum += (w.amplitude * std::polar(1.0, w.kx * behind_right.x + w.ky * behind_right.y)).real();
    return sum;
  }

 private:
  static constexpr int pieces = 6000;
  static constexpr double steepest = 7.0;  // tan theta: of waves 0.2 m long, which no source here sends
  struct Wave {
    double kx, ky;
    std::complex<double> amplitude;
  };
  std::vector<Wave> waves_;
};

// The hull's windows of waves, which nothing damps, after the hull's way: as wide and fine as the settings say.
class Towed {
 public:
  explicit Towed(const LodWindowSettings& windows) : windows_(settings(windows)), wake_(parabolic_hull()) {
    cut_.resize(std::size_t(wake_.sections()));
    motion_.velocity.linear = {0.0, 0.0, -Sent::speed};
    least_length_m_ = 8.0 * windows.texel_m;
    while (gone_m_ < way_m) step();
  }
  void step() {
    constexpr double dt_s = 1.0 / 60.0;
    gone_m_ += Sent::speed * dt_s;
    motion_.pose.centre_m = {0.0, 0.0, -gone_m_};
    sources_.clear();
    wake_.cut(
        motion_, [](const glm::dvec2&) { return 0.0; }, cut_);
    wake_.add_sources(motion_, cut_, least_length_m_, sources_);
    windows_.add({.id = 1, .place_m = {0.0, -gone_m_}, .velocity_mps = {0.0, -Sent::speed}, .length_m = 10.0},
                 sources_);
    windows_.step(dt_s);
  }
  double height(const glm::dvec2& behind_right) {
    return windows_.shared_surface()->sea({behind_right.y, behind_right.x - gone_m_}, 0.0).displacement.y;
  }
  void make_surface() { windows_.shared_surface(); }

 private:
  static WakeSettings settings(const LodWindowSettings& windows) {
    WakeSettings s;
    s.waves.windows = windows;
    s.waves.damping_per_s = 0.0;
    return s;
  }
  static constexpr double way_m = 110.0;
  WakeWindows windows_;
  HullWake wake_;
  HullMotion motion_;
  std::vector<HullSection> cut_;
  std::vector<WaveSource> sources_;
  double least_length_m_ = 0.0, gone_m_ = 0.0;
};

std::vector<LabTask> window_tasks(double, const LabOptions& options) {
  Sent hull(20);
  hull.sources.clear();
  hull.wake.cut(
      hull.motion, [](const glm::dvec2&) { return 0.0; }, hull.cut);
  hull.wake.add_sources(hull.motion, hull.cut, 0.0, hull.sources);
  const SteadyWake steady(hull.sources, Sent::speed, 9.81);
  // Within Kelvin's wedge, near behind the hull and farther.
  struct Seen {
    glm::dvec2 at;
    double height;
  };
  const auto seen = std::make_shared<std::array<std::vector<Seen>, 2>>();
  for (double x = 10.0; x < 50.0; x += 0.9)
    for (double y = 0.0; y < 0.36 * (x + 5.0); y += 0.7)
      (*seen)[x < 20.0 ? 0 : 1].push_back({{x, y}, steady.height({x, y})});
  std::vector<LabTask> tasks;
  const auto add = [&](const char* knob, double value, int resolution, double texel_m) {
    const auto towed =
        std::make_shared<Towed>(LodWindowSettings{.resolution = resolution, .slices = 3, .texel_m = texel_m});
    const auto missed = [=]() -> std::vector<LabError> {
      std::vector<LabError> errors;
      for (std::size_t part = 0; part < 2; ++part) {
        double miss = 0.0, size = 0.0;
        for (const Seen& one : (*seen)[part]) {
          const double off = towed->height(one.at) - one.height;
          miss += off * off, size += one.height * one.height;
        }
        LabError& error = errors.emplace_back();
        error.value = std::sqrt(miss / size);
        error.unit = part == 0 ? "of the waves 10 to 20 m behind, rms" : "of the waves 20 to 50 m behind, rms";
      }
      return errors;
    };
    tasks.push_back({knob, value, [=] { towed->step(), towed->make_surface(); }, 1.0, missed, "",
                     "wakes.resolution=" + std::to_string(resolution) + " wakes.texel_m=" + std::to_string(texel_m)});
  };
  for (const int resolution : {64, 128}) add("texels a side, 0.25 m each", resolution, resolution, 0.25);
  for (const double texel_m : {1.0, 0.5, 0.35, 0.18})
    add("texels of so many metres, 128 a side", texel_m, 128, texel_m);
  add("texels of so many metres, windows as wide", 0.5, 64, 0.5);
  if (!options.quick) {
    add("texels a side, 0.25 m each", 256, 256, 0.25);
    add("texels of so many metres, windows as wide", 0.125, 256, 0.125);
  }
  return tasks;
}

}  // namespace

std::vector<LabCurve> wake_curves() {
  return {{"wakes",
           "Sections of a hull that makes waves",
           "one hull's sources",
           {{"sections of a hull", false, -2.0, 0.25, 10.0, 24.0,
             "the area between two sections by what it is in the middle is of second order"}},
           false,
           false,
           wake_tasks},
          {"wake_windows",
           "Windows of waves of a hull under way",
           "a step of one hull's windows and their surface",
           {},
           false,
           false,
           window_tasks}};
}

}  // namespace seascape
