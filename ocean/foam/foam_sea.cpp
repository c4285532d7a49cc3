#include "ocean/foam/foam_sea.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "ocean/foam/foam_rows.h"
#include "ocean/places/jump_steps.h"
#include "ocean/places/place_fields.h"

namespace seascape {

namespace {
// Coverages that settle long before are stepped by less often.
constexpr double settling_step_s = 0.25;
// A step is over when this share of the time until the next one has gone. It starts one frame after it is due: in that
// frame spray takes its whole step.
constexpr double step_share = 2.0 / 3.0;
// A shore foams in full where the significant height of its waves (4 deviations) is a fifth of the depth that foams.
constexpr float wash_heights = 4.0f / 0.2f;
// Rows refreshed per update after the water changes; at most 3 ms.
constexpr int rows_an_update = 24;

glm::vec2 flow_at(const FoamSpec& spec, glm::dvec2 place, double texel_m, double time_s) {
  const glm::vec4 outside = place_outside(spec.place, InputTarget::flow);
  return spec.flow ? glm::vec2(spec.flow->value(place, texel_m, time_s, outside)) : glm::vec2(outside);
}
}  // namespace

bool keeps_foam(const FoamSpec& spec, bool shores, bool wakes, bool actors) {
  return actors || ((spec.settings.simulated || wakes) && spec.settings.breaking > 0.0) ||
         (spec.inputs && !spec.inputs->empty()) ||
         (shores && (spec.settings.shore_per_s > 0.0 || spec.settings.breaking > 0.0));
}

FoamSea::FoamSea(const FoamSpec& spec, Sea& sea, std::shared_ptr<const ShoreLines> shore)
    : spec_(spec), sea_(sea), breaking_(sea, spec.settings.life_s), foam_(spec.settings) {
  flows_ = spec.flow != nullptr;
  if (flows_) take_flow();
  if (spec_.inputs && !spec_.inputs->only_add())
    spared_.emplace(spec_.settings.windows, 1.0f, foam_.field().placement());
  const SeaView view = sea.view(0, SeaDetail::crests);
  if (shore && !shore->empty() && view.field().has_curved())
    shore_.emplace(std::move(shore), spec.settings.windows, view.field());
}

void FoamSea::take_flow() {
  for (Foam* foam : {&foam_, trail_ ? &*trail_ : nullptr})
    if (foam)
      foam->set_flow(
          [this](glm::dvec2 place, double texel) {
            return flow_at(spec_, place, texel, double(tick_) / spec_.settings.rate_hz);
          },
          spec_.flow->still());
}

void FoamSea::take_sea() {
  const PlaceSettings before = std::exchange(spec_.place, sea_.spec().place.settings);
  if (flows_ && place_outside(before, InputTarget::flow) != place_outside(spec_.place, InputTarget::flow)) take_flow();
  breaking_.take_sources();
  if (!shore_) return;
  const SeaView view = sea_.view(ticks_from_seconds(step_time_s()), SeaDetail::crests);
  if (!shore_->is_of(sea_.spec().place.shore, view.field()))
    shore_.emplace(sea_.spec().place.shore, spec_.settings.windows, view.field());
}

// What a sea's whitecaps cover on average where they come and go alike, and with them the windows' new edges.
float FoamSea::mean_cover() const {
  const double gain = spec_.settings.breaking * foam_breaking_per_s * breaking_.mean_share();
  return float(gain / (gain + 1.0 / spec_.settings.life_s));
}

void FoamSea::add_gain(const FoamRow& row, std::span<float> per_s, double time_s, const SeaView* pressed) {
  const FoamSettings& s = spec_.settings;
  const bool waves = s.simulated && s.breaking > 0.0 && breaking_.ever();  // or else what breaks is drawn while it does
  thread_local std::vector<FoamShore::Moved> along;
  Moved moved;
  if (shore_) {
    along.resize(per_s.size());
    if (shore_->row(row, breaking_.field(), breaking_.tiles(), foam_.flow_mps(),
                    flow_phase(time_s, spec_.place.flow_period_s), along))
      moved = along;
  }
  if ((waves || pressed) && s.breaking > 0.0) add_breaking(row, per_s, time_s, waves, pressed, moved);
  if (still_water_) add_shores(row, per_s, moved);
  if (spec_.inputs && !spec_.inputs->empty()) add_inputs(row, per_s, time_s, moved);
  if (!discs_.empty()) add_discs(row, per_s, moved, discs_);
  if (trail_) add_trail(row, per_s);
}

void FoamSea::add_breaking(const FoamRow& row, std::span<float> per_s, double time_s, bool waves,
                           const SeaView* pressed, Moved along) const {
  thread_local std::array<std::vector<float>, 8> buffers;
  std::size_t used = 0;
  const auto buffer = [&](float value) {
    std::vector<float>& taken = buffers[used++];
    taken.assign(per_s.size(), value);
    return taken.data();
  };
  const LodIndex first(glm::floor(row.first_m / row.texel_m));
  const std::size_t count = per_s.size();
  const bool of_shore = waves && !along.empty();
  BreakingWater water;
  if (!waves) {
    water.kept = buffer(0.0f);
  } else if (still_water_) {
    const LodRow<glm::vec3> still = still_water_->row(row.slice, first);
    float* const kept = buffer(1.0f);
    for (std::size_t i = 0; i < count; ++i) kept[i] = still[std::int64_t(i)].y;
    if (std::any_of(kept, kept + count, [](float share) { return share != 1.0f; })) water.kept = kept;
  }
  if (const LodField<glm::vec2>* const speeds = waves ? foam_.flow_mps() : nullptr) {
    const LodRow<glm::vec2> speed = speeds->row(row.slice, first);
    float *const x = buffer(0.0f), *const z = buffer(0.0f);
    bool flows = false;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec2 v = speed[std::int64_t(i)];
      x[i] = v.x, z[i] = v.y;
      flows = flows || v != glm::vec2(0.0f);
    }
    if (flows) water.flow_x = x, water.flow_z = z;
  }
  const glm::dvec2 viewer = foam_.field().placement().viewer;
  const DynamicSurface* const dynamic = pressed ? pressed->dynamic() : nullptr;
  const WakeSurface* const wakes = pressed ? pressed->wakes() : nullptr;
  double reach = 0.0;
  for (int i = 0; dynamic && i < dynamic->levels(); ++i)
    if (!dynamic->still(i)) reach = double(dynamic->windows(viewer).reach.y);
  const bool around = std::abs(row.first_m.y - viewer.y) < reach,
             of_bodies = wakes && wakes->near(row.first_m, row.first_m + glm::dvec2(double(count) * row.texel_m, 0.0));
  if (of_shore || around || of_bodies) {
    float *const xx = buffer(0.0f), *const zz = buffer(0.0f), *const xz = buffer(0.0f);
    bool moves = false;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec2 rest = row.first_m + glm::dvec2(double(i) * row.texel_m, 0.0);
      glm::dvec3 gradient(0.0);
      if (double(gpu::lod_distance(glm::vec2(rest - viewer))) < reach)
        gradient = dynamic->sea(rest, row.texel_m).shift_gradient;
      if (of_bodies) gradient += wakes->sea(rest, row.texel_m).shift_gradient;
      if (of_shore) gradient += along[i].shift_gradient;
      xx[i] = float(gradient.x), zz[i] = float(gradient.y), xz[i] = float(gradient.z);
      moves = moves || gradient != glm::dvec3(0.0);
    }
    if (moves) water.xx = xx, water.zz = zz, water.xz = xz;
  }
  if (of_shore) {
    float *const variance = buffer(0.0f), *const whole = buffer(0.0f);
    for (std::size_t i = 0; i < count; ++i)
      variance[i] = float(along[i].variance), whole[i] = float(along[i].whole_variance);
    water.variance = variance, water.sea_variance = whole;
  }
  breaking_.add(row, float(spec_.settings.breaking * foam_breaking_per_s), water,
                flow_phase(time_s, spec_.place.flow_period_s), per_s);
}

// Waves that run up a shore, and crests that break in a surf zone.
void FoamSea::add_shores(const FoamRow& row, std::span<float> per_s, Moved along) const {
  struct Texel {
    int i;
    bool surf;
    float still_m, waves, broken, above_m, shore_per_s;
  };
  thread_local std::vector<Texel> texels;
  thread_local std::vector<glm::dvec2> rest;
  thread_local std::vector<glm::vec3> displaced;
  with_room(texels, per_s.size()), with_room(rest, per_s.size()), with_room(displaced, per_s.size());
  const FoamSettings& s = spec_.settings;
  const float breaking = float(s.breaking * foam_breaking_per_s);
  const LodRow<glm::vec3> water = still_water_->row(row.slice, LodIndex(glm::floor(row.first_m / row.texel_m)));
  const float shore_depth = s.shore_per_s > 0.0 ? float(2.0 * s.shore_m) : 0.0f;
  const auto of_sea = float(breaking_.height_variance());
  for (std::size_t i = 0; i < per_s.size(); ++i) {
    const glm::vec3 still = water[std::int64_t(i)];
    if (!(still.x > 0.0f)) continue;
    float broken = still.z, above = 0.0f, variance = still.y * still.y * of_sea;
    if (!along.empty() && along[i].height_variance > 0.0) {
      const float other = float(along[i].height_variance);
      broken = (variance * broken + other * float(along[i].surf)) / (variance + other);
      above = float(along[i].displacement.y);
      variance += other;
    }
    // Water that stands does not foam, nor does a ripple.
    const float washed =
        still.x < shore_depth ? std::clamp(wash_heights * std::sqrt(variance) / float(s.shore_m), 0.0f, 1.0f) : 0.0f;
    const bool surf = broken > 0.01f && breaking > 0.0f;
    if (!(washed > 0.0f) && !surf) continue;
    texels.push_back({int(i), surf, still.x, still.y, broken, above, float(s.shore_per_s) * washed});
    rest.push_back(row.first_m + glm::dvec2(double(i) * row.texel_m, 0.0));
  }
  if (texels.empty()) return;
  displaced.resize(rest.size());
  breaking_.displace(row.slice, rest, displaced);
  for (std::size_t n = 0; n < texels.size(); ++n) {
    const Texel& t = texels[n];
    // Waves are no higher than a share of the depth (McCowan 1894: 0.78, half of it above the still water).
    const float most = 0.39f * t.still_m, up = std::clamp(t.waves * displaced[n].y + t.above_m, -most, most);
    float& gain = per_s[std::size_t(t.i)];
    gain += t.shore_per_s * std::clamp(1.0f - (t.still_m + up) / float(s.shore_m), 0.0f, 1.0f);
    if (t.surf) gain += breaking * t.broken * std::clamp(2.0f * up / most, 0.0f, 1.0f);
  }
}

double FoamSea::largest_shift_m() const { return shift_m() + (shore_ ? shore_->largest_shift_m() : 0.0); }

void FoamSea::add_inputs(const FoamRow& row, std::span<float> per_s, double time_s, Moved along) {
  const LodIndex first(glm::floor(row.first_m / row.texel_m));
  for (std::size_t i = 0; spared_ && i < per_s.size(); ++i) spared_->texel(row.slice, first + LodIndex(i, 0)) = 1.0f;
  const InputBounds bounds = spec_.inputs->bounds();
  const double around = largest_shift_m() + row.texel_m;
  if (row.first_m.y < bounds.least.y - around || row.first_m.y > bounds.most.y + around) return;
  thread_local std::vector<int> texels;
  with_room(texels, per_s.size());
  for (std::size_t i = 0; i < per_s.size(); ++i)
    if (bounds.holds(row.first_m + glm::dvec2(double(i) * row.texel_m, 0.0), around)) texels.push_back(int(i));
  const std::span<const glm::dvec2> places = standing(row, texels, along);
  for (std::size_t n = 0; n < texels.size(); ++n) {
    const glm::dvec2 rest = row.first_m + glm::dvec2(double(texels[n]) * row.texel_m, 0.0);
    const auto joined = [&](float gain) {
      return spec_.inputs->value(places[n], row.texel_m, time_s, glm::vec4(gain), rest).x;
    };
    float& gain = per_s[std::size_t(texels[n])];
    gain = joined(gain);
    constexpr auto of_breaking = float(foam_breaking_per_s);
    if (spared_)
      spared_->texel(row.slice, first + LodIndex(texels[n], 0)) =
          std::clamp(joined(of_breaking) / of_breaking, 0.0f, 1.0f);
  }
}

bool FoamSea::any_source(bool wakes) const {
  const FoamSettings& s = spec_.settings;
  return (s.breaking > 0.0 && ((s.simulated && breaking_.ever()) || wakes)) ||
         (spec_.inputs && !spec_.inputs->empty()) || !discs_.empty() || !lasting_.empty() ||
         (trail_ && trail_->any()) || (still_water_ && (s.shore_per_s > 0.0 || s.breaking > 0.0));
}

void FoamSea::begin_step() {
  const std::int64_t ticks = next_ticks();
  tick_ += ticks;
  step_s_ = double(ticks) / spec_.settings.rate_hz;
  stepped_ = 0;
  // Of the time that settles neither dynamic waves nor actors are known.
  wakes_ = (sea_.dynamic_waves() != nullptr || sea_.wakes() != nullptr) && !settling_;
  discs_.clear();
  if (!settling_) sea_.foam().append(step_time_s() - step_s_, step_time_s(), discs_);
  take_lasting();
  gains_ = any_source(wakes_);
  if (coarse_left_ > 0)
    --coarse_left_;
  else if (!settling_)
    --steps_left_;
}

std::uint32_t FoamSea::step_slice(int slice) {
  ++slices_stepped_;
  step_trail(slice);
  if (!gains_) return foam_.step_slice(slice, step_s_, nullptr);
  const SeaView& view = breaking_.view();
  const SeaView* const pressed = wakes_ && (view.dynamic() || view.wakes()) ? &view : nullptr;
  const auto gain = [&](const FoamRow& row, std::span<float> per_s) { add_gain(row, per_s, step_time_s(), pressed); };
  return foam_.step_slice(slice, step_s_, std::cref(gain));  // by reference: nothing is allocated
}

void FoamSea::begin(double time_s, const glm::dvec3& viewer) {
  changed_ = 0;
  const FoamSettings& s = spec_.settings;
  if (!(std::abs(time_s * s.rate_hz) < 0x1p52) || !(std::abs(viewer.x) + std::abs(viewer.z) < 1e12) ||
      !std::isfinite(viewer.y))
    return;
  const auto ticks = std::int64_t(std::floor(time_s * s.rate_hz + 1e-6));
  // The last whole stride, but not before a step that was taken by shorter ones.
  const std::int64_t strides = ticks - (ticks % stride_ + stride_) % stride_;
  const std::int64_t now = tick_ <= ticks ? std::max(strides, begun_ ? tick_ : strides) : strides;
  const double since = std::max(time_s * s.rate_hz - double(now), 0.0) / double(stride_) + 1e-6;  // in steps
  // Less a little, for what is added to `since`.
  slices_due_ = std::min(int(std::ceil(since / step_share * slices() - 1e-3)), slices());
  const bool jumps = !begun_ || now < tick_ || double(now - tick_) > longest_s * s.rate_hz,
             anew = jumps && !sea_.goes_on();
  // At once, so that what is drawn from where follows from the viewer alone.
  const LodPlacement placement = lod_placement(s.windows, {viewer.x, viewer.z}, lod_scale(s.windows, viewer.y));
  changed_ = foam_.follow(placement, fresh_);
  if (spared_) spared_->follow(placement);
  if (trail_) trail_->follow(placement, 0.0f);
  follow(placement, now);
  if (jumps && !anew) go_on(now);
  due_ = now;
  settling_ = anew;
  steps_left_ = std::min<std::int64_t>((now - tick_ + stride_ - 1) / stride_, most_steps);
  if (!anew) return;
  begun_ = first_ = true;
  trail_.reset();
  changed_ |= (1u << s.windows.slices) - 1u;
  foam_.fill(0.0f);
  // Long steps first, then those of the rate.
  const double all = s.settle_s, fine = std::min(all, 1.0);
  coarse_ticks_ = std::max<std::int64_t>(1, std::llround(settling_step_s * s.rate_hz));
  coarse_left_ = std::int64_t(std::ceil((all - fine) * s.rate_hz / double(coarse_ticks_)));
  tick_ = now - std::int64_t(std::ceil(fine * s.rate_hz)) - coarse_left_ * coarse_ticks_;
  stepped_ = slices();
}

void FoamSea::go_on(std::int64_t now) {
  const std::int64_t steps = begun_ ? jump_steps(tick_, now, spec_.settings.rate_hz) : 0;
  tick_ = now - steps;
  stepped_ = slices();
  if (std::exchange(begun_, true)) return;
  breaking_.evaluate(ticks_from_seconds(step_time_s()));
  fresh_ = spec_.settings.simulated && any_source(false) ? mean_cover() : 0.0f;
  foam_.fill(fresh_);
  changed_ |= (1u << slices()) - 1u;
}

void FoamSea::follow(const LodPlacement& placement, std::int64_t tick) {
  const FoamSettings& s = spec_.settings;
  const std::shared_ptr<const Shallows>& shallows = sea_.shallows().from;
  if (!shallows) {
    if (shore_) shore_->follow(placement, nullptr);
    return;
  }
  // Of the last step that is due, for which the crests are asked anyway.
  const SeaView view = sea_.view(ticks_from_seconds(double(tick) / s.rate_hz), SeaDetail::crests);
  const PlaceSea* const places = &view.places();
  if (shore_) shore_->follow(placement, places);
  const auto water = [&](glm::dvec2 at, double texel, glm::vec3) {
    const StillWater w = places->still_water(at, texel, 0.0);
    return glm::vec3(float(std::clamp(w.depth_m, -1e6, 1e6)), float(std::min(std::max(w.waves, w.swash), 10.0)),
                     float(std::min(w.surf, 1.0)));
  };
  if (!still_water_) {
    shallows_ = shallows;
    still_water_.emplace(s.windows, glm::vec3(1e6f, 1.0f, 0.0f), placement);
    for (int i = 0; i < still_water_->slices(); ++i)
      still_water_->each(i, [&](LodIndex w) {
        still_water_->texel(i, w) = water(still_water_->middle(i, w), still_water_->texel_m(i), {});
      });
    return;
  }
  still_water_->follow(placement, water);
  if (shallows != shallows_ && !sea_.changing()) {
    shallows_ = shallows;
    anew_ = 0;
  }
  // Rows of texels as they are stored, so that none is missed while the windows move.
  const std::int64_t side = still_water_->side();
  for (int n = 0; n < rows_an_update && anew_ >= 0; ++n) {
    const int slice = int(anew_ / side);
    const LodIndex first = still_water_->first(slice);
    const std::int64_t row = first.y + ((anew_ % side - first.y) % side + side) % side;
    for (std::int64_t x = 0; x < side; ++x) {
      const LodIndex w(first.x + x, row);
      still_water_->texel(slice, w) = water(still_water_->middle(slice, w), still_water_->texel_m(slice), {});
      if (shore_) shore_->take(slice, w, places);
    }
    if (++anew_ == side * still_water_->slices()) anew_ = -1;
  }
}

void FoamSea::apply(const FoamSettings& settings) {
  validate(settings);
  FoamSettings& now = spec_.settings;
  assert(settings.windows == now.windows);
  if (settings.rate_hz != now.rate_hz) {
    tick_ = due_ = std::int64_t(std::floor(double(tick_) / now.rate_hz * settings.rate_hz));
    stepped_ = slices();
  }
  now = settings;
  foam_.set_life(settings.life_s);
  breaking_.set_life(settings.life_s);
}

std::int64_t FoamSea::next_ticks() const {
  if (settling_) return coarse_left_ > 0 ? coarse_ticks_ : 1;
  return (due_ - tick_ + steps_left_ - 1) / steps_left_;
}

std::optional<double> FoamSea::next_s() const {
  if (stepped_ < (tick_ < due_ ? slices() : slices_due_)) return step_time_s();
  return tick_ < due_ ? std::optional(double(tick_ + next_ticks()) / spec_.settings.rate_hz) : std::nullopt;
}

void FoamSea::step() {
  const bool fills = first_ && coarse_left_ > 0;
  if (stepped_ == slices()) begin_step();
  if (gains_) {
    breaking_.at(ticks_from_seconds(step_time_s()), foam_.field().texel_m(0), slices());
    fresh_ = spec_.settings.simulated ? mean_cover() : 0.0f;
  }
  if (fills) {  // what a long step before there was foam comes to
    first_ = false;
    foam_.fill(fresh_);
    stepped_ = slices();
  }
  for (const int due = tick_ < due_ ? slices() : slices_due_; stepped_ < due; ++stepped_)
    changed_ |= step_slice(stepped_) | (spared_ ? 1u << stepped_ : 0u);
}

void FoamSea::prepare(double time_s) {
  const double rate = spec_.settings.rate_hz;
  if (begun_ && gains_)
    breaking_.prepare(ticks_from_seconds(double(tick_ + stride_) / rate),
                      (time_s * rate - double(tick_)) / double(stride_));
}

}  // namespace seascape
