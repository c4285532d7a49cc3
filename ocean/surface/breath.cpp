#include "ocean/surface/breath.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/split_mix.h"

namespace seascape {

namespace {

constexpr double gravity = 9.81, density = 1025.0, tension_n_m = 0.0735;  // of sea water
constexpr double air_m = 10.08;        // of sea water, that weigh as much as the air above it
constexpr double breathes_out = 0.3;   // share of a breath's time
constexpr double least_deep_m = 0.15;  // of a mouth that breathes into the water
constexpr double leaves_m = 1.0;       // above the water over the head: no wave there hides a bubble any more
const glm::dvec3 mouth_m(0.0, -0.09, -0.09), cheek_m(0.06, 0.0, 0.0);  // from between the eyes; where bubbles leave it

// Numbers of their own for a seed, a breath and a bubble.
class Chance {
 public:
  Chance(std::uint32_t seed, std::int64_t breath, std::uint64_t bubble)
      : key_(split_mix(split_mix(seed + split_mix_step) ^ split_mix(std::uint64_t(breath) + 2 * split_mix_step)) ^
             split_mix(bubble + 3 * split_mix_step)) {}
  double next() { return share_of(split_mix(key_ += split_mix_step)); }

 private:
  std::uint64_t key_;
};

double sphere_m3(double diameter_m) { return std::numbers::pi / 6.0 * diameter_m * diameter_m * diameter_m; }

// Diameters are even in their logarithm: many small ones, and most of the air in few large ones.
double diameter_at(double share) { return Breath::least_m * std::pow(Breath::largest_m / Breath::least_m, share); }

// Of a breath of that many litres. The mean volume of such diameters: integral of d^3 over their logarithm.
std::size_t bubbles_of(double litres) {
  const double mean_m3 = (sphere_m3(Breath::largest_m) - sphere_m3(Breath::least_m)) /
                         (3.0 * std::log(Breath::largest_m / Breath::least_m));
  return std::size_t(std::clamp(std::round(1e-3 * litres / mean_m3), 1.0, 400.0));
}

}  // namespace

double bubble_rises_mps(double diameter_m) {
  return std::sqrt(2.0 * tension_n_m / (density * diameter_m) + 0.5 * gravity * diameter_m);
}

double bubble_flatness(double diameter_m) {
  const double eotvos = gravity * density * diameter_m * diameter_m / tension_n_m;
  return 1.0 / (1.0 + 0.163 * std::pow(eotvos, 0.757));
}

double bubble_grows(double from_m, double to_m) {
  return std::cbrt((air_m + std::max(from_m, 0.0)) / (air_m + std::max(to_m, 0.0)));
}

Breath::Breath(const BreathSettings& settings) : settings_(settings) { bubbles_.reserve(most); }

void Breath::begin_anew() {
  bubbles_.clear();
  before_.reset();
}

void Breath::advance(double time_s, const Pose& head, std::optional<double> water_m) {
  const Moment now{time_s, head, water_m};
  if (before_ && (time_s < before_->time_s || time_s > before_->time_s + longest_gap_s)) begin_anew();
  if (!before_) tick_ = std::int64_t(std::floor(time_s / step_s));
  if (!before_) before_ = now;
  const std::int64_t last = std::int64_t(std::floor(time_s / step_s));
  while (tick_ < last) {
    ++tick_;
    const double at_s = double(tick_) * step_s, span_s = time_s - before_->time_s,
                 share = span_s > 0.0 ? std::clamp((at_s - before_->time_s) / span_s, 0.0, 1.0) : 1.0;
    Moment at{at_s, {}, std::nullopt};
    at.head.position_m = glm::mix(before_->head.position_m, head.position_m, share);
    at.head.orientation = glm::slerp(before_->head.orientation, head.orientation, share);
    if (water_m && before_->water_m) at.water_m = glm::mix(*before_->water_m, *water_m, share);
    step(tick_, at);
  }
  before_ = now;
}

void Breath::step(std::int64_t tick, const Moment& now) {
  if (now.water_m) water_m_ = *now.water_m;
  for (Bubble& bubble : bubbles_) {
    // By the middle of the step (Runge and Kutta's second order).
    const auto diameter = [&](double y) { return bubble.born_m * bubble_grows(bubble.from_m, water_m_ - y); };
    const double half_way = bubble.at_m.y + 0.5 * step_s * bubble_rises_mps(bubble.diameter_m);
    bubble.at_m.y += step_s * bubble_rises_mps(diameter(half_way));
    bubble.diameter_m = diameter(bubble.at_m.y);
  }
  std::erase_if(bubbles_, [&](const Bubble& bubble) { return bubble.at_m.y > water_m_ + leaves_m; });
  if (settings_.on) breathe_out(double(tick - 1) * step_s, double(tick) * step_s, now);
}

void Breath::breathe_out(double from_s, double to_s, const Moment& now) {
  if (!now.water_m) return;
  const double every_s = settings_.every_s, lasts_s = breathes_out * every_s;
  const std::size_t count = bubbles_of(settings_.litres);
  const std::int64_t first = std::int64_t(std::floor((from_s - lasts_s) / every_s)),
                     last = std::int64_t(std::floor(to_s / every_s));
  for (std::int64_t breath = first; breath <= last; ++breath) {
    const double begins_s = double(breath) * every_s;
    for (std::size_t n = 0; n < count; ++n) {
      const double born_s = begins_s + lasts_s * (double(n) + 0.5) / double(count);
      if (born_s <= from_s || born_s > to_s) continue;
      Chance chance(settings_.seed, breath, n);
      const double side = chance.next() < 0.5 ? -1.0 : 1.0, diameter_m = diameter_at(chance.next());
      const glm::dvec3 off(chance.next() - 0.5, chance.next() - 0.5, chance.next() - 0.5);
      const glm::dvec3 at_m = now.head.position_m + now.head.orientation * (mouth_m + side * cheek_m + 0.03 * off);
      const double deep_m = *now.water_m - at_m.y;
      if (deep_m < least_deep_m) continue;
      if (bubbles_.size() == most) bubbles_.erase(bubbles_.begin());
      bubbles_.push_back({at_m, diameter_m, diameter_m, deep_m, born_s, chance.next()});
    }
  }
}

std::size_t Breath::drawn(const glm::dvec3& viewer_m, std::span<gpu::BubbleInstance> list) const {
  if (!before_) return 0;
  const std::size_t count = std::min(bubbles_.size(), list.size());
  const double since_s = before_->time_s - double(tick_) * step_s;  // the last step
  for (std::size_t n = 0; n < count; ++n) {
    const Bubble& bubble = bubbles_[n];
    const double d = bubble.diameter_m, flat = bubble_flatness(d);
    // Small ones wind about their way, by as much as they are wide, some turns a second (Clift, Grace and Weber 1978,
    // section 7.III); caps only wobble.
    const double aged_s = before_->time_s - bubble.born_s, winds_m = d < 0.012 ? 0.8 * d : 0.0,
                 turn = 2.0 * std::numbers::pi * (bubble.turn + aged_s * (d < 0.012 ? 6.0 : 3.0));
    glm::dvec3 at = bubble.at_m - viewer_m;
    at += winds_m * std::min(1.0, 2.0 * aged_s) * glm::dvec3(std::cos(turn), 0.0, std::sin(turn));
    const double y = bubble.at_m.y + since_s * bubble_rises_mps(d);
    list[n].place = glm::vec4(float(at.x), float(y), float(at.z), float(0.5 * d / std::cbrt(flat)));
    list[n].shape = glm::vec4(float(flat), float(turn), d < 0.012 ? 0.0f : 1.0f, 0.0f);
  }
  const auto off = [&](const gpu::BubbleInstance& b) {
    const glm::vec3 way(b.place.x, b.place.y - float(viewer_m.y), b.place.z);
    return glm::dot(way, way);
  };
  std::sort(list.begin(), list.begin() + std::ptrdiff_t(count),
            [&](const gpu::BubbleInstance& a, const gpu::BubbleInstance& b) { return off(a) > off(b); });
  return count;
}

}  // namespace seascape
