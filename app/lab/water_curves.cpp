// Curves of light in the water: what a line of sight scatters to the eye, of the sun's light and of the dive light's.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "app/lab/lab.h"
#include "ocean/surface/water_types.h"
#include "shaders/shared/lamp_light.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;

// Nodes and shares of Gauss and Legendre's rule for -1 to 1, by Newton's steps from Tricomi's first guess.
struct Rule {
  explicit Rule(int count) {
    for (int i = 0; i < count; ++i) {
      double x = std::cos(pi * (i + 0.75) / (count + 0.5)), slope = 1.0;
      for (int step = 0; step < 8; ++step) {
        double before = 1.0, now = x;  // Legendre's polynomials of degrees k - 1 and k
        for (int k = 2; k <= count; ++k) {
          const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
          before = now, now = next;
        }
        slope = count * (x * now - before) / (x * x - 1.0);
        x -= now / slope;
      }
      node.push_back(x), share.push_back(2.0 / ((1.0 - x * x) * slope * slope));
    }
  }
  std::vector<double> node, share;
};

// ---- the sun's light

// A line of sight in even water, at one of the picture's wavelengths.
struct SunLine {
  float scattering, attenuation, fading;  // 1/m
  float depth_m, falls, way_m, cosine;    // as sun_scattered() takes them
  std::size_t water;                      // of the tables
};

// The four directions of the facts (across and along the sun's azimuth, straight down, up 45 degrees toward the sun) in
// five waters at three wavelengths, from three depths, over 0.3 to 6 lengths of attenuation: beyond, nothing is seen.
std::vector<SunLine> sun_lines() {
  struct Direction {
    double falls, cosine;
  };
  const double elevation = pi / 3.0, sine = std::cos(elevation) / 1.333, sun_cosine = std::sqrt(1.0 - sine * sine),
               diagonal = std::sqrt(0.5);
  const Direction directions[] = {
      {0.0, -sine}, {0.0, sine}, {1.0, -sun_cosine}, {-diagonal, diagonal * (sun_cosine + sine)}};
  std::vector<SunLine> lines;
  std::size_t water = 0;
  for (const WaterType type :
       {WaterType::ocean_1, WaterType::ocean_1b, WaterType::ocean_3, WaterType::coast_3, WaterType::coast_9}) {
    WaterSettings settings;
    settings.type = type;
    const WaterOptics optics = water_optics(settings);
    for (int colour = 0; colour < 3; ++colour, ++water)
      for (const Direction& d : directions)
        for (const double depth : {1.0, 5.0, 20.0})
          for (const double lengths : {0.3, 1.0, 3.0, 6.0}) {
            const double b = optics.scattering[colour], c = optics.absorption[colour] + b;
            double way = lengths / c;
            if (d.falls < 0.0) way = std::min(way, depth / -d.falls);
            lines.push_back({float(b), float(c),
                             float((optics.absorption[colour] + optics.backscatter[colour]) / sun_cosine), float(depth),
                             float(d.falls), float(way), float(d.cosine), water});
          }
  }
  return lines;
}

// One metre of a line, `t` metres from the eye: what is scattered there, and how much of it arrives.
template <class Real>
Real scattered_at(const SunLine& line, Real t) {
  return std::exp(-Real(line.fading) * (Real(line.depth_m) + t * Real(line.falls)) - Real(line.attenuation) * t);
}
template <class Real>
Real before_sum(const SunLine& line) {
  return Real(line.scattering) * gpu::henyey_greenstein(Real(line.cosine), Real(gpu::water_forward));
}

// By Gauss and Legendre's rule in 64 pieces of the line: exact to rounding.
double truth_of(const SunLine& line) {
  static const Rule rule(8);
  constexpr int pieces = 64;
  const double half = 0.5 * double(line.way_m) / pieces;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i)
    for (std::size_t n = 0; n < rule.node.size(); ++n)
      sum += rule.share[n] * half * scattered_at(line, (2 * i + 1) * half + rule.node[n] * half);
  return before_sum<double>(line) * sum;
}

float marched(const SunLine& line, int steps) {
  const float step = line.way_m / float(steps);
  float sum = 0.0f;
  for (int i = 0; i < steps; ++i) sum += scattered_at(line, (float(i) + 0.5f) * step);
  return before_sum<float>(line) * sum * step;
}

// Steps over which the line of sight loses equal shares of its light: short near the eye, from where most comes.
float marched_evenly_lost(const SunLine& line, int steps) {
  const float lost = 1.0f - std::exp(-line.attenuation * line.way_m);
  float sum = 0.0f;
  for (int i = 0; i < steps; ++i) {
    const float t = -std::log(1.0f - lost * (float(i) + 0.5f) / float(steps)) / line.attenuation;
    sum += std::exp(-line.fading * (line.depth_m + t * line.falls));
  }
  return before_sum<float>(line) * sum * lost / (float(steps) * line.attenuation);
}

// Of one water and colour: the sum over a line that begins at the surface, by how fast it falls (-1 to 1) and the share
// of its light that it has lost. Straight lines in between.
class SunTable {
 public:
  SunTable(float attenuation, float fading, int side) : attenuation_(attenuation), side_(side) {
    for (int j = 0; j <= side; ++j)
      for (int i = 0; i <= side; ++i) {
        const double falls = -1.0 + 2.0 * j / side, way = way_at(double(i) / side);
        sums_.push_back(float(gpu::path_sum(double(attenuation) + double(fading) * falls, way)));
      }
  }
  float sum(float falls, float way_m) const {
    const float x = (1.0f - std::exp(-attenuation_ * way_m / 3.0f)) / most_lost * float(side_),
                y = 0.5f * (falls + 1.0f) * float(side_);
    const int i = std::min(int(x), side_ - 1), j = std::min(int(y), side_ - 1);
    const float* at = &sums_[std::size_t(j * (side_ + 1) + i)];
    const float u = x - float(i), v = y - float(j);
    return (1.0f - v) * ((1.0f - u) * at[0] + u * at[1]) + v * ((1.0f - u) * at[side_ + 1] + u * at[side_ + 2]);
  }

 private:
  // A third of the attenuation spreads the table over six lengths of it.
  static constexpr float most_lost = 0.8647f;
  double way_at(double share) const { return -3.0 * std::log1p(-double(most_lost) * share) / double(attenuation_); }
  float attenuation_;
  int side_;
  std::vector<float> sums_;
};

template <class Of>
LabTask sun_task(const std::string& knob, double value, const std::shared_ptr<const std::vector<SunLine>>& lines,
                 const std::shared_ptr<const std::vector<double>>& truth, const Of& of,
                 const std::string& preset = "") {
  const auto got = std::make_shared<std::vector<float>>(lines->size());
  const auto errors = [=]() -> std::vector<LabError> {
    double sum = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < got->size(); ++i) {
      const double miss = std::abs(double((*got)[i]) / (*truth)[i] - 1.0);
      sum += miss * miss / double(got->size()), worst = std::max(worst, miss);
    }
    return {{std::sqrt(sum), "of a line's light, rms"}, {worst, "of a line's light, worst"}};
  };
  const auto run = [=] {
    for (std::size_t i = 0; i < got->size(); ++i) (*got)[i] = of((*lines)[i]);
  };
  return {knob, value, run, double(lines->size()) / 3.0, errors, preset, ""};
}

std::vector<LabTask> volume_tasks(double, const LabOptions& options) {
  const auto lines = std::make_shared<const std::vector<SunLine>>(sun_lines());
  std::vector<double> exact;
  for (const SunLine& line : *lines) exact.push_back(truth_of(line));
  const auto truth = std::make_shared<const std::vector<double>>(std::move(exact));
  std::vector<LabTask> tasks;
  tasks.push_back(sun_task(
      "closed form, as shaders have it", 1.0, lines, truth,
      [](const SunLine& l) {
        return gpu::sun_scattered(l.scattering, l.attenuation, l.fading, l.depth_m, l.falls, l.way_m, l.cosine);
      },
      "low medium high ultra"));
  const std::vector<int> steps =
      options.quick ? std::vector<int>{8, 16, 32, 64, 128} : std::vector<int>{4, 8, 12, 16, 24, 32, 48, 64, 96, 128};
  for (const int count : steps)
    tasks.push_back(sun_task("equal steps along the line", count, lines, truth,
                             [count](const SunLine& l) { return marched(l, count); }));
  for (const int count : steps)
    tasks.push_back(sun_task("steps of equal loss along the line", count, lines, truth,
                             [count](const SunLine& l) { return marched_evenly_lost(l, count); }));
  for (const int side : {8, 16, 32, 64, 128, 256}) {
    std::vector<SunTable> tables;
    for (const SunLine& line : *lines)
      if (line.water == tables.size()) tables.emplace_back(line.attenuation, line.fading, side);
    tasks.push_back(
        sun_task("entries a side of a table over slope and way", side, lines, truth, [tables](const SunLine& l) {
          return before_sum<float>(l) * std::exp(-l.fading * l.depth_m) * tables[l.water].sum(l.falls, l.way_m);
        }));
  }
  return tasks;
}

// ---- the dive light

// The unit of a sum's own error, the beam's edges left out that no sum looks at.
constexpr const char* summed_alone = "of a line's light, within the beam's reach, rms";

struct LampLine {
  float passes, apart, along, ahead, narrowness, attenuation, way_m;
};

// Lines of sight by lamps at the head and in a hand, beams of 6 to 90 degrees, from the clearest water to a harbour's.
std::vector<LampLine> lamp_lines(const LabOptions& options) {
  std::mt19937 random(options.seed + 3);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  const auto around = [&](double spread) {
    std::normal_distribution<> normal(0.0, spread);
    return glm::dvec3{normal(random), normal(random), normal(random)};
  };
  std::vector<LampLine> lines;
  for (int i = 0; i < (options.quick ? 400 : 2000); ++i) {
    const bool head = i % 2 == 0;
    const glm::dvec3 lamp = head ? glm::dvec3{between(-0.05, 0.05), between(0.05, 0.2), between(-0.1, 0.1)}
                                 : glm::dvec3{between(-0.3, 0.3), between(-0.5, 0.0), between(-0.5, -0.2)};
    const glm::dvec3 ahead(0.0, 0.0, -1.0), beam = glm::normalize(ahead + around(head ? 0.06 : 0.5)),
                                            ray = glm::normalize(ahead + around(0.35));
    const double passes = glm::dot(lamp, ray);
    lines.push_back(
        {float(passes),
         float(std::max(std::sqrt(std::max(glm::dot(lamp, lamp) - passes * passes, 0.0)), double(gpu::lamp_radius_m))),
         float(glm::dot(ray, beam)), float(glm::dot(lamp, beam)),
         float(gpu::lamp_narrowness(std::cos(glm::radians(between(3.0, 45.0))))),
         float(std::exp(between(std::log(0.06), std::log(2.5)))),
         float(std::exp(between(std::log(0.3), std::log(60.0))))});
  }
  return lines;
}

// What a metre of it scatters at t metres, for an intensity and a scattering of 1 (docs/underwater.md).
template <class Real>
Real lamp_at(const LampLine& line, Real t) {
  const Real off = t - Real(line.passes), range = std::sqrt(off * off + Real(line.apart) * Real(line.apart)),
             cosine = (t * Real(line.along) - Real(line.ahead)) / range;
  return gpu::lamp_beam(cosine, Real(line.narrowness)) / (range * range) *
         gpu::henyey_greenstein(-off / range, Real(gpu::water_forward)) *
         std::exp(-Real(line.attenuation) * (range + t));
}

// The whole line and not only where lamp_reach() says that there is light: 1,200 pieces, short at the eye.
double truth_of(const LampLine& line) {
  static const Rule rule(8);
  constexpr int pieces = 1200;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double a = double(line.way_m) * std::pow(double(i) / pieces, 3.0),
                 b = double(line.way_m) * std::pow(double(i + 1) / pieces, 3.0);
    for (std::size_t n = 0; n < rule.node.size(); ++n)
      sum += 0.5 * (b - a) * rule.share[n] * lamp_at(line, 0.5 * (a + b) + 0.5 * (b - a) * rule.node[n]);
  }
  return sum;
}

glm::vec2 reach_of(const LampLine& l) {
  return gpu::lamp_reach(l.passes, l.apart, l.along, l.ahead, l.narrowness, l.attenuation, l.way_m);
}

// As lib/lamp.glsl sums it.
float of_shader(const LampLine& l) {
  const glm::vec2 reach = reach_of(l);
  if (!(reach.y > reach.x)) return 0.0f;
  float sum = 0.0f;
  for (int i = 0; i < gpu::lamp_nodes; ++i) {
    const glm::vec2 node = gpu::lamp_scattered(i, l.passes, l.apart, l.along, l.ahead, l.narrowness, reach.x, reach.y);
    sum += node.x * std::exp(-l.attenuation * node.y);
  }
  return sum;
}

// `nodes` and shares for -1 to 1, in s where t = passes + apart sinh(s).
float by_nodes(const LampLine& l, const std::vector<float>& nodes, const std::vector<float>& shares) {
  const glm::vec2 reach = reach_of(l);
  if (!(reach.y > reach.x)) return 0.0f;
  const float first = gpu::lamp_asinh((reach.x - l.passes) / l.apart),
              last = gpu::lamp_asinh((reach.y - l.passes) / l.apart), half = 0.5f * (last - first);
  float sum = 0.0f;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const float s = 0.5f * (first + last) + half * nodes[i], grows = std::exp(s),
                off = 0.5f * l.apart * (grows - 1.0f / grows), range = 0.5f * l.apart * (grows + 1.0f / grows);
    sum += shares[i] * half * range * lamp_at(l, l.passes + off);
  }
  return sum;
}

// What such a sum comes to with ever more nodes: the light between the ends of lamp_reach().
double limit_of(const LampLine& l) {
  static const Rule rule(8);
  constexpr int pieces = 64;
  const glm::vec2 reach = reach_of(l);
  if (!(reach.y > reach.x)) return 0.0;
  const double apart = l.apart, passes = l.passes, first = std::asinh((double(reach.x) - passes) / apart),
               half = 0.5 * (std::asinh((double(reach.y) - passes) / apart) - first) / pieces;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i)
    for (std::size_t n = 0; n < rule.node.size(); ++n) {
      const double s = first + half * (2.0 * i + 1.0 + rule.node[n]);
      sum += half * rule.share[n] * apart * std::cosh(s) * lamp_at(l, passes + apart * std::sinh(s));
    }
  return sum;
}

float by_equal_steps(const LampLine& l, int steps) {
  const glm::vec2 reach = reach_of(l);
  if (!(reach.y > reach.x)) return 0.0f;
  const float step = (reach.y - reach.x) / float(steps);
  float sum = 0.0f;
  for (int i = 0; i < steps; ++i) sum += step * lamp_at(l, reach.x + (float(i) + 0.5f) * step);
  return sum;
}

// Of each line: all of its light, and what lies between the ends of lamp_reach().
struct LampTruth {
  std::vector<double> all, within;
};

// Errors are shares of what is seen: of a line's own light, and of a hundredth of the brightest line's where it is
// darker than that. `of_sum`: those of the sum alone are told too.
template <class Of>
LabTask lamp_task(const std::string& knob, double value, const std::shared_ptr<const std::vector<LampLine>>& lines,
                  const std::shared_ptr<const LampTruth>& truth, const Of& of, const std::string& preset = "",
                  bool of_sum = false) {
  const auto got = std::make_shared<std::vector<float>>(lines->size());
  const auto errors = [=]() -> std::vector<LabError> {
    const double least = 0.01 * *std::max_element(truth->all.begin(), truth->all.end());
    double sum = 0.0, worst = 0.0, own = 0.0;
    for (std::size_t i = 0; i < got->size(); ++i) {
      const double light = std::max(truth->all[i], least), n = double(got->size()),
                   miss = std::abs(double((*got)[i]) - truth->all[i]) / light,
                   off = (double((*got)[i]) - truth->within[i]) / light;
      sum += miss * miss / n, own += off * off / n, worst = std::max(worst, miss);
    }
    std::vector<LabError> told{{std::sqrt(sum), "of a line's light, rms"}, {worst, "of a line's light, worst"}};
    if (of_sum) told.push_back({std::sqrt(own), summed_alone});
    return told;
  };
  const auto run = [=] {
    for (std::size_t i = 0; i < got->size(); ++i) (*got)[i] = of((*lines)[i]);
  };
  return {knob, value, run, double(lines->size()), errors, preset, ""};
}

std::vector<LabTask> lamp_tasks(double, const LabOptions& options) {
  const auto lines = std::make_shared<const std::vector<LampLine>>(lamp_lines(options));
  LampTruth exact;
  for (const LampLine& line : *lines) exact.all.push_back(truth_of(line)), exact.within.push_back(limit_of(line));
  const auto truth = std::make_shared<const LampTruth>(std::move(exact));
  std::vector<LabTask> tasks;
  tasks.push_back(
      lamp_task("nodes, as shaders have them", gpu::lamp_nodes, lines, truth, of_shader, "low medium high ultra"));
  for (const int count : {2, 4, 6, 8, 10, 12, 16, 20, 24}) {
    const Rule rule(count);
    const std::vector<float> nodes(rule.node.begin(), rule.node.end()), shares(rule.share.begin(), rule.share.end());
    tasks.push_back(lamp_task("nodes of Gauss and Legendre", count, lines, truth,
                              [=](const LampLine& l) { return by_nodes(l, nodes, shares); }));
  }
  for (const int count : {4, 8, 16, 32, 64, 128}) {
    std::vector<float> nodes, shares(std::size_t(count), 2.0f / float(count));
    for (int i = 0; i < count; ++i) nodes.push_back(-1.0f + (2.0f * float(i) + 1.0f) / float(count));
    tasks.push_back(lamp_task(
        "steps, shorter towards the lamp", count, lines, truth,
        [=](const LampLine& l) { return by_nodes(l, nodes, shares); }, "", true));
    tasks.push_back(lamp_task("equal steps along the line", count, lines, truth,
                              [=](const LampLine& l) { return by_equal_steps(l, count); }));
  }
  return tasks;
}

}  // namespace

std::vector<LabCurve> water_curves() {
  const std::string middles = "the middle of each step is of second order";
  return {
      {"volume",
       "Light that the water adds",
       "three colours of one line of sight",
       {{"equal steps along the line", false, -2.0, 0.15, 32.0, 128.0, middles},
        {"entries a side of a table", false, -2.0, 0.35, 8.0, 256.0,
         "straight lines between entries are of second order"}},
       false,
       false,
       volume_tasks},
      {"dive_light",
       "The dive light's beam",
       "one line of sight",
       {{"steps, shorter towards the lamp", false, -2.0, 0.1, 32.0, 128.0, middles, summed_alone}},
       false,
       false,
       lamp_tasks,
       {},
       "steps",
       "as many nodes of Gauss and Legendre are the same sum, timed with what compilers of shaders move out of the "
       "loop"},
  };
}

}  // namespace seascape
