#include "ocean/surface/lens_drops.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ocean/waves/split_mix.h"

namespace seascape {

namespace {

constexpr double longest_step_s = 1.0;
constexpr double dries = 0.3;        // share of its life in which a drop fades
constexpr double leaves_run = 0.25;  // tangent by which it has run when it has lost a third of its radius

// Even numbers from 0 to 1.
class Chance {
 public:
  Chance(std::uint64_t a, std::uint64_t b) : key_(split_mix(a) ^ split_mix(b + split_mix_step)) {}
  double next() { return share_of(split_mix(key_ += split_mix_step)); }
  double next(double least, double most) { return least + (most - least) * next(); }

 private:
  std::uint64_t key_;
};

}  // namespace

// How far it has run: it sticks and slips, but never turns back.
double LensDrops::run(const Drop& drop, double age_s) {
  const double t = age_s - drop.waits_s;
  return t <= 0.0 ? 0.0 : drop.speed * (t - 0.9 * std::sin(drop.sticks_per_s * t) / drop.sticks_per_s);
}

void LensDrops::wet_by(const Moment& moment, std::uint32_t seed, int eye) {
  Chance chance(std::uint64_t(seed) << 1 | std::uint64_t(eye & 1), std::bit_cast<std::uint64_t>(moment.time_s));
  drops_.clear();
  for (int n = 0; n < most; ++n) {
    Drop drop;
    drop.at = {chance.next(moment.fov.left, moment.fov.right), chance.next(moment.fov.down, moment.fov.up)};
    // Small ones are many: sizes between 0.5 and 2.4 mm. Large ones are heavier against what holds their edge, and run.
    const double large = std::pow(chance.next(), 2.0);
    drop.radius = (0.0005 + 0.0019 * large) / moment.lens_m;
    drop.speed = (0.002 + 0.05 * large) / moment.lens_m;
    drop.waits_s = chance.next(0.0, 0.8);
    drop.sticks_per_s = chance.next(6.0, 14.0);
    drop.lasts_s = chance.next(2.0, life_s);
    drops_.push_back(drop);
  }
}

void LensDrops::step(const Moment& moment, std::uint32_t seed, int eye) {
  const double passed_s = moment.time_s - time_s_;
  eye_ = eye;
  if (!known_ || passed_s < 0.0 || passed_s > longest_step_s) {
    drops_.clear();
    wet_ = false;
  }
  if (moment.wet) {
    drops_.clear();
  } else if (wet_) {
    out_s_ = moment.time_s;
    wet_by(moment, seed, eye);
  } else {
    const double before_s = time_s_ - out_s_, now_s = moment.time_s - out_s_;
    for (Drop& drop : drops_) {
      const double way = run(drop, now_s) - run(drop, before_s);
      drop.at += way * moment.down;
      if (passed_s > 0.0) {
        const double stretch = std::min(2.0 * way / passed_s / std::max(drop.speed, 1e-9), 1.5) * drop.radius;
        drop.behind = -0.5 * stretch * moment.down;
      }
    }
    std::erase_if(drops_, [&](const Drop& drop) { return now_s >= drop.lasts_s; });
  }
  known_ = true;
  wet_ = moment.wet;
  time_s_ = moment.time_s;
}

void LensDrops::list(std::vector<gpu::LensDrop>& drops) const {
  const double age_s = time_s_ - out_s_;
  for (const Drop& drop : drops_) {
    const double left = (drop.lasts_s - age_s) / (dries * drop.lasts_s);
    const double radius = drop.radius * (1.0 - std::min(run(drop, age_s) / leaves_run, 1.0) / 3.0);
    drops.push_back({{float(drop.at.x), float(drop.at.y), float(radius), float(eye_)},
                     {float(drop.behind.x), float(drop.behind.y), float(std::clamp(left, 0.0, 1.0)), 0.0f}});
  }
}

}  // namespace seascape
