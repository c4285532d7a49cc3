#include "app/against.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "app/csv.h"
#include "app/statistics.h"
#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {

constexpr std::size_t fixed_columns = 12;
constexpr double least_ms = 0.02, long_ms = 0.1, least_noise = 0.06, least_noise_ms = 0.02, deviations = 2.0;

const CaptureTimes& kind_of(const std::string& column) { return column.starts_with("gpu_") ? gpu_passes : cpu_stages; }

std::string name_of(const std::string& column) { return column.substr(4, column.size() - 7); }

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return percentile(values, 0.5);
}

double mean_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

using Runs = std::vector<const CaptureRun*>;

Runs runs_of(const std::vector<CaptureRun>& runs, const CaptureRun& like) {
  Runs result;
  for (const CaptureRun& run : runs)
    if (run.scene == like.scene && run.preset == like.preset) result.push_back(&run);
  return result;
}

// A stage's times in the frames that all runs have: a row a run.
using Times = std::vector<std::vector<double>>;

Times times_of(const Runs& runs, const std::set<int>& frames, const std::string& name) {
  Times times;
  for (const CaptureRun* run : runs) {
    times.emplace_back();
    for (const CaptureFrame& frame : run->frames)
      if (frames.contains(frame.frame)) times.back().push_back(named_time_ms(*run, frame, cpu_stages, name));
  }
  return times;
}

// The sum over frames of the shortest time in any run but `without`.
double shortest_ms(const Times& times, std::size_t without) {
  double sum = 0.0;
  for (std::size_t i = 0; i < times.front().size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t run = 0; run < times.size(); ++run)
      if (run != without) least = std::min(least, times[run][i]);
    sum += least;
  }
  return sum;
}

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

struct Pair {
  std::string name;
  Times before, now;
  bool is_long;  // long_ms and more a frame
  double log_ratio(std::size_t without_before, std::size_t without_now) const {
    return std::log(shortest_ms(now, without_now) / shortest_ms(before, without_before));
  }
};

// How each stage has changed beyond what all have in common, which `common` gets: the median of the long ones, where
// there are three, for what takes some microseconds varies by half.
std::vector<double> changes_of(const std::vector<Pair>& pairs, std::size_t without_before, std::size_t without_now,
                               double& common) {
  std::vector<double> logs, of_long;
  for (const Pair& pair : pairs) {
    logs.push_back(pair.log_ratio(without_before, without_now));
    if (pair.is_long) of_long.push_back(logs.back());
  }
  common = median_of(of_long.size() < 3 ? logs : of_long);
  for (double& one : logs) one -= common;
  return logs;
}

// Adds the variance by which leaving out each of a side's runs shows the changes to vary.
void add_variance(const std::vector<std::vector<double>>& left_out, std::vector<double>& variance) {
  const double count = double(left_out.size());
  for (std::size_t n = 0; n < variance.size(); ++n) {
    std::vector<double> values;
    for (const auto& changes : left_out) values.push_back(changes[n]);
    const double mean = mean_of(values);
    for (const double value : values) variance[n] += (count - 1.0) / count * (value - mean) * (value - mean);
  }
}

// The table says nothing of size, views, path and settings. Other times or triangles of the same frames betray them; a
// build may change some triangles.
std::string unlike(const Runs& before, const Runs& now, const std::set<int>& frames) {
  double triangles_before = 0.0, triangles_now = 0.0;
  for (const int number : frames) {
    const auto frame_of = [&](const Runs& side) -> const CaptureFrame& {
      const std::vector<CaptureFrame>& all = side.front()->frames;
      return *std::find_if(all.begin(), all.end(), [&](const CaptureFrame& frame) { return frame.frame == number; });
    };
    const CaptureFrame &old_one = frame_of(before), &new_one = frame_of(now);
    if (std::abs(old_one.time_s - new_one.time_s) > 2e-6)
      return fmt::format("frame {} at {} s, {} before", number, new_one.time_s, old_one.time_s);
    triangles_before += double(old_one.triangles), triangles_now += double(new_one.triangles);
  }
  if (std::abs(triangles_now - triangles_before) <= 0.02 * std::max(triangles_before, triangles_now)) return "";
  return fmt::format("{:.0f} triangles a frame, {:.0f} before", triangles_now / double(frames.size()),
                     triangles_before / double(frames.size()));
}

RunChange compare(const Runs& before, const Runs& now) {
  RunChange run{now.front()->scene, now.front()->preset, 0, 1.0, {}, ""};
  std::map<int, std::size_t> having;
  for (const Runs* side : {&before, &now})
    for (const CaptureRun* one : *side)
      for (const CaptureFrame& frame : one->frames) ++having[frame.frame];
  std::set<int> frames;
  for (const auto& [frame, count] : having)
    if (count == before.size() + now.size()) frames.insert(frame);
  run.frames = int(frames.size());
  if (frames.empty()) return run;
  run.unlike = unlike(before, now, frames);
  std::vector<Pair> pairs;
  for (const std::string& name : now.front()->stage_names) {
    if (name == "waiting") continue;  // for the GPU
    Pair pair{name, times_of(before, frames, name), times_of(now, frames, name), false};
    const double mean_ms = std::min(shortest_ms(pair.before, none), shortest_ms(pair.now, none)) / run.frames;
    pair.is_long = mean_ms >= long_ms;
    if (mean_ms >= least_ms) pairs.push_back(std::move(pair));
  }
  double common = 0.0, unused = 0.0;
  const std::vector<double> changes = changes_of(pairs, none, none, common);
  std::vector<std::vector<double>> without_before, without_now;
  for (std::size_t r = 0; r < before.size(); ++r) without_before.push_back(changes_of(pairs, r, none, unused));
  for (std::size_t r = 0; r < now.size(); ++r) without_now.push_back(changes_of(pairs, none, r, unused));
  std::vector<double> variance(pairs.size(), 0.0);
  add_variance(without_before, variance);
  add_variance(without_now, variance);
  run.together = std::exp(common);
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const double before_ms = shortest_ms(pairs[n].before, none) / run.frames,
                 now_ms = shortest_ms(pairs[n].now, none) / run.frames,
                 off = std::expm1(deviations * std::sqrt(variance[n]));
    run.stages.push_back({"cpu_" + pairs[n].name + "_ms", before_ms, now_ms, std::exp(changes[n]),
                          std::max({off, least_noise, least_noise_ms / std::min(before_ms, now_ms)})});
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
                        cells[2] == "frame" && cells[3] == "time_s" && cells[4] == "cpu_ms" && cells[5] == "gpu_ms" &&
                        cells[7] == "triangles";
      if (!ours || std::none_of(cells.begin() + fixed_columns, cells.end(),
                                [](const std::string& cell) { return cell.starts_with("cpu_"); }))
        throw Error(place, "has not the columns of a capture", remedy);
      if (std::find(cells.begin(), cells.end(), kept_columns.back()) != cells.end())
        throw Error(
            place,
            "holds runs whose quality was lowered to hold a frame rate: their times tell nothing of the program's",
            "capture without --set adaptive.use=on");
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
        throw Error(place,
                    fmt::format("{}: {} is not a number from {} to {}", columns[i], in_quotes(cells[i]), least, most),
                    remedy);
      return *value;
    };
    const int frame_number = int(number(2, 0.0, 1e9));
    if (runs.empty() || runs.back().scene != cells[0] || runs.back().preset != cells[1] ||
        runs.back().frames.back().frame >= frame_number) {
      runs.emplace_back();
      runs.back().scene = cells[0];
      runs.back().preset = cells[1];
      for (std::size_t i = fixed_columns; i < columns.size(); ++i)
        (runs.back().*kind_of(columns[i]).names).push_back(name_of(columns[i]));
    }
    CaptureFrame frame;
    frame.frame = frame_number;
    frame.time_s = number(3, 0.0, 1e9);
    frame.cpu_ms = number(4, 0.0, 1e9);
    frame.triangles = std::uint64_t(number(7, 0.0, 1e15));
    for (std::size_t i = fixed_columns; i < columns.size(); ++i)
      (frame.*kind_of(columns[i]).ms).push_back(number(i, 0.0, 1e9));
    runs.back().frames.push_back(std::move(frame));
  }
  if (runs.empty()) throw Error(where, "holds no frames", remedy);
  return runs;
}

void expect_repeats(const std::vector<CaptureRun>& runs, const std::string& where) {
  for (const CaptureRun& run : runs)
    if (const std::size_t count = runs_of(runs, run).size(); count < least_repeats)
      throw Error(where,
                  fmt::format("{} / {}: {} runs of the path, and a comparison takes {} on either side", run.scene,
                              run.preset, count, least_repeats),
                  "capture both with --repeat 16");
}

std::vector<RunChange> compare_captures(const std::vector<CaptureRun>& before, const std::vector<CaptureRun>& now) {
  std::vector<RunChange> changes;
  for (const CaptureRun& run : now) {
    const Runs of_now = runs_of(now, run), of_before = runs_of(before, run);
    if (of_now.front() != &run || of_before.empty()) continue;
    changes.push_back(compare(of_before, of_now));
  }
  return changes;
}

std::string tell_changes(const std::vector<RunChange>& runs) {
  if (runs.empty()) return "nothing to compare: the other capture has none of these scenes at these presets\n";
  std::string text;
  for (const RunChange& run : runs) {
    const std::string title = run.scene + " / " + run.preset;
    text += fmt::format("{}: {} frames, all stages together {:.2f} of before\n", title, run.frames, run.together);
    if (!run.unlike.empty())
      text += fmt::format(
          "{}: these are other pictures than before ({}); capture both with the same --size, --views, "
          "--path, --fps and settings\n",
          title, run.unlike);
    bool any = false;
    for (const StageChange& time : run.stages) {
      if (!time.changed()) continue;
      any = true;
      text += fmt::format("{}: {} {:+.1f} % beyond that ({:.3f} ms before, {:.3f} now; noise {:.1f} %)\n", title,
                          time.name, 100.0 * (time.ratio - 1.0), time.before_ms, time.now_ms, 100.0 * time.noise);
    }
    if (!any) text += fmt::format("{}: no stage has changed by more than its noise\n", title);
  }
  return text;
}

}  // namespace seascape
