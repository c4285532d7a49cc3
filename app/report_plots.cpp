#include "app/report_plots.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "app/statistics.h"
#include "app/svg.h"

namespace seascape {

namespace {

// The top of the scale of frame times: what holds 99 % of every run and the slowest budget; a few outliers go past it.
double top_ms(const std::vector<CaptureRun>& runs) {
  double top = budget_ms(72) * 1.15;
  for (const CaptureRun& run : runs) {
    const Summary summary = summarise(frame_times_ms(run));
    top = std::max(top, std::min(summary.max, 1.3 * summary.p99) * 1.08);
  }
  return top;
}

// Points of a line, at most two for each step across the picture: the least and the greatest there, so that no spike is
// lost.
std::vector<std::pair<double, double>> thinned(const std::vector<std::pair<double, double>>& points, std::size_t most) {
  if (points.size() <= 2 * most) return points;
  std::vector<std::pair<double, double>> kept;
  for (std::size_t step = 0; step < most; ++step) {
    const auto from = points.begin() + static_cast<std::ptrdiff_t>(step * points.size() / most);
    const auto to = points.begin() + static_cast<std::ptrdiff_t>((step + 1) * points.size() / most);
    auto [low, high] = std::minmax_element(from, to, [](const auto& a, const auto& b) { return a.second < b.second; });
    if (high < low) std::swap(low, high);
    kept.push_back(*low);
    if (high != low) kept.push_back(*high);
  }
  return kept;
}

double mean_time_ms(const CaptureRun& run, const CaptureTimes& kind, const std::string& name) {
  std::vector<double> values;
  for (const CaptureFrame& frame : run.frames) values.push_back(named_time_ms(run, frame, kind, name));
  return summarise(values).mean;
}

}  // namespace

std::string run_label(const CaptureRun& run, const std::vector<CaptureRun>& runs) {
  const bool plain = std::all_of(runs.begin(), runs.end(), [&](const CaptureRun& other) {
    return other.scene == run.scene && (&other == &run || other.preset != run.preset);
  });
  return plain ? run.preset : run.scene + " / " + run.preset;
}

std::string frame_time_plot(const std::vector<CaptureRun>& runs) {
  constexpr double top = 14.0, bottom = 330.0;
  double first = 0.0, last = 0.0;
  bool any = false;
  for (const CaptureRun& run : runs)
    for (const CaptureFrame& frame : run.frames) {
      if (!std::isfinite(frame.time_s)) continue;
      first = any ? std::min(first, frame.time_s) : frame.time_s;
      last = any ? std::max(last, frame.time_s) : frame.time_s;
      any = true;
    }
  if (!any) return "<p>No frames.</p>\n";
  if (last - first < 1e-9) last = first + 1.0;
  const double most = top_ms(runs);
  const auto x_of = [&](double s) {
    return left_edge + (s - first) / (last - first) * (plot_width - left_edge - right_edge);
  };
  const auto y_of = [&](double ms) { return bottom - std::min(ms, most) / most * (bottom - top); };

  std::vector<Legend> entries;
  for (std::size_t i = 0; i < runs.size(); ++i) entries.push_back({run_label(runs[i], runs), colour(i)});
  std::string text =
      "<figure>" + open_svg(bottom + 44.0 + legend_height(entries), "Frame time of each run along the path");
  for (double ms = 0.0, step = round_step(most, 7); ms <= most; ms += step) {
    text += line(left_edge, y_of(ms), plot_width - right_edge, y_of(ms), "axis");
    text += text_at(left_edge - 8.0, y_of(ms) + 4.0, tick_text(ms, step), "end");
  }
  text += text_at(16.0, top + 4.0, "ms", "start");
  const double step_s = round_step(last - first, 10);
  for (double s = std::ceil(first / step_s) * step_s; s <= last + 1e-9; s += step_s)
    text += text_at(x_of(s), bottom + 18.0, tick_text(s, step_s) + " s", "middle");
  for (const int rate : display_rates_hz) {
    const double y = y_of(budget_ms(rate));
    text += line(left_edge, y, plot_width - right_edge, y, "budget");
  }
  // Labels of lines that lie close are spread out around their middle.
  constexpr double apart = 14.0;
  constexpr int count = static_cast<int>(std::size(display_rates_hz));
  const double middle = (y_of(budget_ms(72)) + y_of(budget_ms(120))) / 2.0;
  const bool crowded = y_of(budget_ms(80)) - y_of(budget_ms(72)) < apart;
  for (int i = 0; i < count; ++i) {
    const int rate = display_rates_hz[i];
    const double y = crowded ? std::min(middle + apart * (i - 0.5 * (count - 1)), bottom - apart * (count - 1 - i))
                             : y_of(budget_ms(rate));
    text += text_at(plot_width - right_edge + 6.0, y + 4.0, fmt::format("{} Hz {:.1f} ms", rate, budget_ms(rate)));
  }
  std::size_t past = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::vector<std::pair<double, double>> points;
    for (const CaptureFrame& frame : runs[i].frames) {
      const double ms = frame_ms(frame);
      if (!std::isfinite(ms) || !std::isfinite(frame.time_s)) continue;
      points.emplace_back(x_of(frame.time_s), y_of(ms));
      if (ms <= most) continue;
      if (++past <= 200)
        text += fmt::format(
            "<path d=\"M{:.1f} {:.1f}l5 -9h-10z\" style=\"fill:{}\" transform=\"rotate(180 {:.1f} "
            "{:.1f})\"><title>{:.1f} ms</title></path>\n",
            x_of(frame.time_s), top - 9.0, colour(i), x_of(frame.time_s), top - 9.0, ms);
    }
    if (points.size() == 1) {
      text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" style=\"fill:{}\"/>\n", points[0].first,
                          points[0].second, colour(i));
      continue;
    }
    text += "<polyline fill=\"none\" stroke-width=\"1.6\" stroke-linejoin=\"round\" style=\"stroke:" + colour(i) +
            "\" points=\"";
    for (const auto& [x, y] : thinned(points, 800)) fmt::format_to(std::back_inserter(text), "{:.1f},{:.1f} ", x, y);
    text += "\"/>\n";
  }
  text += legend(entries, bottom + 48.0) + "</svg>\n";
  if (past)
    text += fmt::format(
        "<figcaption>{} frames took longer than the scale shows; a mark at the top stands where.</figcaption>\n", past);
  return text + "</figure>\n";
}

std::string kept_svg(const CaptureRun& run) {
  if (!(run.kept_ms > 0.0) || run.frames.size() < 2 || !(run.frames.back().time_s > run.frames.front().time_s))
    return "";
  constexpr double top = 14.0, middle = 200.0, lower = 220.0, bottom = 330.0;
  const double first = run.frames.front().time_s, last = run.frames.back().time_s;
  double longest_ms = run.kept_ms;
  for (const CaptureFrame& frame : run.frames)
    if (const double ms = frame_ms(frame); std::isfinite(ms)) longest_ms = std::max(longest_ms, ms);
  const double most = std::min(1.2 * longest_ms, 4.0 * run.kept_ms);
  const auto x_of = [&](double s) {
    return left_edge + (s - first) / (last - first) * (plot_width - left_edge - right_edge);
  };
  const auto ms_at = [&](double ms) { return middle - std::clamp(ms, 0.0, most) / most * (middle - top); };
  const auto share_at = [&](double share) { return bottom - share * (bottom - lower); };
  const std::vector<Legend> entries{{"frame time", colour(0)}, {"picture scale", colour(1)}, {"quality", colour(2)}};
  std::string text = open_svg(bottom + 44.0 + legend_height(entries), "How the frame rate was held");
  for (double ms = 0.0, step = round_step(most, 5); ms <= most; ms += step) {
    text += line(left_edge, ms_at(ms), plot_width - right_edge, ms_at(ms), "axis");
    text += text_at(left_edge - 8.0, ms_at(ms) + 4.0, tick_text(ms, step), "end");
  }
  text += text_at(16.0, top + 4.0, "ms", "start");
  text += line(left_edge, ms_at(run.kept_ms), plot_width - right_edge, ms_at(run.kept_ms), "budget");
  text += text_at(plot_width - right_edge + 6.0, ms_at(run.kept_ms) + 4.0, fmt::format("{:.1f} ms", run.kept_ms));
  for (const double share : {0.0, 0.5, 1.0}) {
    text += line(left_edge, share_at(share), plot_width - right_edge, share_at(share), "axis");
    text += text_at(left_edge - 8.0, share_at(share) + 4.0, tick_text(share, 0.5), "end");
  }
  const double step_s = round_step(last - first, 10);
  for (double s = std::ceil(first / step_s) * step_s; s <= last + 1e-9; s += step_s)
    text += text_at(x_of(s), bottom + 18.0, tick_text(s, step_s) + " s", "middle");
  const auto curve = [&](std::size_t which, const auto& y_of) {
    std::vector<std::pair<double, double>> points;
    for (const CaptureFrame& frame : run.frames)
      if (const double y = y_of(frame); std::isfinite(y)) points.emplace_back(x_of(frame.time_s), y);
    text += "<polyline fill=\"none\" stroke-width=\"1.6\" stroke-linejoin=\"round\" style=\"stroke:" + colour(which) +
            "\" points=\"";
    for (const auto& [x, y] : thinned(points, 800)) fmt::format_to(std::back_inserter(text), "{:.1f},{:.1f} ", x, y);
    text += "\"/>\n";
  };
  curve(0, [&](const CaptureFrame& frame) { return ms_at(frame_ms(frame)); });
  curve(1, [&](const CaptureFrame& frame) { return share_at(frame.picture_scale); });
  curve(2, [&](const CaptureFrame& frame) { return share_at(frame.quality); });
  return text + legend(entries, bottom + 48.0) + "</svg>\n";
}

std::string named_time_plot(const std::vector<CaptureRun>& runs, const CaptureTimes& kind) {
  constexpr double row = 34.0, bar = 22.0, start = 130.0, end = 80.0;
  const std::vector<std::string> names = all_names(runs, kind);
  double most = 0.0;
  std::vector<double> totals;
  for (const CaptureRun& run : runs) {
    std::vector<double> whole;
    for (const CaptureFrame& frame : run.frames) whole.push_back(kind.whole_ms(run, frame));
    double parts = 0.0;
    for (const std::string& name : names) parts += mean_time_ms(run, kind, name);
    totals.push_back(std::max(summarise(whole).mean, parts));
    most = std::max(most, totals.back());
  }
  if (!(most > 0.0)) return fmt::format("<p>There are no {} times.</p>\n", kind.title);
  std::vector<Legend> entries;
  for (std::size_t i = 0; i < names.size(); ++i) entries.push_back({names[i], colour(i)});
  entries.push_back({kind.outside, "var(--line)"});
  const double bottom = row * static_cast<double>(runs.size()) + 8.0;
  std::string text = "<figure>" + open_svg(bottom + 34.0 + legend_height(entries),
                                           fmt::format("Mean {} time by name, stacked, for each run", kind.title));
  const auto length = [&](double ms) { return ms / most * (plot_width - start - end); };
  for (double ms = 0.0, step = round_step(most, 8); ms <= most * (1.0 + 1e-9); ms += step) {
    text += line(start + length(ms), 4.0, start + length(ms), bottom, "axis");
    text += text_at(start + length(ms), bottom + 16.0, tick_text(ms, step) + (ms == 0.0 ? " ms" : ""), "middle");
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double y = 8.0 + row * static_cast<double>(i);
    text += text_at(start - 8.0, y + 16.0, run_label(runs[i], runs), "end", false);
    double x = start, left = totals[i];
    const auto piece = [&](const std::string& name, double ms, const std::string& fill) {
      if (!(ms > 0.0)) return;
      text += fmt::format(
          "<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.0f}\" "
          "style=\"fill:{};stroke:var(--page);stroke-width:1\"><title>{}: {:.3f} ms, {:.1f} %</title></rect>\n",
          x, y, length(ms), bar, fill, html_escaped(name), ms, 100.0 * ms / totals[i]);
      x += length(ms);
      left -= ms;
    };
    for (std::size_t k = 0; k < names.size(); ++k) piece(names[k], mean_time_ms(runs[i], kind, names[k]), colour(k));
    if (left > 1e-6 * totals[i]) piece(kind.outside, left, "var(--line)");
    text += text_at(start + length(totals[i]) + 6.0, y + 16.0, fmt::format("{:.2f} ms", totals[i]));
  }
  return text + legend(entries, bottom + 40.0) +
         "</svg>\n<figcaption>Mean over the frames of each run; point at a piece for its "
         "figures.</figcaption></figure>\n";
}

std::string histogram_plot(const std::vector<CaptureRun>& runs) {
  constexpr int bins = 90;
  constexpr double row = 84.0, tall = 62.0, start = 130.0, end = 24.0, top = 18.0;
  const double most = top_ms(runs), width = (plot_width - start - end) / bins;
  const double bottom = top + row * static_cast<double>(runs.size());
  std::string text = "<figure>" + open_svg(bottom + 30.0, "Histogram of frame times for each run");
  const auto x_of = [&](double ms) { return start + ms / most * (plot_width - start - end); };
  for (const int rate : display_rates_hz) {
    text += line(x_of(budget_ms(rate)), top, x_of(budget_ms(rate)), bottom, "budget");
  }
  // The budgets lie close together where the scale is long; then only the outer two are named.
  const bool roomy = x_of(budget_ms(80)) - x_of(budget_ms(90)) > 40.0;
  for (const int rate : display_rates_hz)
    if (roomy || rate == 72 || rate == 120)
      text += text_at(x_of(budget_ms(rate)), top - 5.0, fmt::format("{} Hz", rate),
                      roomy        ? "middle"
                      : rate == 72 ? "start"
                                   : "end");
  for (double ms = 0.0, step = round_step(most, 10); ms <= most; ms += step)
    text += text_at(x_of(ms), bottom + 18.0, tick_text(ms, step) + (ms == 0.0 ? " ms" : ""), "middle");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double floor = top + row * static_cast<double>(i + 1);
    std::vector<std::size_t> counts(bins, 0);
    for (const double ms : frame_times_ms(runs[i]))
      if (std::isfinite(ms)) ++counts[static_cast<std::size_t>(std::clamp(ms / most * bins, 0.0, bins - 1.0))];
    const std::size_t highest = std::max<std::size_t>(1, *std::max_element(counts.begin(), counts.end()));
    text += line(start, floor, plot_width - end, floor, "axis");
    text += text_at(start - 8.0, floor - 6.0, run_label(runs[i], runs), "end", false);
    for (int bin = 0; bin < bins; ++bin) {
      const std::size_t count = counts[static_cast<std::size_t>(bin)];
      if (count == 0) continue;
      const double height = std::max(1.5, tall * static_cast<double>(count) / static_cast<double>(highest));
      text += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" style=\"fill:{}\"><title>{:.1f} to "
          "{:.1f} ms{}: {} frames</title></rect>\n",
          start + bin * width, floor - height, width - 1.0, height, colour(i), bin * most / bins,
          (bin + 1) * most / bins, bin == bins - 1 ? " and more" : "", count);
    }
  }
  return text +
         "</svg>\n<figcaption>Each row has a height of its own; the last bar also holds what is "
         "longer.</figcaption></figure>\n";
}

}  // namespace seascape
