#include "ocean/sea/sea.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "ocean/places/bed_change.h"
#include "ocean/sea/left_out.h"
#include "ocean/sea/state_hash.h"

namespace seascape {

namespace {
constexpr double rate_without_dynamic_waves_hz = 60.0;

// A quality that keeps every wave of the ladder, so that what a sea has never depends on who asks.
constexpr WaveQuality all_waves{.resolution = std::max(gpu::wave_bins, gpu::long_tile_bins / 4),
                                .cascades = gpu::max_cascades};

WaveBins bins_of_spec(const SeaSpec& spec) {
  return spec.has_waves ? make_wave_bins(spec.state, all_waves) : WaveBins{ladder(spec.state), 0, {}};
}

std::unique_ptr<DynamicSea> dynamic_of(const SeaSpec& spec) {
  return spec.dynamic_waves ? std::make_unique<DynamicSea>(*spec.dynamic_waves, spec.pressure) : nullptr;
}

WakeSettings stepped(WakeSettings wakes, const DynamicSea* dynamic_waves) {
  wakes.waves.rate_hz = dynamic_waves ? dynamic_waves->rate_hz() : rate_without_dynamic_waves_hz;
  return wakes;
}

double rate_of(const DynamicSea* dynamic_waves) {
  return dynamic_waves ? dynamic_waves->rate_hz() : rate_without_dynamic_waves_hz;
}
}  // namespace

Sea::Sea(SeaSpec spec)
    : spec_(std::move(spec)),
      bins_(bins_of_spec(spec_)),
      chop_(spec_.state.chop),
      seed_(spec_.state.seed),
      waves_of_(spec_.state),
      dynamic_(dynamic_of(spec_)),
      wakes_(spec_.wakes ? std::make_unique<WakeWindows>(stepped(*spec_.wakes, dynamic_.get())) : nullptr),
      bodies_(spec_.place.volumes, 1.0 / rate_of(dynamic_.get())),
      foam_(spec_.actors_foam) {
  std::erase_if(spec_.sources, [](const auto& source) { return source->still(); });
  if (!spec_.has_waves) {
    for (WaveQuality* quality : {&spec_.drawn, &spec_.crests, &spec_.felt}) quality->cascades = 0;
  } else {
    if (!keeps_all(spec_.drawn, bins_)) drawn_bins_ = kept_bins(bins_, spec_.drawn);
    statistics_ = sea_statistics(spec_.state, bins());
  }
  shallows_.from = make_shallows(spec_.state, bins_, spec_.sources, spec_.place);
  make_field(SeaDetail::drawn);
  take_places();
  know_dynamic_velocity();
}

void Sea::make_field(SeaDetail detail) {
  const auto i = std::size_t(detail);
  if (fields_[i] != nullptr) return;
  const WaveQuality& quality = spec_.quality(detail);
  SeaState state = spec_.state;
  state.chop = chop_;
  WaveBins kept = keeps_all(quality, bins_) ? bins_ : kept_bins(bins_, quality);
  left_out_m_[i] = std::sqrt(left_out_variance(bins_, quality));
  fields_[i] = std::make_shared<WaveField>(state, quality, std::move(kept), statistics_, spec_.sources);
}

SeaView Sea::view(std::int64_t ticks, SeaDetail detail) {
  make_field(detail);
  const auto i = std::size_t(detail);
  if (places_->worn()) {
    if (places_.use_count() > 1) places_ = std::make_shared<PlaceSea>(*places_);
    places_->renew();
  }
  return SeaView(moments_.moment({ticks, detail, spec_.velocity(detail), waves_version_}, fields_[i], places_,
                                 now_at(ticks), left_out_m_[i]));
}

// Foam and spray ask of steps that lie within the last frame: of these dynamic waves and wakes are known as they are
// now.
bool Sea::knows_steps(std::int64_t ticks) const {
  const std::int64_t within = ticks_from_seconds(1.0);
  return begun_ && ticks <= now() && ticks > now() - within;
}

SeaNow Sea::now_at(std::int64_t ticks) {
  SeaNow now{.volumes = volumes_of(ticks)};
  if (!knows_steps(ticks)) return now;
  now.dynamic = dynamic_surface();
  now.wakes = wake_surface();
  return now;
}

std::shared_ptr<const ClipVolumes> Sea::volumes_of(std::int64_t ticks) {
  return ticks == now() ? bodies_.at(double(ticks) / double(gpu::ticks_per_second)) : bodies_.scene();
}

const SeaView& SeaStep::felt() {
  if (!felt_) felt_ = sea_.view(ticks_from_seconds(time_s), SeaDetail::felt);
  return felt_;
}

bool SeaStep::wake(const WakeBody& body, std::span<const WaveSource> sources) {
  return sea_.wakes_ && sea_.wakes_->add(body, sources);
}
bool SeaStep::clip(const ClipBody& body) { return sea_.bodies_.add(*actor_, body); }
bool SeaStep::foam(const FoamDisc& disc) { return sea_.foam_.add(disc); }
bool SeaStep::spray(const SprayThrow& thrown) { return sea_.spray_.add(thrown); }

void Sea::take_away(const SeaActor& actor) {
  bodies_.take_away(actor);
  std::erase_if(actors_, [&](const auto& one) { return one.get() == &actor; });
}

void Sea::step_actors(double end_s, double dt_s, std::vector<WaveSource>& presses) {
  bodies_.begin_step();
  if (!actors_.empty()) {
    stepping_ = ticks_from_seconds(end_s);
    if (changing()) follow_change(*stepping_);
    SeaStep step(*this, end_s, dt_s, presses);
    for (const auto& actor : actors_) {
      step.actor_ = actor.get();
      actor->step(step);
    }
    stepping_.reset();
  }
  if (wakes_) wakes_->step(dt_s);
  bodies_.end_step(end_s);
  foam_.end_step(end_s, dt_s);
  spray_.end_step(end_s, dt_s);
}

void Sea::advance(double time_s, const glm::dvec3& viewer) {
  if (!(std::abs(time_s) < 1e15)) return;
  moments_.forget_now();
  bodies_.forget();
  const std::int64_t ticks = ticks_from_seconds(time_s);
  const double rate = rate_of(dynamic_.get());
  const auto now = std::int64_t(std::floor(time_s * rate + 1e-6));
  const bool anew = dynamic_ ? dynamic_->begins_anew(time_s)
                             : !begun_ || now < step_ || double(now - step_) > DynamicSea::longest_s * rate;
  // Foam has been stepped up to the last advance, but for less than its longest step.
  constexpr double longest_foam_step_s = 1.0;
  foam_.forget_before(time_s_ - longest_foam_step_s - 2.0 / rate);
  spray_.forget_before(time_s_ - longest_foam_step_s - 2.0 / rate);
  if (anew) {
    bodies_.hold();
    foam_.clear();
    spray_.clear();
    for (const auto& actor : actors_) actor->hold();
    if (wakes_ && !goes_on_) wakes_->calm();
  }
  if (wakes_ && now != step_) wakes_->look_ahead(0.0);  // within steps they are those of the step before
  begun_ = true;
  if (dynamic_) {
    const auto push = [this](double end_s, double dt_s, auto& presses) { step_actors(end_s, dt_s, presses); };
    dynamic_->update(time_s, viewer, push);
  } else if (!anew) {
    std::vector<WaveSource> nowhere;
    for (std::int64_t step = step_ + 1; step <= now; ++step) {
      step_actors(double(step) / rate, 1.0 / rate, nowhere);
      nowhere.clear();
    }
  }
  step_ = now;
  time_s_ = time_s;
  const double since_s = time_s - double(now) / rate;
  if (wakes_) wakes_->look_ahead(since_s > 1e-6 ? since_s : 0.0);  // what a sum of frame times loses is no time
  if (changing()) follow_change(ticks);
}

void Sea::go_on() {
  goes_on_ = true;
  if (dynamic_) dynamic_->go_on();
}

void Sea::change(const SeaState& state, double over_s, MakePlace place) {
  assert(grows_out_of(spec_.state, state));
  if (!spec_.has_waves) {
    spec_.state = state;
    return;
  }
  if (!maker_) maker_ = std::make_unique<SeaMaker>(bins_.ladder, all_waves);
  if (shallows_ && !place)
    place = [sources = spec_.sources, inputs = spec_.place](const SeaState& sea, const WaveBins& bins) {
      return std::make_shared<MadePlace>(MadePlace{make_shallows(sea, bins, sources, inputs), nullptr});
    };
  maker_->ask(state, spec_.drawn, shallows_ ? std::move(place) : nullptr);
  drawn_changed_ = false;
  spec_.state = state;
  change_s_ = over_s;
  asked_for_ = true;
}

void Sea::follow_change(std::int64_t ticks) {
  // What a bed makes of the waves passes from one sea to one other: over a bed a further sea waits for the change that
  // runs.
  const bool waits = blend_ && shallows_;
  if (std::optional<MadeSea> made = waits || !maker_ ? std::nullopt : maker_->take()) {
    const bool same_waves = seed_ == made->state.seed;
    seed_ = same_waves ? seed_ : std::nullopt;  // two seas' waves at once, until the change is over
    if (drawn_changed_) made->statistics = statistics_in(made->state, made->bins, spec_.drawn);
    MadeSea now{made->state, bins_, statistics_};
    made_place_ = std::move(made->place);
    now.state.chop = chop_;
    blend_.emplace(std::move(now), std::move(*made), ticks,
                   ticks + std::max<std::int64_t>(1, ticks_from_seconds(change_s_)), same_waves);
    asked_for_ = false;
    blended_at_.reset();
    if (made_place_ != nullptr) shallows_.to = made_place_->shallows, shallows_.share = 0.0;
  }
  if (blend_ && blended_at_ != ticks) take_waves(ticks);
}

void Sea::take_waves(std::int64_t ticks) {
  blended_at_ = ticks;
  const bool over = blend_->over(ticks);
  if (shallows_.to != nullptr && over) {
    shallows_ = {std::move(shallows_.to), nullptr};
    made_place_.reset();
  } else if (shallows_.to != nullptr) {
    shallows_.share = std::min(blend_->share(ticks), 0x1.fffffep-1);
  }
  blend_->amplitudes(ticks, bins_);
  if (drawn_bins_) drawn_bins_ = kept_bins(bins_, spec_.drawn);
  statistics_ = blend_->statistics(ticks);
  chop_ = blend_->chop(ticks);
  ++waves_version_, ++bins_version_;
  // Who holds a view keeps the waves that it has.
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    std::shared_ptr<WaveField>& field = fields_[i];
    if (field == nullptr) continue;
    if (field.use_count() > 1) field = std::make_shared<WaveField>(*field);
    field->take(bins_, chop_, statistics_);
    left_out_m_[i] = std::sqrt(left_out_variance(bins_, spec_.quality(SeaDetail(i))));
  }
  if (shallows_) {
    if (places_.use_count() > 1) places_ = std::make_shared<PlaceSea>(*places_);
    places_->follow(shallows_);
  }
  if (!over) return;
  waves_of_ = blend_->to().state;
  seed_ = waves_of_.seed;
  blend_.reset();
}

bool Sea::takes(const SeaSpec& spec) const {
  TileSources sources = spec.sources;
  std::erase_if(sources, [](const auto& source) { return source->still(); });
  const auto same_targets = [](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return x->target() == y->target(); });
  };
  const auto fit = [](const DynamicWavesSettings& a, const DynamicWavesSettings& b) {
    return a.windows == b.windows && a.gravity_mps2 == b.gravity_mps2 && a.depth_m == b.depth_m;
  };
  return spec.has_waves == spec_.has_waves && grows_out_of(spec_.state, spec.state) &&
         std::equal(sources.begin(), sources.end(), spec_.sources.begin(), spec_.sources.end(),
                    [](const auto& a, const auto& b) { return alike(*a, *b); }) &&
         same_targets(spec.place.kinds, spec_.place.kinds) &&
         same_targets(spec.place.following, spec_.place.following) && spec.place.volumes == spec_.place.volumes &&
         (spec.place.shore == nullptr) == (spec_.place.shore == nullptr) &&
         spec.dynamic_waves.has_value() == spec_.dynamic_waves.has_value() &&
         (!spec.dynamic_waves || fit(spec.dynamic_waves->waves, spec_.dynamic_waves->waves)) &&
         spec.wakes.has_value() == spec_.wakes.has_value() &&
         (!spec.wakes || fit(spec.wakes->waves, spec_.wakes->waves)) && spec.actors_foam == spec_.actors_foam;
}

void Sea::apply(SeaSpec spec, MakePlace place) {
  assert(takes(spec));
  validate(spec.place.settings);
  if (dynamic_) {
    dynamic_->apply(*spec.dynamic_waves);
    spec_.dynamic_waves = spec.dynamic_waves;
    step_ = dynamic_->tick();
    bodies_.set_step(1.0 / dynamic_->rate_hz());
  }
  if (wakes_) {
    wakes_->apply(stepped(*spec.wakes, dynamic_.get()));
    spec_.wakes = spec.wakes;
  }
  std::erase_if(spec.sources, [](const auto& source) { return source->still(); });
  const PlaceSettings &now = spec.place.settings, &was = spec_.place.settings;
  const bool other_sources = spec.sources != spec_.sources, other_level = now.level_m != was.level_m,
             other_places = other_level || now.clip_by_default != was.clip_by_default ||
                            now.flow_to_deg != was.flow_to_deg || now.flow_mps != was.flow_mps ||
                            now.flow_period_s != was.flow_period_s || spec.place.shore != spec_.place.shore;
  if (!other_sources && !other_places) return;
  const LodWindowSettings windows = was.windows;  // the picture's (draw_in)
  spec_.place = std::move(spec.place);
  spec_.place.settings.windows = windows;
  ++waves_version_;
  if (other_sources) take_sources(std::move(spec.sources));
  if (shallows_ && (other_sources || other_level)) {
    constexpr double over_s = 1.0;
    if (spec_.has_waves)
      change(spec_.state, changing() ? std::max(change_s_, over_s) : over_s, std::move(place));
    else
      shallows_ = {make_shallows(spec_.state, bins_, spec_.sources, spec_.place), nullptr};
  }
  take_places();
}

// Who holds a view keeps the sources that it has.
void Sea::take_sources(TileSources sources) {
  spec_.sources = std::move(sources);
  for (std::shared_ptr<WaveField>& field : fields_) {
    if (field == nullptr) continue;
    if (field.use_count() > 1) field = std::make_shared<WaveField>(*field);
    field->feed(spec_.sources);
  }
}

void Sea::take_places() {
  places_ = std::make_shared<PlaceSea>(spec_.place, *fields_[std::size_t(SeaDetail::drawn)], shallows_);
}

void Sea::draw_in(const WaveQuality& drawn, const PlaceSettings& place) {
  PlaceSettings& placed = spec_.place.settings;
  placed.windows = place.windows;
  placed.sand = place.sand;
  placed.growth_m = place.growth_m;
  const bool same = drawn.resolution == spec_.drawn.resolution && drawn.cascades == spec_.drawn.cascades;
  if (spec_.has_waves) spec_.drawn = drawn;
  if (spec_.has_waves && !same) {
    draw_other_waves();
    fields_[std::size_t(SeaDetail::drawn)].reset();
    make_field(SeaDetail::drawn);
  }
  take_places();
}

void Sea::draw_other_waves() {
  drawn_bins_ = keeps_all(spec_.drawn, bins_) ? std::nullopt : std::optional(kept_bins(bins_, spec_.drawn));
  if (blend_) {
    blend_->measure(spec_.drawn);
    statistics_ = blend_->statistics(blended_at_.value_or(ticks_from_seconds(time_s_)));
  } else {
    statistics_ = sea_statistics(waves_of_, bins());
  }
  drawn_changed_ = true;
  ++waves_version_, ++bins_version_;
}

void Sea::know_velocity(SeaDetail detail, bool known) {
  (detail == SeaDetail::drawn    ? spec_.drawn_velocity
   : detail == SeaDetail::crests ? spec_.crests_velocity
                                 : spec_.felt_velocity) = known;
  know_dynamic_velocity();
}

void Sea::know_dynamic_velocity() {
  const bool known = spec_.drawn_velocity || spec_.crests_velocity || spec_.felt_velocity;
  if (dynamic_) dynamic_->know_velocity(known);
  if (wakes_) wakes_->know_velocity(known);
}

void Sea::keep_drawn_in(std::span<const WaveTiles::Lent> memories, const WaveTileLayout& layout) {
  moments_.keep_drawn_in(memories, layout, spec_.drawn.cascades);
}

std::uint64_t Sea::hash() const {
  std::uint64_t hash = 14695981039346656037ull;
  hash = mixed(hash, std::uint64_t(dynamic_ ? dynamic_->tick() : step_));
  for (int i = 0; dynamic_ && i < dynamic_->waves().levels(); ++i)
    for (const std::complex<double>& mode : dynamic_->waves().level(i).modes())
      hash = mixed(mixed(hash, mode.real()), mode.imag());
  if (wakes_) wakes_->each_number([&](auto number) { hash = mixed(hash, number); });
  for (const auto& actor : actors_) hash = mixed(hash, actor->hash());
  return bodies_.mixed_into(hash);
}

}  // namespace seascape
