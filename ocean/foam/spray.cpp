#include "ocean/foam/spray.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/require.h"
#include "ocean/foam/spray_chance.h"
#include "ocean/places/jump_steps.h"
#include "ocean/waves/spectrum.h"

namespace seascape {

namespace {

constexpr double cell_m = 4.0;
constexpr int puffs_a_throw = 3, most_trials = 32;  // of a cell in a step
constexpr std::size_t puffs_a_piece = 256;          // that a core takes at a time
constexpr double place_texel_m = 1.0;               // for which the still water is asked
constexpr double fine_m = 0.25, least_m = 0.05;  // footprint of what breaks; height above the water where a puff begins
constexpr double least_wind_mps = 7.0, usual_wind_mps = 15.0;
constexpr double gust_s = 0.5, most_gust = 4.0;
constexpr double full_share = 2.0 / 3.0;  // of the range in which nothing is thinned
// Half of a puff's size over its distance: to where all of it is seen, and from where nothing. Mist that is nearer lies
// about the eye and not before it.
constexpr double full_to = 0.1, seen_to = 0.3;
constexpr double most_streak = 4.0;  // half of the way that a puff is drawn out along, in its radii

// The trials of a cell in a step: as many as its puffs would be if all of it broke, more while a gust passes.
using Chance = Spray::Chance;
struct Trials {
  Chance chance;
  int count;
  Trials(const SpraySettings& s, std::int64_t tick, std::int64_t x, std::int64_t z, double expected)
      : chance(Chance(s.seed).of(tick).of(x).of(z)) {
    Chance gust =
        Chance(~std::uint64_t(s.seed)).of(std::int64_t(std::floor(double(tick) / s.rate_hz / gust_s))).of(x).of(z);
    count = int(
        std::min(std::min(-std::log(1.0 - gust.next()), most_gust) * expected + chance.next(), double(most_trials)));
  }
  Chance trial(int i) const { return chance.of(i); }
};

// Where a trial is, as a rest position.
glm::dvec2 trial_place(std::int64_t x, std::int64_t z, Chance& chance) {
  const double u = chance.next(), v = chance.next();
  return cell_m * glm::dvec2(double(x) + u, double(z) + v);
}

}  // namespace

void validate(const SpraySettings& s) {
  require(s.amount >= 0.0 && s.amount <= 4.0, s.amount, "amount", "from 0 to 4");
  require(s.most >= 64 && s.most <= 32768, s.most, "most", "from 64 to 32768");
  require(s.range_m >= 10.0 && s.range_m <= 300.0, s.range_m, "range_m", "from 10 to 300");
  require(s.life_s >= 0.2 && s.life_s <= 6.0, s.life_s, "life_s", "from 0.2 to 6");
  require(s.size >= 0.25 && s.size <= 4.0, s.size, "size", "from 0.25 to 4");
  require(s.rate_hz >= 4.0 && s.rate_hz <= 60.0, s.rate_hz, "rate_hz", "from 4 to 60");
}

Spray::Spray(const SpraySettings& settings, Sea& sea, double foam_life_s)
    : settings_(settings),
      sea_(sea),
      breaking_(sea, foam_life_s),
      gravity_mps2_(sea.state().gravity_mps2),
      profile_(sea.state().wind_speed_mps, gravity_mps2_),
      cells_(0) {
  validate(settings);
  feel_wind();
  const auto most = std::size_t(settings.most);
  puffs_.reserve(most);
  places_.resize(most);
  answers_.resize(most);
  aloft_.resize(most);
  seen_.resize(most);
  lay_cells();
}

void Spray::lay_cells() {
  cells_ = 2 * int(std::ceil(settings_.range_m / cell_m)) + 2;
  breakers_.resize(std::size_t(cells_) * std::size_t(cells_));
}

void Spray::apply(const SpraySettings& settings, double foam_life_s) {
  validate(settings);
  assert(settings.most == settings_.most);
  if (settings.rate_hz != settings_.rate_hz)
    tick_ = due_ = std::int64_t(std::floor(double(tick_) / settings_.rate_hz * settings.rate_hz));
  settings_ = settings;
  breaking_.set_life(foam_life_s);
  lay_cells();
}

void Spray::feel_wind() {
  const SeaState& state = sea_.state();
  if (state.wind_speed_mps == wind_mps_ && state.wind_to_deg == wind_to_deg_) return;
  wind_mps_ = state.wind_speed_mps;
  wind_to_deg_ = state.wind_to_deg;
  profile_ = WindProfile(wind_mps_, gravity_mps2_);
  const glm::dvec2 to = direction_xz(wind_to_deg_);
  wind_to_ = {to.x, 0.0, to.y};
}

double Spray::per_m2_s() const {
  const double wind = std::clamp((wind_mps_ - least_wind_mps) / (usual_wind_mps - least_wind_mps), 0.0, 2.0);
  return breaking_.ever() ? settings_.amount * spray_per_m2_s * wind * wind : 0.0;
}

Spray::Puff Spray::after(const Puff& puff, double seconds) const {
  Puff p = puff;
  p.age_s += seconds;
  const double flies = std::min(seconds, p.age_s);
  if (!(flies > 0.0)) return p;
  const Flight flight = fly(p.velocity_mps, p.air_mps, p.relaxation_s, gravity_mps2_, flies);
  p.place_m += flight.way;
  p.velocity_mps = flight.velocity;
  p.above_m += p.rising_mps * flies;
  return p;
}

// Of its place, which holds until the next step.
void Spray::feel_air(Puff& p) const {
  p.air_mps = wind_to_ * profile_.at(std::max(p.above_m, 0.3)) + p.eddy_mps;
  p.relaxation_s = relaxation_s(p.diameter_m, glm::length(p.velocity_mps - p.air_mps));
}

// An eddy's velocity, times a strength.
glm::dvec3 Spray::eddy(Chance& chance, double strength) const {
  const double along = 2.4 * chance.normal(), side = 1.9 * chance.normal(), up = 1.25 * chance.normal();
  return strength * profile_.friction_mps *
         (along * wind_to_ + side * glm::dvec3(-wind_to_.z, 0.0, wind_to_.x) + glm::dvec3(0.0, up, 0.0));
}

// Moves those aloft by a step. What is then under water or has lived is gone; the others feel the wind of their height.
void Spray::land() {
  const double step = 1.0 / settings_.rate_hz;
  const auto all = tbb::blocked_range<std::size_t>(0, puffs_.size(), puffs_a_piece);
  tbb::parallel_for(all, [&](const auto& some) {
    for (std::size_t i = some.begin(); i < some.end(); ++i) {
      puffs_[i] = after(puffs_[i], step);
      places_[i] = {puffs_[i].place_m.x, puffs_[i].place_m.z};
    }
  });
  query(breaking_.field(), breaking_.tiles(), std::span(places_.data(), puffs_.size()),
        std::span(answers_.data(), puffs_.size()), {.footprint_m = fine_m, .most_iterations = 6, .tolerance_m = 0.02});
  tbb::parallel_for(all, [&](const auto& some) {
    for (std::size_t i = some.begin(); i < some.end(); ++i) {
      Puff& p = puffs_[i];
      const StillWater water = this->water(places_[i]);
      const double above = p.place_m.y - water.height_m - water.waves * answers_[i].height_m,
                   flown = std::min(step, p.age_s);
      aloft_[i] = above >= 0.0 && p.age_s < p.life_s;
      if (!aloft_[i]) continue;
      const double before = p.above_m - p.rising_mps * flown;
      if (flown > 0.25 * step) p.rising_mps = (above - before) / flown;
      p.above_m = above;
      feel_air(p);
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < puffs_.size(); ++i)
    if (aloft_[i]) puffs_[kept++] = puffs_[i];
  puffs_.resize(kept);
}

Spray::Cell Spray::cell(const glm::dvec3& viewer, int i, int j) const {
  return {std::int64_t(std::floor(viewer.x / cell_m)) - cells_ / 2 + i,
          std::int64_t(std::floor(viewer.z / cell_m)) - cells_ / 2 + j,
          std::size_t(j) * std::size_t(cells_) + std::size_t(i)};
}

// Of what breaks within a cell the share that throws up spray: on steep crests that stand out into the wind (troughs
// lie in their lee), and near enough.
double Spray::cell_share(const Cell& c, const glm::dvec3& viewer, const WaveField::Filter& coarse) const {
  const glm::dvec2 rest = cell_m * glm::dvec2(double(c.x) + 0.5, double(c.z) + 0.5);
  const SeaSample sea = breaking_.field().sea(breaking_.tiles(), rest, coarse);
  const glm::dvec3 d = sea.displacement;
  const double height = 4.0 * std::sqrt(sea_.statistics().height_variance);
  const double out =
      height > 0.0 ? smooth_between(0.0, 0.2, d.y / height) * (1.0 - smooth_between(0.75, 1.0, sea.jacobian())) : 0.0;
  if (!(out > 0.0)) return 0.0;
  const double still = water({rest.x + d.x, rest.y + d.z}).height_m;
  const double distance = glm::length(glm::dvec3(rest.x + d.x, still + d.y, rest.y + d.z) - viewer);
  return out * (1.0 - smooth_between(full_share, 1.0, distance / settings_.range_m));
}

StillWater Spray::water(glm::dvec2 place) const { return breaking_.view().still_water(place, place_texel_m); }

std::optional<Spray::Breaker> Spray::breaker(glm::dvec2 rest, const WaveField::Filter& fine) const {
  Breaker b{breaking_.field().sea(breaking_.tiles(), rest, fine), {}, 1.0};
  b.jacobian = b.sea.jacobian();
  if (!(b.jacobian < breaking_.threshold())) return std::nullopt;
  b.water = water({rest.x + b.sea.displacement.x, rest.y + b.sea.displacement.z});
  if (b.water.clipped || !(b.water.depth_m > 0.2)) return std::nullopt;
  SeaSample left = b.sea;
  left.shift_gradient *= b.water.waves;
  b.jacobian = left.jacobian();
  if (!(b.jacobian < breaking_.threshold())) return std::nullopt;
  return b;
}

double Spray::expected() const { return per_m2_s() * cell_m * cell_m / settings_.rate_hz / puffs_a_throw; }

// Which trials throw up spray, of all cells at once.
void Spray::find_breakers(std::int64_t tick, const glm::dvec3& viewer) {
  const double due = expected();
  const WaveField::Filter fine = breaking_.field().filter(fine_m), coarse = breaking_.field().filter(cell_m);
  tbb::parallel_for(0, cells_, [&](int j) {
    for (int i = 0; i < cells_; ++i) {
      const Cell c = cell(viewer, i, j);
      std::uint32_t bits = 0;
      const Trials trials(settings_, tick, c.x, c.z, due);
      const double share = trials.count > 0 ? cell_share(c, viewer, coarse) : 0.0;
      for (int k = 0; share > 0.0 && k < trials.count; ++k) {
        Chance chance = trials.trial(k);
        const glm::dvec2 rest = trial_place(c.x, c.z, chance);
        if (chance.next() < share && breaker(rest, fine)) bits |= 1u << k;
      }
      breakers_[c.index] = bits;
    }
  });
}

void Spray::throw_up(std::int64_t tick, const glm::dvec3& viewer) {
  const double step = 1.0 / settings_.rate_hz, due = expected();
  std::size_t thrown = 0;
  for (const std::uint32_t bits : breakers_) thrown += std::size_t(std::popcount(bits)) * puffs_a_throw;
  if (thrown == 0) return;
  const auto most = std::size_t(settings_.most);
  const double share = double(most - puffs_.size()) / double(thrown);
  const WaveField& field = breaking_.field();
  const WaveField::Filter fine = field.filter(fine_m);
  for (int at = 0; at < cells_ * cells_; ++at) {
    const Cell c = cell(viewer, at % cells_, at / cells_);
    if (breakers_[c.index] == 0) continue;
    const Trials trials(settings_, tick, c.x, c.z, due);
    for (int k = 0; k < most_trials; ++k) {
      if ((breakers_[c.index] >> k & 1u) == 0) continue;
      Chance chance = trials.trial(k);
      const glm::dvec2 rest = trial_place(c.x, c.z, chance);
      const std::optional<Breaker> found = breaker(rest, fine);
      (void)chance.next();  // that decided
      if (!found || !(chance.next() < share)) continue;
      const glm::dvec3 water = found->water.waves * field.velocity(breaking_.tiles(), rest, fine);
      // u / (1 - J), and no faster than the wind that drives the waves.
      glm::dvec3 crest = glm::dvec3(water.x, 0.0, water.z) / std::clamp(1.0 - found->jacobian, 1.0 / 3.0, 1.0);
      if (const double speed = glm::length(crest); speed > wind_mps_) crest *= wind_mps_ / speed;
      const glm::dvec3 place = glm::dvec3(rest.x, found->water.height_m, rest.y) +
                               found->sea.displacement * glm::dvec3(1.0, found->water.waves, 1.0);
      glm::dvec3 eddy = this->eddy(chance, 0.6);
      eddy.y = std::abs(eddy.y);  // the wind leaves a breaking crest
      const double speed = glm::length(crest), up = (0.7 + 0.14 * speed) * std::abs(chance.normal());
      for (int n = 0; n < puffs_a_throw && puffs_.size() < most; ++n) {
        Puff p;
        const double later = step * chance.next();
        p.age_s = -later;
        p.above_m = least_m;
        p.place_m = place + later * water + glm::dvec3(0.0, least_m, 0.0);
        const double faster = 0.15 * chance.normal(), aside = 0.1 * speed * chance.normal();
        p.velocity_mps = (1.0 + faster) * crest + aside * glm::dvec3(-wind_to_.z, 0.0, wind_to_.x);
        p.velocity_mps.y = water.y + up * (0.6 + 0.4 * chance.next());
        p.rising_mps = p.velocity_mps.y - water.y;
        p.eddy_mps = eddy + this->eddy(chance, 0.8);
        p.diameter_m = finest_drop_m * std::pow(coarsest_drop_m / finest_drop_m, std::pow(chance.next(), 1.5));
        p.drops = smooth_between(drop_seen_from_m, drop_seen_by_m, p.diameter_m);
        p.radius_m = settings_.size * (1.0 - 0.65 * p.drops) * (0.16 + 0.2 * chance.next());
        p.life_s = settings_.life_s * (0.35 + 0.65 * chance.next());
        p.shape = chance.next();
        feel_air(p);
        puffs_.push_back(p);
      }
    }
  }
}

void Spray::step() {
  ++steps_;
  const double time_s = double(++tick_) / settings_.rate_hz;
  feel_wind();
  const bool throws = per_m2_s() > 0.0 && std::abs(viewer_.y) < settings_.range_m + sea_.statistics().largest_height_m;
  take_throws(time_s);
  if (!throws && puffs_.empty() && throws_.empty()) return;
  breaking_.evaluate(ticks_from_seconds(time_s));
  land();
  throw_made(tick_);
  if (!throws) return;
  find_breakers(tick_, viewer_);
  throw_up(tick_, viewer_);
}

void Spray::begin(double time_s, const glm::dvec3& viewer) {
  if (!(std::abs(time_s * settings_.rate_hz) < 0x1p52) || !(std::abs(viewer.x) + std::abs(viewer.z) < 1e12) ||
      !std::isfinite(viewer.y))
    return;
  const std::int64_t now = std::int64_t(std::floor(time_s * settings_.rate_hz + 1e-6)),
                     life = std::int64_t(std::ceil(settings_.life_s * settings_.rate_hz));
  const bool anew =
      !begun_ || now < tick_ || now - tick_ > life || glm::length(viewer - viewer_) > 0.5 * settings_.range_m;
  if (anew && sea_.goes_on()) {
    if (glm::length(viewer - viewer_) > 0.5 * settings_.range_m) puffs_.clear();
    tick_ = now - (begun_ ? jump_steps(tick_, now, settings_.rate_hz) : 0);
  } else if (anew) {
    puffs_.clear();
    tick_ = now - life;
  }
  begun_ = true;
  viewer_ = viewer;
  due_ = now;
}

std::optional<double> Spray::next_s() const {
  return tick_ < due_ ? std::optional(double(tick_ + 1) / settings_.rate_hz) : std::nullopt;
}

void Spray::prepare(double time_s) {
  const double since = time_s * settings_.rate_hz - double(tick_);
  if (begun_ && breaking_.view() && breaking_.view().ticks() == ticks_from_seconds(step_s()))
    breaking_.prepare(ticks_from_seconds(double(tick_ + 1) / settings_.rate_hz), since);
}

std::optional<gpu::SprayPuff> Spray::seen(const Puff& puff, double since, const glm::dvec3& viewer) const {
  if (!(puff.age_s + since > 0.0)) return std::nullopt;
  const Puff p = after(puff, since);
  if (p.age_s >= p.life_s) return std::nullopt;
  const glm::dvec3 from = p.place_m - viewer;
  const double distance = glm::length(from), old = p.age_s / p.life_s;
  // Eddies draw it apart, and what it hides with it, by the power 1.5; drops stay together longer.
  const double radius = p.radius_m + (0.18 - 0.14 * p.drops) * profile_.friction_mps * p.age_s,
               closer = p.radius_m / radius, thin = closer * std::sqrt(closer);
  // Half of how long an eye's picture is of; the wind draws mist out along its way by more than that, and eddies tear
  // it before it is a line.
  const double seen_for_s = 0.02 + 0.05 * (1.0 - p.drops) * smooth_between(0.0, 0.5, p.age_s),
               way = seen_for_s * glm::length(p.velocity_mps);
  const glm::dvec3 streak = seen_for_s * std::min(most_streak * radius / std::max(way, 1e-9), 1.0) * p.velocity_mps;
  const double across = glm::length(glm::cross(streak, from)) / std::max(distance, 1e-9);
  double hides = (0.4 + 0.4 * p.drops) * thin * (1.0 - old * old) * (1.0 - old * old);
  hides *= smooth_between(0.0, 0.08, p.age_s) * (1.0 - smooth_between(full_share, 1.0, distance / settings_.range_m)) *
           (1.0 - smooth_between(full_to, seen_to, (radius + across) / std::max(distance, 1e-9)));
  if (p.rising_mps < 0.0) hides *= smooth_between(0.0, 0.2, p.above_m);
  if (!(hides > 0.004)) return std::nullopt;
  return gpu::SprayPuff{glm::vec4(float(from.x), float(p.place_m.y), float(from.z), float(radius)),
                        glm::vec4(glm::vec3(streak), float(hides)), glm::vec2(float(p.shape), float(p.drops))};
}

std::size_t Spray::drawn(double time_s, const glm::dvec3& viewer, std::span<gpu::SprayPuff> to, double share) {
  const double since = std::max(time_s - step_s(), 0.0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, puffs_.size(), puffs_a_piece), [&](const auto& some) {
    for (std::size_t i = some.begin(); i < some.end(); ++i) seen_[i] = seen(puffs_[i], since, viewer);
  });
  std::size_t count = 0;
  for (std::size_t i = 0; i < puffs_.size() && count < to.size(); ++i) {
    if (!seen_[i]) continue;
    // Which go first does not follow their shapes. A tenth of all are about to go, so that none does at once.
    const double rank = std::fmod(997.0 * puffs_[i].shape, 1.0), stays = 10.0 * (1.1 * share - rank);
    if (!(stays > 0.0)) continue;
    to[count] = *seen_[i];
    to[count++].streak.w *= float(std::min(stays, 1.0));
  }
  return count;
}

}  // namespace seascape
