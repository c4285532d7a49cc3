// Rivers, shores and lakes: bands along a curve, and what a closed one surrounds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/inputs/curve.h"
#include "ocean/inputs/input_source.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {

namespace {

// A place takes the values of the curve's nearest place, so they change at once where two parts of it are equally near,
// as across the inner side of a bend tighter than half the width.
class Spline final : public InputSource {
 public:
  Spline(const InputSpec& spec, const std::vector<SplinePoint>& points, bool closed, bool filled)
      : curve_(places(points), centripetal_knots(places(points), closed), closed),
        feather_m_(spec.feather_m),
        filled_(filled),
        along_(spec.to == InputTarget::flow && spec.blend != InputBlend::scale) {
    std::vector<double> knots;
    for (std::size_t i = 0; i <= curve_.spans(); ++i) knots.push_back(curve_.knot(i));
    std::vector<double> values(points.size());
    numbers_.resize(points.size());
    for (int n = 0; n < 5; ++n) {
      for (std::size_t i = 0; i < points.size(); ++i)
        values[i] = n == 4 ? 0.5 * points[i].width_m : double(plain_value(spec, points[i].value)[n]);
      const std::vector<double> slopes = monotone_slopes(values, knots, closed);
      for (std::size_t i = 0; i < points.size(); ++i)
        numbers_[i].value[n] = values[i], numbers_[i].slope[n] = slopes[i];
    }
    for (const SplinePoint& point : points) widest_m_ = filled ? 0.0 : std::max(widest_m_, 0.5 * point.width_m);

    std::vector<InputBounds> boxes;
    for (std::size_t span = 0; span < curve_.spans(); ++span) {
      const int count = curve_.chords(span, 0.004);
      for (int i = 0; i < count; ++i) {
        Chord chord{std::uint32_t(span), double(i) / count, double(i + 1) / count, {}, {}};
        chord.a = curve_.place(span, chord.u), chord.b = curve_.place(span, chord.v);
        off_m_ = std::max(off_m_, glm::length(glm::max(glm::abs(curve_.second(span, chord.u)),
                                                       glm::abs(curve_.second(span, chord.v)))) /
                                      (8.0 * count * count));
        chords_.push_back(chord);
        boxes.emplace_back();
        boxes.back().add(chord.a);
        boxes.back().add(chord.b);
      }
    }
    tree_ = BoundsTree(boxes);
    if (filled) radius_m_ = std::sqrt(surrounded_m2() / std::numbers::pi);
  }

  InputSample sample(glm::dvec2 place_m, double footprint_m, double) const override {
    const double reach = widest_m_ + soft_reach(feather_m_, footprint_m) + off_m_;
    const BoundsTree::Nearest found = tree_.nearest(
        place_m, filled_ ? 1e9 : reach, [&](std::uint32_t i) { return chord_distance2(chords_[i], place_m); });
    if (found.item < 0) return {};
    const Chord& chord = chords_[std::size_t(found.item)];
    const double u = nearest(chord, place_m);
    const std::size_t span = chord.span, next = (span + 1) % numbers_.size();
    const double h = curve_.knot(span + 1) - curve_.knot(span);
    const auto number = [&](int n) {
      return hermite(numbers_[span].value[n], numbers_[next].value[n], numbers_[span].slope[n] * h,
                     numbers_[next].slope[n] * h, u);
    };
    const glm::dvec2 at = curve_.place(span, u);
    const double distance = glm::distance(place_m, at);
    const double half = number(4),
                 inside = filled_ ? (within(place_m, at, distance) ? distance : -distance) : half - distance;
    const double factor =
        filled_ ? disc_factor(radius_m_, feather_m_, footprint_m) : band_factor(half, feather_m_, footprint_m);
    InputSample result{{float(number(0)), float(number(1)), float(number(2)), float(number(3))},
                       float(soft_share(inside, feather_m_, footprint_m) * factor)};
    if (along_) {
      const glm::dvec2 tangent = curve_.derivative(span, u);
      const double length = glm::length(tangent), speed = number(0);
      result.value = length > 0.0
                         ? glm::vec4(float(speed * tangent.x / length), float(speed * tangent.y / length), 0.0f, 0.0f)
                         : glm::vec4(0.0f);
    }
    return result;
  }

  InputBounds bounds() const override { return tree_.bounds().grown(widest_m_ + off_m_); }

 private:
  struct Chord {
    std::uint32_t span;
    double u, v;  // where it begins and ends on the span
    glm::dvec2 a, b;
  };
  struct Numbers {
    double value[5], slope[5];  // the value's channels and half the width; slopes by the knots' unit
  };

  static std::vector<glm::dvec2> places(const std::vector<SplinePoint>& points) {
    std::vector<glm::dvec2> result;
    for (const SplinePoint& point : points) result.push_back(point.at_m);
    return result;
  }
  static double along(const Chord& c, glm::dvec2 p) {
    const glm::dvec2 d = c.b - c.a;
    const double length2 = glm::dot(d, d);
    return length2 > 0.0 ? std::clamp(glm::dot(p - c.a, d) / length2, 0.0, 1.0) : 0.0;
  }
  static double chord_distance2(const Chord& c, glm::dvec2 p) {
    const glm::dvec2 off = c.a + (c.b - c.a) * along(c, p) - p;
    return glm::dot(off, off);
  }

  // From the chord's nearest place to the curve's, by Newton's steps for (P(u) - p) . P'(u) = 0.
  double nearest(const Chord& chord, glm::dvec2 p) const {
    double u = chord.u + (chord.v - chord.u) * along(chord, p);
    for (int i = 0; i < 4; ++i) {
      const glm::dvec2 off = curve_.place(chord.span, u) - p, d = curve_.derivative(chord.span, u);
      const double slope = glm::dot(d, d) + glm::dot(off, curve_.second(chord.span, u));
      if (!(slope > 0.0)) break;  // farther than the centre of the curve's bend
      const double before = u;
      u = std::clamp(u - glm::dot(off, d) / slope, 0.0, 1.0);
      if (std::abs(u - before) < 1e-9) break;
    }
    return u;
  }

  // The area of what within() says yes to. The sum over chords has it where the curve does not cross itself; of a
  // figure of eight it has the difference of the loops, and then rows of it are summed instead, crossing by crossing.
  double surrounded_m2() const {
    double sum = 0.0;
    glm::dvec2 low(1e300), high(-1e300);
    for (const Chord& c : chords_) {
      const glm::dvec2 a = c.a - chords_[0].a, b = c.b - chords_[0].a;
      sum += 0.5 * (a.x * b.y - b.x * a.y);
      low = glm::min(low, c.a), high = glm::max(high, c.a);
    }
    constexpr int rows = 256;
    const double step = (high.y - low.y) / rows;
    if (!(step > 0.0)) return std::abs(sum);
    std::vector<std::vector<double>> crossings(rows);
    for (const Chord& c : chords_) {
      const double from = (std::min(c.a.y, c.b.y) - low.y) / step, to = (std::max(c.a.y, c.b.y) - low.y) / step;
      for (int row = std::max(int(std::ceil(from - 0.5)), 0); row < rows && row + 0.5 < to; ++row)
        crossings[std::size_t(row)].push_back(c.a.x +
                                              (low.y + (row + 0.5) * step - c.a.y) / (c.b.y - c.a.y) * (c.b.x - c.a.x));
    }
    double by_rows = 0.0;
    for (std::vector<double>& row : crossings) {
      std::sort(row.begin(), row.end());
      for (std::size_t i = 0; i + 1 < row.size(); i += 2) by_rows += step * (row[i + 1] - row[i]);
    }
    return std::abs(sum) > 0.98 * by_rows && std::abs(sum) < 1.02 * by_rows ? std::abs(sum) : by_rows;
  }

  // Whether a closed curve surrounds a place: an odd number of chords between it and far away to +x. Where the chords
  // are no help, nearer to the curve than they are, a place farther off on the same side is asked.
  bool within(glm::dvec2 p, glm::dvec2 at, double distance) const {
    const double safe = 4.0 * off_m_;
    if (distance < safe && distance > 0.0) p = at + (p - at) * (safe / distance);
    bool odd = false;
    tree_.rightwards(p, [&](std::uint32_t i) {
      const Chord& c = chords_[i];
      if ((c.a.y > p.y) == (c.b.y > p.y)) return;
      if (c.a.x + (p.y - c.a.y) / (c.b.y - c.a.y) * (c.b.x - c.a.x) > p.x) odd = !odd;
    });
    return odd;
  }

  Curve curve_;
  double feather_m_;
  bool filled_, along_;
  double widest_m_ = 0.0;         // half the greatest width, of a filled one 0
  double radius_m_ = 0.0;         // of the disc that has the area of what a filled one surrounds
  double off_m_ = 0.0;            // no chord is farther from the curve
  std::vector<Numbers> numbers_;  // at the points
  std::vector<Chord> chords_;
  BoundsTree tree_;
};

}  // namespace

std::vector<SplinePoint> points_apart(const InputSpec& spec, std::vector<std::string>& remarks) {
  const SplineInput& spline = std::get<SplineInput>(spec.shape);
  // A millionth of a metre: knots are the roots of distances, summed up, and each has to be told from the one before.
  const auto at_one_place = [](const SplinePoint& a, const SplinePoint& b) {
    return glm::distance(a.at_m, b.at_m) < 1e-6;
  };
  std::vector<SplinePoint> points;
  for (const SplinePoint& point : spline.points)
    if (points.empty() || !at_one_place(points.back(), point)) points.push_back(point);
  if (spline.closed && points.size() > 1 && at_one_place(points.front(), points.back())) points.pop_back();
  const std::size_t least = spline.closed ? 3 : 2;
  if (points.size() < least) {
    remarks.push_back(
        fmt::format("{}: a {}spline of {} point{} at {} place{} gives nothing; give {} points or more that lie apart",
                    spec.where, spline.closed ? "closed " : "", spline.points.size(),
                    spline.points.size() == 1 ? "" : "s", points.size(), points.size() == 1 ? "" : "s", least));
    return {};
  }
  // The point that closes a curve, given once more, is no fault.
  const bool again = spline.closed && at_one_place(spline.points.front(), spline.points.back());
  if (const std::size_t lost = spline.points.size() - points.size() - (again ? 1 : 0); lost > 0)
    remarks.push_back(fmt::format("{}: {} of {} points lie{} where the one before does and {} left out", spec.where,
                                  lost, spline.points.size(), lost == 1 ? "s" : "", lost == 1 ? "is" : "are"));
  return points;
}

namespace {
// Whether no point lies a micrometre off the line from the first one to the one farthest from it.
bool on_one_line(const std::vector<SplinePoint>& points) {
  const glm::dvec2 from = points.front().at_m;
  const auto farther = [&](const SplinePoint& a, const SplinePoint& b) {
    return glm::distance(a.at_m, from) < glm::distance(b.at_m, from);
  };
  const glm::dvec2 along = glm::normalize(std::max_element(points.begin(), points.end(), farther)->at_m - from);
  return std::all_of(points.begin(), points.end(), [&](const SplinePoint& point) {
    const glm::dvec2 way = point.at_m - from;
    return std::abs(way.x * along.y - way.y * along.x) < 1e-6;
  });
}
}  // namespace

std::unique_ptr<const InputSource> make_spline(const InputSpec& spec, std::vector<std::string>& remarks) {
  const SplineInput& spline = std::get<SplineInput>(spec.shape);
  const std::vector<SplinePoint> points = points_apart(spec, remarks);
  if (points.empty()) return nullptr;
  if (spline.filled && on_one_line(points)) {
    remarks.push_back(
        fmt::format("{}: a filled spline whose points lie on one line surrounds nothing and gives nothing; "
                    "move one of them, or give \"filled\": false",
                    spec.where));
    return nullptr;
  }
  return std::make_unique<Spline>(spec, points, spline.closed, spline.filled);
}

}  // namespace seascape
