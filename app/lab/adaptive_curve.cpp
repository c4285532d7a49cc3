// The curve of adaptive quality: what each rule of picture scale loses against the optimum in hindsight, by family of
// traces, and how long a decision takes.
#include <algorithm>
#include <cmath>
#include <memory>

#include "app/lab/adaptive_report.h"
#include "app/lab/lab.h"

namespace seascape {

namespace {

struct Family {
  std::vector<LoadTrace> traces;
  std::vector<double> optima;
  double frames = 0.0;
};

std::vector<LabTask> adaptive_tasks(double, const LabOptions& options) {
  std::vector<std::shared_ptr<Family>> families;
  for (LoadTrace& trace : lab_traces(options.seed, options.quick ? 1 : 5)) {
    if (families.empty() || families.back()->traces.front().family != trace.family)
      families.push_back(std::make_shared<Family>());
    families.back()->optima.push_back(optimum_of(trace).score);
    families.back()->frames += double(trace.frames());
    families.back()->traces.push_back(std::move(trace));
  }
  std::vector<LabTask> tasks;
  for (const NamedRule& rule : field_rules())
    for (std::size_t f = 0; f < families.size(); ++f) {
      const std::shared_ptr<Family> family = families[f];
      const auto lost = std::make_shared<double>(0.0);
      const auto run = [family, lost, make = rule.make] {
        double share = 0.0;
        for (std::size_t i = 0; i < family->traces.size(); ++i) {
          const std::unique_ptr<AreaRule> played = make();
          share += score_of(play(family->traces[i], *played)) / family->optima[i];
        }
        *lost = std::max(0.0, 1.0 - share / double(family->traces.size()));
      };
      const auto errors = [lost]() -> std::vector<LabError> { return {{*lost, "of the optimum's score lost"}}; };
      tasks.push_back({rule.name, double(f + 1), run, family->frames, errors, "", ""});
    }
  return tasks;
}

}  // namespace

std::vector<LabCurve> adaptive_curves() {
  return {
      {"adaptive", "Adaptive quality by family of traces", "one frame's decision", {}, false, false, adaptive_tasks}};
}

}  // namespace seascape
