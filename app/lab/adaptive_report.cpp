#include "app/lab/adaptive_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "app/csv.h"
#include "app/scene.h"
#include "app/svg.h"

namespace seascape {

namespace {

// The frames after a step over which the quality that it comes to is taken.
constexpr std::size_t settled_from = 120, settled_to = 240;

constexpr double plot_start = left_edge, plot_end = plot_width - 8.0;

// A stretch of the picture that a value is drawn in.
struct Band {
  double top = 0.0, bottom = 0.0, least = 0.0, most = 1.0;
  double y(double value) const {
    return bottom - (std::clamp(value, least, most) - least) / (most - least) * (bottom - top);
  }
};

double x_of(std::size_t frame, std::size_t frames) {
  return plot_start + (plot_end - plot_start) * double(frame) / double(std::max<std::size_t>(frames, 2) - 1);
}

// The least and the greatest of each of 500 steps across, so that no single frame is lost.
std::string thinned_line(const std::vector<double>& values, const Band& band, const std::string& stroke,
                         const char* width) {
  constexpr std::size_t most = 500;
  const std::size_t n = values.size(), steps = std::min(n, most);
  std::string way;
  for (std::size_t s = 0; s < steps; ++s) {
    const std::size_t from = s * n / steps, to = std::max(from + 1, (s + 1) * n / steps);
    const auto [low, high] =
        std::minmax_element(values.begin() + std::ptrdiff_t(from), values.begin() + std::ptrdiff_t(to));
    std::array<std::ptrdiff_t, 2> two{low - values.begin(), high - values.begin()};
    if (two[1] < two[0]) std::swap(two[0], two[1]);
    for (std::size_t k = 0; k < (two[0] == two[1] ? 1u : 2u); ++k)
      fmt::format_to(std::back_inserter(way), "{:.1f},{:.1f} ", x_of(std::size_t(two[k]), n),
                     band.y(values[std::size_t(two[k])]));
  }
  return fmt::format("<polyline fill=\"none\" stroke-width=\"{}\" style=\"stroke:{}\" points=\"{}\"/>\n", width, stroke,
                     way);
}

// Scales change rarely: a corner at each change.
std::string step_line(const std::vector<double>& areas, const Band& band, const std::string& stroke) {
  std::string way;
  const std::size_t n = areas.size();
  double drawn = -1.0;
  for (std::size_t t = 0; t < n; ++t) {
    const double y = band.y(std::sqrt(areas[t]));
    if (std::abs(y - drawn) < 0.7 && t + 1 < n) continue;
    if (drawn >= 0.0) fmt::format_to(std::back_inserter(way), "{:.1f},{:.1f} ", x_of(t, n), drawn);
    fmt::format_to(std::back_inserter(way), "{:.1f},{:.1f} ", x_of(t, n), y);
    drawn = y;
  }
  return fmt::format("<polyline fill=\"none\" stroke-width=\"1.4\" style=\"stroke:{}\" points=\"{}\"/>\n", stroke, way);
}

std::string band_axis(const Band& band, double step, const std::string& title) {
  std::string text = text_at(8.0, band.top - 12.0, title);
  for (double v = band.least; v < band.most + 0.5 * step; v += step) {
    text += line(plot_start, band.y(v), plot_end, band.y(v), "axis");
    text += text_at(plot_start - 6.0, band.y(v) + 4.0, tick_text(v, step), "end");
  }
  return text;
}

}  // namespace

int frames_to_settle(const LoadTrace& trace, const Played& played) {
  std::size_t at = 0;
  double most = 0.1;
  for (std::size_t t = 1; t < trace.frames(); ++t)
    if (const double jump = std::abs(std::log(trace.mean[t] / trace.mean[t - 1])); jump > most) at = t, most = jump;
  if (at == 0) return -1;
  const std::size_t from = at + settled_from, to = at + settled_to;
  if (to > trace.frames()) return -1;
  double end = 0.0;
  for (std::size_t t = from; t < to; ++t) end += quality_of_area(played.area[t]) / double(to - from);
  std::size_t settled = to;
  while (settled > at && std::abs(quality_of_area(played.area[settled - 1]) - end) <= 0.1 &&
         !(played.missed[settled - 1] && played.missed[settled - 2]))
    --settled;
  return int(settled - at);
}

JudgedTrace judge(const LoadTrace& trace) {
  JudgedTrace judged{trace.name, trace.family, trace.fixed_share, trace.dead_frames, 0.0, 0.0, {}};
  judged.optimum = optimum_of(trace).score;
  judged.causal = best_causal(trace) / judged.optimum;
  for (const NamedRule& named : field_rules()) {
    const std::unique_ptr<AreaRule> rule = named.make();
    const Played played = play(trace, *rule);
    const PlayedFacts facts = facts_of(trace, played);
    judged.rules.push_back({named.name, facts.score / judged.optimum, frames_to_settle(trace, played), facts});
  }
  return judged;
}

std::vector<FamilyScore> family_scores(const std::vector<JudgedTrace>& judged) {
  std::vector<FamilyScore> scores;
  for (const JudgedTrace& one : judged) {
    auto found =
        std::find_if(scores.begin(), scores.end(), [&](const FamilyScore& s) { return s.family == one.family; });
    if (found == scores.end()) {
      scores.push_back({one.family, 0, 0.0, std::vector<double>(one.rules.size(), 0.0)});
      found = scores.end() - 1;
    }
    ++found->traces;
    found->causal += one.causal;
    for (std::size_t r = 0; r < one.rules.size(); ++r) found->shares[r] += one.rules[r].share;
  }
  for (FamilyScore& score : scores) {
    score.causal /= score.traces;
    for (double& share : score.shares) share /= score.traces;
  }
  return scores;
}

std::string adaptive_csv(const std::vector<JudgedTrace>& judged) {
  std::string text =
      "trace,family,fixed_share,dead_frames,rule,score_share,causal_share,mean_quality,misses_per_1000,longest_run,"
      "p99_cost,changes_per_minute,reversals_per_minute,settled_after_frames\n";
  for (const JudgedTrace& one : judged)
    for (const JudgedRule& rule : one.rules) {
      const PlayedFacts& f = rule.facts;
      text += fmt::format("{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.2f},{},{:.3f},{:.1f},{:.1f},{}\n", csv_cell(one.name),
                          csv_cell(one.family), one.fixed_share, one.dead_frames, csv_cell(rule.rule), rule.share,
                          one.causal, f.mean_quality, f.misses_per_1000, f.longest_run, f.p99_cost,
                          f.changes_per_minute, f.reversals_per_minute, rule.settled_after);
    }
  return text;
}

std::string adaptive_table(const std::vector<JudgedTrace>& judged) {
  std::string text = fmt::format("{:<13} {:>6} {:>7}", "family", "traces", "causal");
  for (const NamedRule& rule : field_rules())
    text += fmt::format(" {:>9}", rule.name == "Filament, 10 % headroom" ? "Fil. 10 %" : rule.name);
  text += "\n";
  for (const FamilyScore& score : family_scores(judged)) {
    text += fmt::format("{:<13} {:>6} {:>7.3f}", score.family, score.traces, score.causal);
    for (const double share : score.shares) text += fmt::format(" {:>9.3f}", share);
    text += "\n";
  }
  return text;
}

std::string trace_svg(const LoadTrace& trace) {
  const std::span<const NamedRule> rules = field_rules();
  const std::size_t n = trace.frames();
  const Band cost{46.0, 156.0, 0.0, 1.5}, scale{196.0, 346.0, 0.8, 1.4};
  constexpr double rows = 382.0, row = 16.0;
  std::vector<Legend> entries;
  for (std::size_t r = 0; r < rules.size(); ++r) entries.push_back({rules[r].name, colour(r)});
  entries.push_back({"optimum in hindsight", colour(6)});
  entries.push_back({"load at scale 1", colour(7)});
  const double bottom = rows + row * double(rules.size() + 1) + 30.0;
  std::string text = "<figure>" + open_svg(bottom + legend_height(entries), "Adaptive quality: " + trace.name);
  text += text_at(8.0, 14.0,
                  fmt::format("{}: {:.0f} % of the cost is fixed, dead time {} frames", trace.name,
                              100.0 * trace.fixed_share, trace.dead_frames),
                  "start", false);
  text += band_axis(cost, 0.5, "cost of a frame over its period");
  text += band_axis(scale, 0.2, "picture scale");
  std::vector<double> load(n), ratio(n);
  for (std::size_t t = 0; t < n; ++t) load[t] = trace.cost_ms(t, 1.0) / trace.period_ms[t];
  text += thinned_line(load, cost, colour(7), "0.8");
  const Optimum optimum = optimum_of(trace);
  text += step_line(optimum.area, scale, colour(6));
  std::string marks;
  for (std::size_t r = rules.size(); r-- > 0;) {
    const std::unique_ptr<AreaRule> rule = rules[r].make();
    const Played played = play(trace, *rule);
    text += step_line(played.area, scale, colour(r));
    if (r == 0) {
      for (std::size_t t = 0; t < n; ++t) ratio[t] = played.cost_ms[t] / trace.period_ms[t];
      text += thinned_line(ratio, cost, colour(0), "1");
    }
    const double y = rows + row * double(r);
    int misses = 0;
    std::string way;
    double drawn = -10.0;
    for (std::size_t t = 0; t < n; ++t) {
      misses += played.missed[t];
      if (!played.missed[t] || x_of(t, n) - drawn < 0.8) continue;
      drawn = x_of(t, n);
      fmt::format_to(std::back_inserter(way), "M{:.1f} {:.1f}v10", drawn, y - 9.0);
    }
    if (!way.empty())
      marks += fmt::format("<path stroke-width=\"0.8\" style=\"stroke:{}\" d=\"{}\"/>\n", colour(r), way);
    marks += text_at(plot_start - 6.0, y, fmt::format("{}", misses), "end", false, colour(r));
  }
  text += text_at(8.0, rows - 18.0, "misses");
  text += marks;
  for (double s = 0.0; s < double(n) / 90.0; s += round_step(double(n) / 90.0, 8))
    text += text_at(x_of(std::size_t(90.0 * s), n), rows + row * double(rules.size()) + 2.0, fmt::format("{:.0f} s", s),
                    "middle");
  return standalone_svg(text + legend(entries, bottom) + "</svg></figure>\n");
}

std::string trace_file_name(const LoadTrace& trace) {
  std::string name;
  for (const char c : trace.name)
    if (c != '%') name += c == ' ' ? '_' : c;
  for (std::size_t at = name.find("__"); at != std::string::npos; at = name.find("__")) name.erase(at, 1);
  return name + ".svg";
}

std::vector<LoadTrace> lab_traces(std::uint64_t seed, int each) {
  std::vector<LoadTrace> traces = made_traces(seed, each);
  for (LoadTrace& one : recorded_traces(content_directory() / "traces" / "scenes.csv", seed))
    traces.push_back(std::move(one));
  return traces;
}

}  // namespace seascape
