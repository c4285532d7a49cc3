#include "ocean/places/shore_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "ocean/inputs/input_source.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {

namespace {
constexpr double most_stretch = 1.4;  // by which a pattern's x is drawn out to close
constexpr double near_footprints = 3.0;

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

glm::dvec2 right_of(glm::dvec2 forward) { return {-forward.y, forward.x}; }

// Of a curve, to its right, 1/m.
double bend(const Curve& curve, std::size_t span, double u) {
  const glm::dvec2 d = curve.derivative(span, u);
  const double length2 = glm::dot(d, d);
  return length2 > 0.0 ? glm::dot(curve.second(span, u), right_of(d)) / (length2 * std::sqrt(length2)) : 0.0;
}

// The way along a span by the quadrature of Gauss and Legendre in five points (Abramowitz and Stegun 1964, 25.4.30).
double way(const Curve& curve, std::size_t span, double from, double to) {
  constexpr std::array<std::pair<double, double>, 3> nodes{
      {{0.0, 0.5688888888888889}, {0.5384693101056831, 0.4786286704993665}, {0.9061798459386640, 0.2369268850561891}}};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = nodes[0].second * glm::length(curve.derivative(span, middle));
  for (std::size_t i = 1; i < nodes.size(); ++i)
    for (const double side : {-half, half})
      sum += nodes[i].second * glm::length(curve.derivative(span, middle + side * nodes[i].first));
  return half * sum;
}
}  // namespace

ShoreLines::ShoreLines(std::span<const InputSpec> specs, double period_m) : period_m_(period_m) {
  for (const InputSpec& spec : specs) {
    if (spec.to != InputTarget::gerstner) continue;
    validate(spec);
    std::vector<std::string> told;  // by remarks_of()
    const std::vector<SplinePoint> points = points_apart(spec, told);
    if (!points.empty() && spec.weight > 0.0) add(spec, points);
  }
  std::vector<InputBounds> boxes;
  for (const Chord& chord : chords_) {
    boxes.emplace_back();
    boxes.back().add(vertices_[chord.from].at);
    boxes.back().add(vertices_[chord.from + 1].at);
  }
  tree_ = BoundsTree(boxes);
}

void ShoreLines::add(const InputSpec& spec, const std::vector<SplinePoint>& points) {
  const bool closed = std::get<SplineInput>(spec.shape).closed;
  std::vector<glm::dvec2> places;
  std::vector<double> halves, values;
  for (const SplinePoint& point : points) {
    places.push_back(point.at_m);
    halves.push_back(0.5 * point.width_m);
    values.push_back(double(point.value.x));
    widest_m_ = std::max(widest_m_, halves.back());
  }
  const std::vector<double> knots = centripetal_knots(places, closed);
  Line line{Curve(places, knots, closed), {}, spec.feather_m, spec.weight, 0.0, 1.0, closed};
  const std::vector<double> half_slopes = monotone_slopes(halves, knots, closed),
                            value_slopes = monotone_slopes(values, knots, closed);
  for (std::size_t i = 0; i < points.size(); ++i)
    line.numbers.push_back({halves[i], values[i], half_slopes[i], value_slopes[i]});
  feather_m_ = std::min(feather_m_, spec.feather_m);

  const Curve& curve = line.curve;
  const std::size_t first = chords_.size(), first_vertex = vertices_.size();
  const auto vertex = [&](std::size_t span, double u) {
    const glm::dvec2 d = curve.derivative(span, u);
    vertices_.push_back(
        {curve.place(span, u), glm::length(d) > 0.0 ? glm::normalize(d) : glm::dvec2(1.0, 0.0), line.length_m});
  };
  for (std::size_t span = 0; span < curve.spans(); ++span) {
    const int count = curve.chords(span, 0.004);
    for (int i = 0; i < count; ++i) {
      const Chord chord{std::uint32_t(lines_.size()),
                        std::uint32_t(span),
                        double(i) / count,
                        double(i + 1) / count,
                        std::uint32_t(vertices_.size()),
                        false,
                        false};
      vertex(span, chord.u);
      line.length_m += way(curve, span, chord.u, chord.v);
      off_m_ = std::max(
          off_m_, glm::length(glm::max(glm::abs(curve.second(span, chord.u)), glm::abs(curve.second(span, chord.v)))) /
                      (8.0 * count * count));
      chords_.push_back(chord);
    }
  }
  vertex(curve.spans() - 1, 1.0);
  if (closed) {
    vertices_.back().at = vertices_[first_vertex].at;
    vertices_.back().tangent = vertices_[first_vertex].tangent;
    double periods = std::round(line.length_m / period_m_);
    if (periods * period_m_ > most_stretch * line.length_m) --periods;
    line.scale = periods * period_m_ / line.length_m;
  } else {
    chords_[first].first = chords_.back().last = true;
  }
  // The most that the curve bends in a chord is known to both of its ends, so that what lies between them is never less
  // than the bend, and has no steps.
  for (std::size_t c = first; c < chords_.size(); ++c) {
    const Chord& chord = chords_[c];
    for (int i = 0; i <= 8; ++i) {
      const double k = bend(curve, chord.span, chord.u + (chord.v - chord.u) * i / 8.0);
      for (const std::size_t at : {std::size_t(chord.from), std::size_t(chord.from) + 1}) {
        vertices_[at].right = std::max(vertices_[at].right, k);
        vertices_[at].left = std::max(vertices_[at].left, -k);
      }
    }
  }
  if (closed) {
    Vertex &begin = vertices_[first_vertex], &end = vertices_.back();
    begin.left = end.left = std::max(begin.left, end.left);
    begin.right = end.right = std::max(begin.right, end.right);
  }
  lines_.push_back(std::move(line));
}

bool ShoreLines::foot(const Chord& chord, glm::dvec2 p, double footprint, Foot& foot) const {
  const Vertex &a = vertices_[chord.from], &b = vertices_[chord.from + 1];
  const double before = glm::dot(a.at - p, a.tangent), after = glm::dot(b.at - p, b.tangent);
  const Line& line = lines_[chord.line];
  double u = 0.0, past_m = 0.0, k = 0.0;
  glm::dvec2 at, forward;
  if (before < 0.0 && after >= 0.0) {
    // (P(u) - p) . P'(u) = 0 by Newton's steps, held within the chord by bisection.
    double low = chord.u, high = chord.v;
    u = low + (high - low) * before / (before - after);
    for (int i = 0; i < 24; ++i) {
      const glm::dvec2 off = line.curve.place(chord.span, u) - p, d = line.curve.derivative(chord.span, u);
      const double value = glm::dot(off, d), slope = glm::dot(d, d) + glm::dot(off, line.curve.second(chord.span, u));
      if (slope > 0.0 && std::abs(value) < 1e-13 * slope) break;
      (value < 0.0 ? low : high) = u;
      const double next = slope > 0.0 ? u - value / slope : low;
      u = next > low && next < high ? next : 0.5 * (low + high);
    }
    at = line.curve.place(chord.span, u);
    forward = glm::normalize(line.curve.derivative(chord.span, u));
    k = bend(line.curve, chord.span, u);
    foot.along_m = a.along_m + way(line.curve, chord.span, chord.u, u);
  } else if (chord.first && before >= 0.0) {  // an open curve goes straight on beyond its ends
    u = chord.u, at = a.at, forward = a.tangent, past_m = before, foot.along_m = -before;
  } else if (chord.last && after < 0.0) {
    u = chord.v, at = b.at, forward = b.tangent, past_m = -after, foot.along_m = line.length_m - after;
  } else {
    return false;
  }
  const std::size_t next = (chord.span + 1) % line.numbers.size();
  const Numbers &n = line.numbers[chord.span], &m = line.numbers[next];
  const double h = line.curve.knot(chord.span + 1) - line.curve.knot(chord.span);
  foot.half_m = hermite(n.half_m, m.half_m, n.half_slope * h, m.half_slope * h, u);
  foot.right_m = glm::dot(p - at, right_of(forward));
  const double across = std::abs(foot.right_m),
               to_end = past_m > 0.0 ? -past_m : std::min(foot.along_m, line.length_m - foot.along_m);
  const double part = (u - chord.u) / (chord.v - chord.u), left = a.left + part * (b.left - a.left),
               right = a.right + part * (b.right - a.right);
  double strength = line.weight * hermite(n.value, m.value, n.value_slope * h, m.value_slope * h, u);
  strength *= smoothstep(0.3, 1.0, 1.0 - (foot.right_m > 0.0 ? right : left) * across);
  if (!line.closed) strength *= soft_share(to_end, line.feather_m, footprint);
  const double share = strength * soft_share(foot.half_m - across, line.feather_m, footprint) *
                       band_factor(foot.half_m, line.feather_m, footprint);
  const double turned = std::max(1.0 - k * foot.right_m, 0.3);
  foot.strength = strength * std::max(1.0 - across / foot.half_m, 0.0);
  foot.beyond_m = std::max(across - foot.half_m, 0.0) + past_m;
  foot.place = {
      {line.scale * foot.along_m, foot.right_m}, float(share), float(line.scale / turned), forward, k / turned};
  return true;
}

ShorePlace ShoreLines::at(glm::dvec2 place, double footprint_m) const {
  if (chords_.empty() || !std::isfinite(place.x + place.y)) return {};
  const double footprint = footprint_m > 0.0 ? std::min(footprint_m, 1e7) : 0.0;
  const double reach = widest_m_ + off_m_ + near_footprints * footprint + 0.5 * footprint;
  Foot best;
  double second = 0.0;
  bool found = false;
  tree_.at(place, reach, [&](std::uint32_t i) {
    Foot one;
    if (!foot(chords_[i], place, footprint, one)) return;
    const bool better =
        !found || one.strength > best.strength || (one.strength == best.strength && one.beyond_m < best.beyond_m);
    second = std::max(second, better ? (found ? best.strength : 0.0) : one.strength);
    if (better) best = one;
    found = true;
  });
  if (!found) return {};
  if (second > 0.0) best.place.share *= float(1.0 - smoothstep(0.3, 0.8, second / best.strength));
  return best.place;
}

SourceStatistics ShoreLines::bent(SourceStatistics s) const {
  // The second derivative of a share times a wave, the share a smoothstep over the feather; and 1.25 for what bends
  // make of the wave, whose x they stretch by s where they leave smoothstep(0.3, 1, 1 / s) of it.
  const double feather = std::max(feather_m_, 1e-3), h = std::max(s.largest_height_m, s.largest_shift_m),
               c = 1.25 * s.largest_curvature_per_m;
  s.largest_curvature_per_m = c + 3.0 / feather * std::sqrt(h * c) + 6.0 * h / (feather * feather);
  return s;
}

}  // namespace seascape
