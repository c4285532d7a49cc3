// Trails: the discs that a moving thing leaves behind, all of them at once, for any time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ocean/inputs/curve.h"
#include "ocean/inputs/input_source.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {

namespace {

// A disc is left at every moment, not so many a second: the trail is the largest share of any. A function of the time
// alone, at any frame rate and whichever way the time runs.
class Trail final : public InputSource {
 public:
  Trail(const InputSpec& spec, const TrailInput& trail)
      : trail_(trail),
        feather_m_(spec.feather_m),
        value_(plain_value(spec, spec.value)),
        widest_m_(trail.radius_m + trail.spread_mps * trail.life_s) {
    std::vector<glm::dvec2> places;
    std::vector<double> times;
    for (const TrailKey& key : trail.keys) places.push_back(key.at_m), times.push_back(key.time_s);
    period_s_ = times.back() - times.front();
    const bool closed = trail.loop && places.size() > 3;
    if (closed) places.pop_back();
    const Curve curve(places, times, closed);
    std::vector<InputBounds> boxes;
    for (std::size_t span = 0; span < curve.spans(); ++span) {
      const int count = curve.chords(span, 1e-3);
      for (int i = 0; i < count; ++i) {
        const double u = double(i) / count, v = double(i + 1) / count, from = curve.knot(span),
                     to = curve.knot(span + 1);
        const Piece piece{from + (to - from) * u, i + 1 == count ? to : from + (to - from) * v, curve.place(span, u),
                          curve.place(span, v)};
        pieces_.push_back(piece);
        boxes.emplace_back();
        boxes.back().add(piece.a);
        boxes.back().add(piece.b);
      }
    }
    tree_ = BoundsTree(boxes);
  }

  InputSample sample(glm::dvec2 place_m, double footprint_m, double time_s) const override {
    double share = 0.0;
    // By whole turns of a loop nearer to its keys, so that passes are told apart however late it is.
    if (trail_.loop) time_s = trail_.keys.front().time_s + std::fmod(time_s - trail_.keys.front().time_s, period_s_);
    tree_.at(place_m, widest_m_ + soft_reach(feather_m_, footprint_m), [&](std::uint32_t i) {
      const Piece& piece = pieces_[i];
      // The newest pass that has begun, and those before it that have not yet faded.
      const double passes = trail_.loop ? std::floor((time_s - piece.from) / period_s_) : 0.0;
      for (double pass = passes;; pass -= 1.0) {
        const double later = pass * period_s_, from = std::max(piece.from + later, time_s - trail_.life_s),
                     to = std::min(piece.to + later, time_s);
        if (!(piece.to + later > time_s - trail_.life_s)) break;
        if (from <= to)
          share = std::max(share, left_by(piece, from - later, to - later, time_s - later, place_m, footprint_m));
        if (!trail_.loop) break;
      }
    });
    return {value_, float(share)};
  }

  InputBounds bounds() const override { return tree_.bounds().grown(widest_m_); }
  bool still() const override { return false; }

 private:
  struct Piece {
    double from, to;  // s
    glm::dvec2 a, b;
  };

  // The largest share of the discs that were left on a piece between two times: of share(radius - distance) x fade.
  // With time the fade is linear, the radius is, and the distance is convex, so that the product's logarithm is concave
  // and has one maximum.
  double left_by(const Piece& piece, double from, double to, double now, glm::dvec2 p, double footprint_m) const {
    from -= piece.from, to -= piece.from, now -= piece.from;  // small numbers, however late it is
    const glm::dvec2 velocity = (piece.b - piece.a) / (piece.to - piece.from),
                     off = piece.a - p;  // at time s: off + velocity s
    const double radius = trail_.radius_m + trail_.spread_mps * now,
                 spread = trail_.spread_mps;  // at time s: radius - spread s
    // Only discs that reach here: |off + velocity s| <= radius + reach - spread s.
    const double reach = radius + soft_reach(feather_m_, footprint_m),
                 a = glm::dot(velocity, velocity) - spread * spread, b = glm::dot(off, velocity) + reach * spread,
                 c = glm::dot(off, off) - reach * reach;
    if (std::abs(a) > 1e-12) {
      const double inside = b * b - a * c;
      if (!(inside >= 0.0)) {
        if (a > 0.0) return 0.0;
      } else {
        const double root = std::sqrt(inside), low = (-b - root) / a, high = (-b + root) / a;
        if (a > 0.0) {
          from = std::max(from, low), to = std::min(to, high);
        } else {
          to = std::min(to, high);  // discs widen faster than the thing moves: all old enough ones reach here
        }
      }
    } else if (std::abs(b) > 1e-12) {
      b > 0.0 ? to = std::min(to, -0.5 * c / b) : from = std::max(from, -0.5 * c / b);
    } else if (c > 0.0) {
      return 0.0;
    }
    if (from > to) return 0.0;

    const double width = std::max(feather_m_, footprint_m);
    const auto rises = [&](double s) {  // the sign of the logarithm's slope
      const glm::dvec2 to_disc = off + velocity * s;
      const double distance = glm::length(to_disc),
                   u = 0.5 + (radius - spread * s - distance - 0.5 * feather_m_) / width;
      if (u >= 1.0) return true;
      if (u <= 0.0) return (distance > 0.0 ? glm::dot(to_disc, velocity) / distance : 0.0) + spread < 0.0;
      const double by_u = 6.0 * (1.0 - u) / (u * (3.0 - 2.0 * u)),
                   u_slope = (-spread - (distance > 0.0 ? glm::dot(to_disc, velocity) / distance : 0.0)) / width;
      return by_u * u_slope + 1.0 / std::max(trail_.life_s - (now - s), 1e-9) > 0.0;
    };
    double best = to;
    if (width > 0.0 && !rises(to)) {
      double low = from, high = to;
      for (int i = 0; i < 24; ++i) {
        const double middle = 0.5 * (low + high);
        (rises(middle) ? low : high) = middle;
      }
      best = low;
    }
    const double here = radius - spread * best,
                 share = width > 0.0 ? soft_share(here - glm::length(off + velocity * best), feather_m_, footprint_m)
                                     : 1.0;  // of sharp discs the last that reaches here
    return share * band_factor(here, feather_m_, footprint_m) *
           std::clamp(1.0 - (now - best) / trail_.life_s, 0.0, 1.0);
  }

  TrailInput trail_;
  double feather_m_;
  glm::vec4 value_;
  double widest_m_, period_s_ = 0.0;
  std::vector<Piece> pieces_;
  BoundsTree tree_;
};

}  // namespace

std::unique_ptr<const InputSource> make_trail(const InputSpec& spec, std::vector<std::string>& remarks) {
  const TrailInput& trail = std::get<TrailInput>(spec.shape);
  if (trail.keys.size() < 2) {
    remarks.push_back(fmt::format("{}: a trail of {} gives nothing; give it 2 keys or more", spec.where,
                                  trail.keys.empty() ? "no keys" : "1 key"));
    return nullptr;
  }
  return std::make_unique<Trail>(spec, trail);
}

}  // namespace seascape
