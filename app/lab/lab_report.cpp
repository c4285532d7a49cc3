#include "app/lab/lab_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/lab/pareto.h"
#include "app/quality.h"
#include "app/svg.h"

namespace seascape {

namespace {

std::vector<LabPoint> chosen(const std::vector<LabPoint>& points, const std::string& curve, const std::string& unit,
                             const std::string& sea = "") {
  std::vector<LabPoint> some;
  for (const LabPoint& p : points)
    if (p.curve == curve && p.error.unit == unit && (sea.empty() || p.sea == sea)) some.push_back(p);
  return some;
}

template <class Of>
std::vector<std::string> in_order(const std::vector<LabPoint>& points, const Of& of) {
  std::vector<std::string> names;
  for (const LabPoint& p : points)
    if (std::find(names.begin(), names.end(), of(p)) == names.end()) names.push_back(of(p));
  return names;
}
std::vector<std::string> seas_of(const std::vector<LabPoint>& points) {
  return in_order(points, [](const LabPoint& p) { return p.sea; });
}
std::vector<std::string> knobs_of(const std::vector<LabPoint>& points) {
  return in_order(points, [](const LabPoint& p) { return p.knob; });
}

std::vector<Tradeoff> tradeoffs(const std::vector<LabPoint>& points) {
  std::vector<Tradeoff> all;
  for (const LabPoint& p : points) all.push_back({p.time_us.median, p.error.value});
  return all;
}

// Three figures, as they are said; whole numbers below 10,000 whole.
std::string figure(double value) {
  return std::abs(value) < 1e4 && value == std::round(value) ? fmt::format("{:.0f}", value)
                                                             : fmt::format("{:.3g}", value);
}
std::string time_text(double us) {
  return us < 1.0   ? figure(1e3 * us) + " ns"
         : us < 1e3 ? figure(us) + " us"
         : us < 1e6 ? figure(1e-3 * us) + " ms"
                    : figure(1e-6 * us) + " s";
}

struct Scale {
  double from = 0.0, to = 1.0, start = 0.0, end = 1.0;  // decimal logarithms; the picture's units
  double operator()(double value) const { return start + (std::log10(value) - from) / (to - from) * (end - start); }
};
Scale scale_of(double least, double most, double start, double end) {
  const double margin = std::max(0.06 * std::log10(most / least), 0.08);
  return {std::log10(least) - margin, std::log10(most) + margin, start, end};
}

std::string axes(const Scale& x, const Scale& y, bool labels) {
  std::string text;
  const auto ticks = [](const Scale& s) {
    std::vector<double> marks;
    const bool narrow = s.to - s.from < 2.2;
    for (int power = int(std::floor(s.from)); power <= int(std::ceil(s.to)); ++power)
      for (const double m : s.to - s.from < 0.9 ? std::vector<double>{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0}
                            : narrow            ? std::vector<double>{1.0, 2.0, 5.0}
                                                : std::vector<double>{1.0})
        if (const double at = power + std::log10(m); at >= s.from && at <= s.to)
          marks.push_back(m * std::pow(10.0, power));
    const std::size_t every = marks.size() / 6 + 1;  // no more than that have room
    std::vector<double> some;
    for (std::size_t i = 0; i < marks.size(); i += every) some.push_back(marks[i]);
    return some;
  };
  for (const double mark : ticks(x)) {
    text += line(x(mark), y.start, x(mark), y.end, "axis");
    text += text_at(x(mark), y.start + 16.0, time_text(mark), "middle");
  }
  for (const double mark : ticks(y)) {
    text += line(x.start, y(mark), x.end, y(mark), "axis");
    if (labels) text += text_at(x.start - 6.0, y(mark) + 4.0, figure(mark), "end");
  }
  return text;
}

struct PresetLabel {
  double from, to, y;
};
// The first height, from `y` upwards, at which a label covers none of `labels`; adds it to them.
double free_height(std::vector<PresetLabel>& labels, const std::string& name, double x, double y, bool ends_there) {
  constexpr double letter = 7.5, row = 14.0;  // wide and high, at the most
  const double wide = letter * double(name.size()), from = ends_there ? x - wide : x;
  const auto taken = [&](const PresetLabel& l) {
    return l.from < from + wide && from < l.to && std::abs(l.y - y) < row - 1e-9;
  };
  while (std::any_of(labels.begin(), labels.end(), taken)) y -= row;
  labels.push_back({from, from + wide, y});
  return y;
}

std::string panel(const std::vector<LabPoint>& points, const std::vector<std::string>& knobs, const Scale& x,
                  const Scale& y) {
  std::string text;
  std::vector<PresetLabel> labels;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    std::string way;
    for (const LabPoint& p : points)
      if (p.knob == knobs[k]) way += fmt::format("{:.1f},{:.1f} ", x(p.time_us.median), y(p.error.value));
    if (!knobs[k].starts_with("random"))
      text += fmt::format("<polyline fill=\"none\" stroke-width=\"1.4\" style=\"stroke:{}\" points=\"{}\"/>\n",
                          colour(k), way);
  }
  const std::vector<std::size_t> front = pareto_front(tradeoffs(points));
  std::string edge;
  for (const std::size_t i : front)
    edge += fmt::format("{:.1f},{:.1f} ", x(points[i].time_us.median), y(points[i].error.value));
  text += fmt::format("<polyline fill=\"none\" class=\"budget\" points=\"{}\"/>\n", edge);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LabPoint& p = points[i];
    const double px = x(p.time_us.median), py = y(p.error.value);
    const std::size_t k = std::size_t(std::find(knobs.begin(), knobs.end(), p.knob) - knobs.begin());
    text += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke-width=\"1\" opacity=\"0.5\" "
        "style=\"stroke:{}\"/>\n",
        x(std::max(p.time_us.p5, 1e-9)), py, x(std::max(p.time_us.p95, 1e-9)), py, colour(k));
    text += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" style=\"fill:{}\"><title>{} {}{}: {}, {} {}</title></circle>\n",
        px, py, p.preset.empty() ? "3" : "5", colour(k), html_escaped(p.knob), figure(p.value),
        p.preset.empty() ? "" : " (" + html_escaped(p.preset) + ")", time_text(p.time_us.median), figure(p.error.value),
        html_escaped(p.error.unit));
    if (std::find(front.begin(), front.end(), i) != front.end())
      text += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"none\" stroke-width=\"1.2\" "
          "style=\"stroke:var(--ink)\"/>\n",
          px, py);
    const bool to_left = px > x.end - 70.0;
    if (!p.preset.empty()) {
      const double edge_x = px + (to_left ? -10.0 : 10.0);
      text += text_at(edge_x, free_height(labels, p.preset, edge_x, py - 7.0, to_left), p.preset,
                      to_left ? "end" : "start", false);
    } else if (!p.knob.starts_with("random"))
      text += text_at(px + (px > x.end - 28.0 ? -6.0 : 6.0), py + 13.0, figure(p.value),
                      px > x.end - 28.0 ? "end" : "start");
  }
  return text;
}

}  // namespace

std::vector<std::string> error_units(const std::string& curve, const std::vector<LabPoint>& points) {
  std::vector<LabPoint> own;
  for (const LabPoint& p : points)
    if (p.curve == curve) own.push_back(p);
  return in_order(own, [](const LabPoint& p) { return p.error.unit; });
}

std::string curve_plot(const LabCurve& curve, const std::vector<LabPoint>& all, const std::string& unit) {
  std::vector<LabPoint> points = chosen(all, curve.name, unit);
  // A logarithm has no place for 0: what is exact is drawn at a tenth of the least that is not.
  double least = 1e300, most = 0.0, quickest = 1e300, slowest = 0.0;
  for (const LabPoint& p : points) {
    if (p.error.value > 0.0) least = std::min(least, p.error.value);
    quickest = std::min(quickest, std::max(p.time_us.p5, 1e-6)), slowest = std::max(slowest, p.time_us.p95);
  }
  if (points.empty() || !(slowest > 0.0)) return "<p>Not measured.</p>\n";
  if (least > 1e299) least = 1.0;
  for (LabPoint& p : points) {
    if (!(p.error.value > 0.0)) p.error.value = 0.1 * least;
    p.time_us.median = std::max(p.time_us.median, 1e-6);
    most = std::max(most, p.error.value);
  }
  for (const LabPoint& p : points) least = std::min(least, p.error.value);
  const std::vector<std::string> seas = seas_of(points), knobs = knobs_of(points);
  constexpr double top = 34.0, bottom = 330.0, left = 74.0, gap = 24.0;
  const double wide = (plot_width - left - 8.0 - gap * double(seas.size() - 1)) / double(seas.size());
  std::vector<Legend> entries;
  for (std::size_t k = 0; k < knobs.size(); ++k) entries.push_back({knobs[k], colour(k)});
  std::string text = "<figure>" + open_svg(bottom + 46.0 + legend_height(entries), curve.title + ": error over time");
  const Scale y = scale_of(least, most, bottom, top);
  text += text_at(8.0, 14.0, (error_units(curve.name, all).front() == unit ? "error, " : "") + unit,
                  "start");  // the others may be measures of other kinds
  for (std::size_t s = 0; s < seas.size(); ++s) {
    const double start = left + double(s) * (wide + gap);
    const Scale x = scale_of(quickest, slowest, start, start + wide);
    text += axes(x, y, s == 0);
    text += text_at(start + 0.5 * wide, top - 6.0,
                    seas[s] == "none" ? "time of " + curve.time_of : seas[s] + " m/s, time of " + curve.time_of,
                    "middle", false);
    text += panel(chosen(points, curve.name, unit, seas[s]), knobs, x, y);
  }
  return text + legend(entries, bottom + 50.0) + "</svg></figure>\n";
}

std::map<std::string, double> presets_off_front(const LabCurve& curve, const std::vector<LabPoint>& points) {
  std::map<std::string, double> off;
  const std::vector<std::string> units = error_units(curve.name, points);
  if (units.empty()) return off;
  for (const std::string& sea : seas_of(chosen(points, curve.name, units[0]))) {
    const std::vector<LabPoint> here = chosen(points, curve.name, units[0], sea);
    std::vector<Tradeoff> others;  // settings that are no preset's
    for (const LabPoint& p : here)
      if (p.preset.empty() && p.knob.starts_with(curve.rivals)) others.push_back({p.time_us.median, p.error.value});
    for (const LabPoint& p : here) {
      std::istringstream names(p.preset);
      for (std::string name; names >> name;)
        off[name] =
            std::max(off.contains(name) ? off[name] : 1.0, off_front({p.time_us.median, p.error.value}, others));
    }
  }
  return off;
}

std::string conclusion(const LabCurve& curve, const std::vector<LabPoint>& points) {
  const std::vector<std::string> units = error_units(curve.name, points);
  if (units.empty()) return curve.title + " was not measured.";
  const std::vector<LabPoint> own = chosen(points, curve.name, units[0]);
  std::string text;
  const std::vector<std::string> seas = seas_of(own);
  const std::string sea = seas.size() > 1 ? seas[1] : seas[0];
  const std::vector<LabPoint> here = chosen(own, curve.name, units[0], sea);
  const std::vector<std::size_t> front = pareto_front(tradeoffs(here));
  const LabPoint &quick = here[front.front()], &exact = here[front.back()];
  const auto said = [](const LabPoint& p) {
    return fmt::format("{} {}", p.knob, figure(p.value)) + (p.preset.empty() ? "" : " (" + p.preset + ")");
  };
  const std::string at = sea == "none" ? "" : " at " + sea + " m/s";
  text += fmt::format("{}{}: {} takes {} for {} and misses {} {}", curve.title, at, said(quick),
                      time_text(quick.time_us.median), curve.time_of, figure(quick.error.value), quick.error.unit);
  if (&quick != &exact)
    text +=
        fmt::format("; {} takes {} times as long and misses {}", said(exact),
                    figure(exact.time_us.median / quick.time_us.median), figure(exact.error.value)) +
        (exact.error.value > 0.0 ? fmt::format(", {} times less", figure(quick.error.value / exact.error.value)) : "");
  text += ".";
  for (const LabLaw& law : curve.laws) {
    const double power = fitted_power(law, points_of(points, curve.name), sea);
    if (!std::isfinite(power)) continue;
    text += law.steps
                ? fmt::format(" {}: each step leaves {} of the error (theory: {}; {}).", law.knob, figure(power),
                              figure(stated_power(law, points_of(points, curve.name), sea)), law.why)
                : fmt::format(" {}: the error goes with the power {} of it (theory {}: {}).", law.knob, figure(power),
                              figure(stated_power(law, points_of(points, curve.name), sea)), law.why);
  }
  // Presets that are as far off stand in one sentence.
  const std::map<std::string, double> off = presets_off_front(curve, points);
  std::vector<std::string> said_of;
  for (const std::string_view preset : preset_names()) {
    const auto found = off.find(std::string(preset));
    if (found == off.end() || std::find(said_of.begin(), said_of.end(), found->first) != said_of.end()) continue;
    std::string names;
    for (const std::string_view other : preset_names())
      if (const auto same = off.find(std::string(other)); same != off.end() && same->second == found->second) {
        names += (names.empty() ? "" : ", ") + same->first;
        said_of.push_back(same->first);
      }
    const double per_cent = 100.0 * (found->second - 1.0);
    text += per_cent < 0.5 ? fmt::format(" On the front: {}.", names)
                           : fmt::format(" Take {:.0f} % more time than what errs no more: {}.", per_cent, names);
  }
  if (!off.empty() && !curve.why_rivals.empty()) text += " " + curve.why_rivals;
  return text;
}

std::vector<LabPoint> points_of(const std::vector<LabPoint>& points, const std::string& curve) {
  std::vector<LabPoint> own;
  for (const LabPoint& p : points)
    if (p.curve == curve) own.push_back(p);
  return own;
}

std::vector<LabPoint> recommended(const std::vector<LabPoint>& points, double budget_us, const std::string& sea) {
  const std::vector<std::string> units = error_units("frame", points);
  if (units.empty()) return {};
  const std::vector<LabPoint> here = chosen(points, "frame", units[0], sea);
  std::vector<LabPoint> within;
  for (const std::size_t i : pareto_front(tradeoffs(here)))
    if (here[i].time_us.median <= budget_us) within.push_back(here[i]);
  std::reverse(within.begin(), within.end());
  return within;
}

std::string lab_html(const std::vector<LabCurve>& curves, const std::vector<LabPoint>& points,
                     const LabOrigin& origin) {
  std::string text = page_head("Seascape lab: what accuracy costs in time");
  if (software(origin.machine))
    text +=
        "<p class=\"note\">The device draws in software on the processor: times of whole frames and of compute shaders "
        "say nothing about a graphics card.</p>\n";
  text += "<dl>" + machine_rows(origin.machine) +
          list_row("Counts", origin.quick ? "quick: fewer settings and rounds" : "full") + "</dl>\n";
  text +=
      "<p>Each point is one setting: its time is the median of interleaved runs, the thin line through it reaches from "
      "the 5th to the 95th percentile. Ringed points are the front: no other is both "
      "faster and more exact. Point at one for its figures.</p>\n";
  for (const LabCurve& curve : curves) {
    const std::vector<std::string> units = error_units(curve.name, points);
    if (units.empty()) continue;
    text += fmt::format("<h2 id=\"{}\">{}</h2>\n<p class=\"verdict\">{}</p>\n", html_escaped(curve.name),
                        html_escaped(curve.title), html_escaped(conclusion(curve, points)));
    for (const std::string& unit : units)
      if (std::none_of(curve.laws.begin(), curve.laws.end(), [&](const LabLaw& law) { return law.predicted == unit; }))
        text += curve_plot(curve, points, unit);
  }
  return text + page_end;
}

std::string lab_table(const std::vector<LabCurve>& curves, const std::vector<LabPoint>& points) {
  std::string text = fmt::format("{:<10} {:<5} {:>10} {:>11} {:>10} {:>11}  {}\n", "curve", "sea", "quickest", "error",
                                 "exactest", "error", "presets off the front");
  for (const LabCurve& curve : curves) {
    const std::vector<std::string> units = error_units(curve.name, points);
    if (units.empty()) continue;
    std::string off;
    for (const auto& [preset, factor] : presets_off_front(curve, points))
      off += fmt::format("{}{} {:.0f} %", off.empty() ? "" : ", ", preset, 100.0 * (factor - 1.0));
    for (const std::string& sea : seas_of(chosen(points, curve.name, units[0]))) {
      const std::vector<LabPoint> here = chosen(points, curve.name, units[0], sea);
      const std::vector<std::size_t> front = pareto_front(tradeoffs(here));
      const LabPoint &quick = here[front.front()], &exact = here[front.back()];
      text += fmt::format("{:<10} {:<5} {:>10} {:>11} {:>10} {:>11}  {}\n", curve.name, sea,
                          time_text(quick.time_us.median), figure(quick.error.value), time_text(exact.time_us.median),
                          figure(exact.error.value), off);
      off.clear();
    }
  }
  return text;
}

}  // namespace seascape
