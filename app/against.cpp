#include "app/against.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "app/csv.h"
#include "app/statistics.h"
#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {

constexpr std::size_t fixed_columns = 12, pieces = 12;
constexpr double least_ms = 0.02, least_noise = 0.05;
// Student's t of 11 degrees of freedom, two-sided 0.001 (Abramowitz and Stegun 1964, table 26.10).
constexpr double student = 4.437;

const CaptureTimes& kind_of(const std::string& column) {
  return column.starts_with("gpu_") ? gpu_passes : cpu_stages;
}

std::string name_of(const std::string& column) { return column.substr(4, column.size() - 7); }

const CaptureRun* same_run(const std::vector<CaptureRun>& runs, const CaptureRun& run) {
  for (const CaptureRun& other : runs)
    if (other.scene == run.scene && other.preset == run.preset) return &other;
  return nullptr;
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return percentile(values, 0.5);
}

// One name's times in the frames that both runs have.
struct Pairs {
  std::string column;
  std::vector<double> before_ms, now_ms;
};

// The logarithms of now to before, in each piece the median; empty where a piece has no frame with both.
std::vector<double> pieces_of(const Pairs& pairs) {
  std::vector<double> medians;
  for (std::size_t p = 0; p < pieces; ++p) {
    std::vector<double> logs;
    const std::size_t frames = pairs.now_ms.size();
    for (std::size_t i = p * frames / pieces; i < (p + 1) * frames / pieces; ++i)
      if (pairs.before_ms[i] > 0.0 && pairs.now_ms[i] > 0.0) logs.push_back(std::log(pairs.now_ms[i] / pairs.before_ms[i]));
    if (logs.empty()) return {};
    medians.push_back(median_of(logs));
  }
  return medians;
}

double mean_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

std::vector<Pairs> pairs_of(const CaptureRun& before, const CaptureRun& now) {
  std::map<int, const CaptureFrame*> of_before;
  for (const CaptureFrame& frame : before.frames) of_before[frame.frame] = &frame;
  std::vector<Pairs> all;
  for (const CaptureTimes* kind : {&cpu_stages, &gpu_passes})
    for (const std::string& name : now.*kind->names) {
      const auto& names = before.*kind->names;
      if (std::find(names.begin(), names.end(), name) == names.end() || name == "waiting") continue;
      Pairs pairs{std::string(kind->of) + "_" + name + "_ms", {}, {}};
      for (const CaptureFrame& frame : now.frames)
        if (const auto other = of_before.find(frame.frame); other != of_before.end()) {
          pairs.before_ms.push_back(named_time_ms(before, *other->second, *kind, name));
          pairs.now_ms.push_back(named_time_ms(now, frame, *kind, name));
        }
      if (std::max(mean_of(pairs.before_ms), mean_of(pairs.now_ms)) >= least_ms) all.push_back(std::move(pairs));
    }
  return all;
}

RunChange compare(const CaptureRun& before, const CaptureRun& now) {
  RunChange run{now.scene, now.preset, 0, 1.0, {}};
  const std::vector<Pairs> all = pairs_of(before, now);
  std::vector<std::vector<double>> logs;
  for (const Pairs& pairs : all) logs.push_back(pieces_of(pairs));
  std::vector<double> common(pieces, 0.0);
  for (std::size_t p = 0; p < pieces; ++p) {
    std::vector<double> of_names;
    for (const auto& one : logs)
      if (!one.empty()) of_names.push_back(one[p]);
    common[p] = median_of(of_names);
  }
  run.together = std::exp(mean_of(common));
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (logs[n].empty()) continue;
    run.frames = std::max(run.frames, int(all[n].now_ms.size()));
    std::vector<double> own;
    for (std::size_t p = 0; p < pieces; ++p) own.push_back(logs[n][p] - common[p]);
    const double mean = mean_of(own);
    double square = 0.0;
    for (const double value : own) square += (value - mean) * (value - mean);
    const double off = student * std::sqrt(square / double(pieces - 1) / double(pieces));
    run.times.push_back({now.scene, now.preset, all[n].column, mean_of(all[n].before_ms), mean_of(all[n].now_ms),
                         std::exp(mean), std::max(std::expm1(off), least_noise)});
  }
  return run;
}

}  // namespace

std::vector<CaptureRun> parse_capture_csv(std::string_view text, const std::string& where) {
  const std::string remedy = "give the capture.csv that seascape capture wrote, of a version that has cpu_NAME_ms";
  std::vector<std::string> columns;
  std::vector<CaptureRun> runs;
  int line_number = 0;
  while (!text.empty()) {
    ++line_number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text = text.substr(std::min(end + 1, text.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const std::string place = fmt::format("{}:{}", where, line_number);
    const std::vector<std::string> cells = csv_cells(line);
    if (line_number == 1) {
      const bool ours = cells.size() > fixed_columns && cells[0] == "scene" && cells[1] == "preset" &&
                        cells[2] == "frame" && cells[4] == "cpu_ms" && cells[5] == "gpu_ms";
      if (!ours || std::none_of(cells.begin() + fixed_columns, cells.end(),
                                [](const std::string& cell) { return cell.starts_with("cpu_"); }))
        throw Error(place, "has not the columns of a capture", remedy);
      for (std::size_t i = fixed_columns; i < cells.size(); ++i)
        if (!(cells[i].starts_with("gpu_") || cells[i].starts_with("cpu_")) || !cells[i].ends_with("_ms") ||
            cells[i].size() < 8)
          throw Error(place, fmt::format("{}: is no column of a capture", in_quotes(cells[i])), remedy);
      columns = cells;
      continue;
    }
    if (cells.size() != columns.size())
      throw Error(place, fmt::format("has {} cells and not {}", cells.size(), columns.size()), remedy);
    const auto number = [&](std::size_t i, double least, double most) {
      const std::optional<double> value = real_from(cells[i]);
      if (!value || !(*value >= least && *value <= most))
        throw Error(place, fmt::format("{}: {} is not a number from {} to {}", columns[i], in_quotes(cells[i]), least, most),
                    remedy);
      return *value;
    };
    if (runs.empty() || runs.back().scene != cells[0] || runs.back().preset != cells[1]) {
      runs.emplace_back();
      runs.back().scene = cells[0];
      runs.back().preset = cells[1];
      for (std::size_t i = fixed_columns; i < columns.size(); ++i)
        (runs.back().*kind_of(columns[i]).names).push_back(name_of(columns[i]));
    }
    CaptureFrame frame;
    frame.frame = int(number(2, 0.0, 1e9));
    frame.cpu_ms = number(4, 0.0, 1e9);
    for (std::size_t i = fixed_columns; i < columns.size(); ++i)
      (frame.*kind_of(columns[i]).ms).push_back(number(i, 0.0, 1e9));
    runs.back().frames.push_back(std::move(frame));
  }
  if (runs.empty()) throw Error(where, "holds no frames", remedy);
  return runs;
}

std::vector<RunChange> compare_captures(const std::vector<CaptureRun>& before, const std::vector<CaptureRun>& now) {
  std::vector<RunChange> changes;
  for (const CaptureRun& run : now)
    if (const CaptureRun* other = same_run(before, run)) changes.push_back(compare(*other, run));
  return changes;
}

std::string tell_changes(const std::vector<RunChange>& runs) {
  if (runs.empty()) return "nothing to compare: the other capture has none of these scenes at these presets\n";
  std::string text;
  for (const RunChange& run : runs) {
    const std::string title = run.scene + " / " + run.preset;
    text += fmt::format("{}: {} frames, all times together {:.2f} of before\n", title, run.frames, run.together);
    bool any = false;
    for (const TimeChange& time : run.times) {
      if (!time.changed()) continue;
      any = true;
      text += fmt::format("{}: {} {:+.1f} % beyond that ({:.3f} ms before, {:.3f} now; noise {:.1f} %)\n", title,
                          time.name, 100.0 * (time.ratio - 1.0), time.before_ms, time.now_ms, 100.0 * time.noise);
    }
    if (!any) text += fmt::format("{}: no stage and no pass has changed by more than its noise\n", title);
  }
  return text;
}

}  // namespace seascape
