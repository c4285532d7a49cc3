// The curve of a hull's wake: into how many sections it is cut.
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <vector>

#include "app/lab/lab.h"
#include "ocean/bodies/hull_wake.h"

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

}  // namespace

std::vector<LabCurve> wake_curves() {
  return {{"wakes",
           "Sections of a hull that makes waves",
           "one hull's sources",
           {{"sections of a hull", false, -2.0, 0.25, 10.0, 24.0,
             "the area between two sections by what it is in the middle is of second order"}},
           false,
           false,
           wake_tasks}};
}

}  // namespace seascape
