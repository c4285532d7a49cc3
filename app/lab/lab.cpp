#include "app/lab/lab.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "engine/error.h"

namespace seascape {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr double least_run_s = 2e-4;  // a clock's reading and its call are a thousandth of it
constexpr int least_rounds = 5, most_rounds = 200;

}  // namespace

std::string sea_name(double wind_mps) { return wind_mps > 0.0 ? fmt::format("U{:.0f}", wind_mps) : "none"; }

SeaState lab_sea(double wind_mps, const LabOptions& options) {
  SeaState sea;
  sea.wind_speed_mps = wind_mps;
  sea.seed = options.seed;
  return sea;
}

std::vector<LabCurve> cpu_curves() {
  std::vector<LabCurve> curves = sea_curves();
  for (LabCurve& curve : source_curves()) curves.push_back(std::move(curve));
  for (LabCurve& curve : local_curves()) curves.push_back(std::move(curve));
  for (LabCurve& curve : wake_curves()) curves.push_back(std::move(curve));
  for (LabCurve& curve : body_curves()) curves.push_back(std::move(curve));
  for (LabCurve& curve : water_curves()) curves.push_back(std::move(curve));
  curves.push_back(waterline_curve());
  for (LabCurve& curve : adaptive_curves()) curves.push_back(std::move(curve));
  return curves;
}

std::vector<LabPoint> measure(const std::string& curve, double wind_mps, std::vector<LabTask> tasks,
                              const LabOptions& options, double seconds, const std::function<void(double)>& step) {
  struct Timed {
    int repeats = 1;
    std::vector<double> us;
  };
  std::vector<Timed> timed(tasks.size());
  const Clock::time_point start = Clock::now();
  for (std::size_t i = 0; i < tasks.size(); ++i) {  // the first run of each is not counted: it makes what stays
    tasks[i].run();
    if (!options.timed) continue;
    const Clock::time_point second = Clock::now();
    tasks[i].run();
    timed[i].repeats = std::clamp(int(std::ceil(least_run_s / std::max(seconds_since(second), 1e-9))), 1, 100'000);
  }
  for (int round = 0; options.timed && round < most_rounds; ++round) {
    if (round >= least_rounds && seconds_since(start) > seconds) break;
    for (std::size_t n = 0; n < tasks.size(); ++n) {
      const std::size_t i = round % 2 == 0 ? n : tasks.size() - 1 - n;  // whatever drifts, drifts for all alike
      const Clock::time_point begin = Clock::now();
      for (int repeat = 0; repeat < timed[i].repeats; ++repeat) tasks[i].run();
      timed[i].us.push_back(1e6 * seconds_since(begin) / (timed[i].repeats * tasks[i].parts));
    }
    step(std::min(0.9, 0.9 * std::max(seconds_since(start) / seconds, (round + 1.0) / most_rounds)));
  }
  std::vector<LabPoint> points;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    tasks[i].run();  // its result, not that of a task it shares memory with
    for (const LabError& error : tasks[i].errors()) {
      points.push_back({curve, tasks[i].knob, tasks[i].value, sea_name(wind_mps), summarise(timed[i].us), error,
                        tasks[i].preset, tasks[i].settings});
      if (!std::isfinite(error.value) || !std::isfinite(points.back().time_us.median))
        throw Error("curve " + curve,
                    fmt::format("{} {} at U = {:.0f} m/s has an error of {} and takes {} us", tasks[i].knob,
                                tasks[i].value, wind_mps, error.value, points.back().time_us.median),
                    "this is a fault of seascape");
    }
    step(0.9 + 0.1 * double(i + 1) / double(tasks.size()));
  }
  return points;
}

double fitted_power(const LabLaw& law, const std::vector<LabPoint>& points, std::string_view sea) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  std::string unit = law.unit;
  for (const LabPoint& p : points) {
    if (p.sea != sea || !p.knob.starts_with(law.knob) || p.value < law.least || p.value > law.most ||
        !(p.error.value > 0.0))
      continue;
    if (unit.empty()) unit = p.error.unit;
    if (p.error.unit != unit) continue;
    const double a = law.steps ? p.value : std::log(p.value), b = std::log(p.error.value);
    n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
  }
  const double spread = n * xx - x * x;
  if (n < 2.0 || !(spread > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const double slope = (n * xy - x * y) / spread;
  return law.steps ? std::exp(slope) : slope;
}

double stated_power(const LabLaw& law, const std::vector<LabPoint>& points, std::string_view sea) {
  if (law.predicted.empty()) return law.power;
  LabLaw of_theory = law;
  of_theory.unit = law.predicted;
  return fitted_power(of_theory, points, sea);
}

}  // namespace seascape
