#include "app/report.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "app/csv.h"
#include "app/report_page.h"
#include "app/report_plots.h"
#include "app/statistics.h"
#include "app/svg.h"
#include "engine/files.h"

namespace seascape {

namespace {

// Columns of capture.csv for times by name: those of all runs, and of each row the run's own.
class NamedTimes {
 public:
  NamedTimes(const std::vector<CaptureRun>& runs, const CaptureTimes& kind)
      : kind_(kind), names_(all_names(runs, kind)) {}
  void head(std::string& text) const {
    for (const std::string& name : names_) text += "," + csv_cell(std::string(kind_.of) + "_" + name + "_ms");
  }
  void row(const CaptureRun& run, const CaptureFrame& frame, std::string& text) const {
    for (const std::string& name : names_)
      fmt::format_to(std::back_inserter(text), ",{:.4f}", named_time_ms(run, frame, kind_, name));
  }

 private:
  CaptureTimes kind_;
  std::vector<std::string> names_;
};

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

// "0 %", "0.3 %", "97.5 %", "100 %": never a 0 or a 100 that is only rounded.
std::string percent_text(std::size_t part, std::size_t whole) {
  const double value = percent(part, whole);
  if (part == 0 || part == whole) return fmt::format("{:.0f} %", value);
  return fmt::format("{:.1f} %", std::clamp(value, 0.1, 99.9));
}

std::uint64_t median_of(const CaptureRun& run, std::uint64_t CaptureFrame::*member) {
  std::vector<double> values;
  for (const CaptureFrame& frame : run.frames) values.push_back(static_cast<double>(frame.*member));
  return static_cast<std::uint64_t>(summarise(values).median + 0.5);
}

std::uint64_t bytes_of(const CaptureRun& run) {
  std::uint64_t bytes = 0;
  for (const MemoryUse& use : run.memory) bytes += use.bytes;
  return bytes;
}

std::string mebibytes(std::uint64_t bytes) { return fmt::format("{:.1f}", static_cast<double>(bytes) / 1048576.0); }

// 1234567 as 1 234 567, with spaces that do not break.
std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, "\u202f");
  return text;
}

std::string summary_table(const std::vector<CaptureRun>& runs) {
  std::string text =
      "<div class=\"wide\"><table>\n<thead><tr><th rowspan=\"2\">Run</th><th rowspan=\"2\">Frames</th><th "
      "colspan=\"5\">Frame time, ms</th><th colspan=\"2\">Median, ms</th>"
      "<th colspan=\"4\">Frames missed at</th><th rowspan=\"2\">Memory<br>MiB</th><th rowspan=\"2\">Draws</th>"
      "<th rowspan=\"2\">Triangles</th></tr>\n<tr><th>median</th><th>p5</th><th>p95</th><th>p99</th><th>max</th>"
      "<th>CPU</th><th>GPU</th>";
  for (const int rate : display_rates_hz) text += fmt::format("<th>{} Hz</th>", rate);
  text += "</tr></thead>\n<tbody>\n";
  for (const CaptureRun& run : runs) {
    const std::vector<double> times = frame_times_ms(run);
    const Summary all = summarise(times);
    std::vector<double> cpu, gpu;
    for (const CaptureFrame& frame : run.frames) {
      cpu.push_back(frame.cpu_ms);
      gpu.push_back(frame.gpu_ms);
    }
    text += fmt::format("<tr><th>{}</th><td>{}</td>", html_escaped(run_label(run, runs)), run.frames.size());
    for (const double value :
         {all.median, all.p5, all.p95, all.p99, all.max, summarise(cpu).median, summarise(gpu).median})
      text += fmt::format("<td>{:.2f}</td>", value);
    for (const int rate : display_rates_hz) {
      const std::size_t missed = count_missed(times, rate);
      const char* mark = missed == 0 ? "good" : missed * 100 <= times.size() ? "fair" : "bad";
      text += fmt::format("<td class=\"{}\">{}</td>", mark, percent_text(missed, times.size()));
    }
    text += fmt::format("<td>{}</td><td>{}</td><td>{}</td></tr>\n", mebibytes(bytes_of(run)),
                        median_of(run, &CaptureFrame::draws), grouped(median_of(run, &CaptureFrame::triangles)));
  }
  return text + "</tbody></table></div>\n";
}

std::string memory_table(const std::vector<CaptureRun>& runs) {
  std::vector<std::string> tags;
  for (const CaptureRun& run : runs)
    for (const MemoryUse& use : run.memory)
      if (std::find(tags.begin(), tags.end(), use.tag) == tags.end()) tags.push_back(use.tag);
  if (tags.empty()) return "";
  std::string text =
      "<h2>Memory</h2>\n<p>MiB of device memory, by what it is for.</p>\n<div "
      "class=\"wide\"><table><thead><tr><th>For</th>";
  for (const CaptureRun& run : runs) text += "<th>" + html_escaped(run_label(run, runs)) + "</th>";
  text += "</tr></thead><tbody>\n";
  for (const std::string& tag : tags) {
    text += "<tr><th>" + html_escaped(tag) + "</th>";
    for (const CaptureRun& run : runs) {
      std::uint64_t bytes = 0;
      for (const MemoryUse& use : run.memory)
        if (use.tag == tag) bytes += use.bytes;
      text += "<td>" + mebibytes(bytes) + "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string machine_list(const Machine& machine, const std::vector<CaptureRun>& runs) {
  std::string text = "<dl>" + machine_rows(machine);
  std::string scenes;
  for (const CaptureRun& run : runs) {
    const std::string scene = run.path.empty() || run.path == run.scene ? run.scene : run.scene + " along " + run.path;
    if (scenes.find(scene) == std::string::npos) scenes += (scenes.empty() ? "" : ", ") + scene;
  }
  text += list_row("Scene", scenes);
  std::string pictures;  // once where all runs have the same
  for (const CaptureRun& run : runs) {
    const std::string picture = fmt::format("{} × {}, {}, {} × MSAA", run.width, run.height,
                                            run.views == 1 ? "1 view" : fmt::format("{} views", run.views), run.msaa);
    if (pictures.find(picture) == std::string::npos) pictures += (pictures.empty() ? "" : "; ") + picture;
  }
  text += list_row("Picture", pictures);
  if (!runs.empty()) text += list_row("Warm-up", fmt::format("{} frames, not counted", runs.front().warmup));
  return text + "</dl>\n";
}

}  // namespace

const CaptureTimes gpu_passes{"gpu",
                              "GPU",
                              "outside any pass",
                              &CaptureRun::pass_names,
                              &CaptureFrame::pass_ms,
                              [](const CaptureRun&, const CaptureFrame& frame) { return frame.gpu_ms; }};
const CaptureTimes cpu_stages{"cpu",
                              "CPU",
                              "outside any stage",
                              &CaptureRun::stage_names,
                              &CaptureFrame::stage_ms,
                              [](const CaptureRun& run, const CaptureFrame& frame) {
                                return frame.cpu_ms + named_time_ms(run, frame, cpu_stages, "waiting");
                              }};

std::vector<std::string> all_names(const std::vector<CaptureRun>& runs, const CaptureTimes& kind) {
  std::vector<std::string> names;
  for (const CaptureRun& run : runs)
    for (const std::string& name : run.*kind.names)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

double named_time_ms(const CaptureRun& run, const CaptureFrame& frame, const CaptureTimes& kind,
                     const std::string& name) {
  const auto& names = run.*kind.names;
  const auto& ms = frame.*kind.ms;
  const auto at = std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
  return at < names.size() && at < ms.size() ? ms[at] : 0.0;
}

double frame_ms(const CaptureFrame& frame) {
  if (std::isnan(frame.cpu_ms) || std::isnan(frame.gpu_ms)) return std::numeric_limits<double>::quiet_NaN();
  return std::max(frame.cpu_ms, frame.gpu_ms);
}

std::vector<double> frame_times_ms(const CaptureRun& run) {
  std::vector<double> times;
  times.reserve(run.frames.size());
  for (const CaptureFrame& frame : run.frames) times.push_back(frame_ms(frame));
  return times;
}

std::string kept_text(const CaptureRun& run) {
  std::size_t late = 0;
  double quality = 0.0, scale = 0.0;
  const double frames = static_cast<double>(std::max<std::size_t>(run.frames.size(), 1));
  for (const CaptureFrame& frame : run.frames) {
    late += frame_ms(frame) > run.kept_ms;
    quality += frame.quality / frames;
    scale += frame.picture_scale / frames;
  }
  return fmt::format(
      "held to {:.2f} ms a frame: {} of {} frames took longer; mean quality {:.3f}, picture scale {:.3f}", run.kept_ms,
      late, run.frames.size(), quality, scale);
}

std::string capture_csv(const std::vector<CaptureRun>& runs) {
  const bool any_kept = std::any_of(runs.begin(), runs.end(), [](const CaptureRun& run) { return run.kept_ms > 0.0; });
  const NamedTimes passes(runs, gpu_passes), stages(runs, cpu_stages);
  std::string text =
      "scene,preset,frame,time_s,cpu_ms,gpu_ms,draws,triangles,dispatches,missed_72,missed_90,missed_120";
  passes.head(text);
  stages.head(text);
  if (any_kept)
    for (const std::string_view column : kept_columns) text += "," + std::string(column);
  text += "\n";
  for (const CaptureRun& run : runs) {
    const std::string start = csv_cell(run.scene) + "," + csv_cell(run.preset);
    for (const CaptureFrame& frame : run.frames) {
      const double ms = frame_ms(frame);
      fmt::format_to(std::back_inserter(text), "{},{},{:.6f},{:.4f},{:.4f},{},{},{},{:d},{:d},{:d}", start, frame.frame,
                     frame.time_s, frame.cpu_ms, frame.gpu_ms, frame.draws, frame.triangles, frame.dispatches,
                     is_missed(ms, 72), is_missed(ms, 90), is_missed(ms, 120));
      passes.row(run, frame, text);
      stages.row(run, frame, text);
      if (any_kept)
        fmt::format_to(std::back_inserter(text), ",{:.4f},{:.4f},{}", frame.picture_scale, frame.quality,
                       csv_cell(frame.decision));
      text += "\n";
    }
  }
  return text;
}

std::string conclusion(const CaptureRun& run) {
  const std::vector<double> times = frame_times_ms(run);
  if (times.empty()) return fmt::format("{} has no frames.", run.preset);
  const Summary all = summarise(times);
  int held = 0, missed = 0;  // the fastest rate held, the slowest missed
  for (const int rate : display_rates_hz) {
    if (count_missed(times, rate) * 100 <= times.size())
      held = rate;
    else if (missed == 0)
      missed = rate;
  }
  const auto against = [&](int rate) {
    return fmt::format("median {:.1f}, p99 {:.1f} and longest frame {:.1f} ms against {:.1f} ms", all.median, all.p99,
                       all.max, budget_ms(rate));
  };
  std::string text = run.preset;
  if (held)
    text +=
        fmt::format(" holds {} Hz ({} of frames missed)", held, percent_text(count_missed(times, held), times.size()));
  if (held && missed) text += " and";
  if (missed)
    text +=
        fmt::format(" misses {} Hz in {} of frames", missed, percent_text(count_missed(times, missed), times.size()));
  return text + ": " + against(missed ? missed : held) + ".";
}

std::string report_html(const Machine& machine, const std::vector<CaptureRun>& runs) {
  std::string title = "Seascape capture";
  if (!runs.empty()) title += ": " + runs.front().scene;
  std::string text = page_head(title);
  std::size_t fewest = runs.empty() ? 0 : runs.front().frames.size();
  for (const CaptureRun& run : runs) {
    text += "<p class=\"verdict\">" + html_escaped(conclusion(run)) + "</p>\n";
    fewest = std::min(fewest, run.frames.size());
  }
  if (runs.empty()) text += "<p class=\"verdict\">Nothing was captured.</p>\n";
  if (software(machine))
    text +=
        "<p class=\"note\">The device draws in software on the processor, so these times say nothing about a graphics "
        "card; "
        "they compare one build with another on this machine.</p>\n";
  if (!runs.empty() && fewest < 100)
    text += fmt::format(
        "<p class=\"note\">With only {} frames in a run, p99 is little more than its slowest frame.</p>\n", fewest);
  text += machine_list(machine, runs);
  if (!runs.empty()) {
    text += "<h2>Summary</h2>\n" + summary_table(runs) +
            "<p class=\"note\">A frame's time is the longer of its CPU and its GPU time, since the two work side by "
            "side. A frame is "
            "missed when that is over the display's interval. Draws and triangles are medians.</p>\n";
    text += "<h2>Frame time along the path</h2>\n" + frame_time_plot(runs);
    for (const CaptureRun& run : runs)
      if (run.kept_ms > 0.0)
        text += "<h2>How the frame rate was held</h2>\n<p class=\"verdict\">" +
                html_escaped(run_label(run, runs) + ": " + kept_text(run)) + ".</p>\n<figure>" + kept_svg(run) +
                "</figure>\n";
    text += "<h2>Where the GPU's time goes</h2>\n" + named_time_plot(runs, gpu_passes);
    text += "<h2>Where the CPU's time goes</h2>\n" + named_time_plot(runs, cpu_stages);
    text += "<h2>Spread of frame times</h2>\n" + histogram_plot(runs);
    text += memory_table(runs);
  }
  return text + page_end;
}

void write_capture_csv(const std::filesystem::path& file, const std::vector<CaptureRun>& runs) {
  write_atomically(file, capture_csv(runs));
}

void write_report(const std::filesystem::path& file, const Machine& machine, const std::vector<CaptureRun>& runs) {
  write_atomically(file, report_html(machine, runs));
}

}  // namespace seascape
