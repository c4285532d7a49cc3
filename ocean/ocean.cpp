#include "ocean/ocean.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "ocean/mesh/water_below.h"
#include "ocean/surface/water_optics.h"
#include "shaders/shared/skirt.h"

namespace seascape {

namespace {
bool on_gpu(const Device& device, WavePlace place) {
  return place == WavePlace::gpu || (place == WavePlace::automatic && !device.facts().software);
}

FoamSea::Water still_water(std::shared_ptr<const Shallows> shallows) {
  return [shallows = std::move(shallows)](glm::dvec2 place, double texel) {
    const double depth = shallows->still_m(place, texel, 0.0) - shallows->bed_m(place, texel, 0.0);
    const PlaceWaves waves = shallows->waves(place, depth);
    const Shallows::Placed placed = shallows->placed(place, depth);
    return StillWater{depth, double(std::max(waves.share[0], waves.swash)), shallows->surf(place, depth), placed.share,
                      placed.surf};
  };
}
}  // namespace

Ocean::Ocean(Device& device, ShaderLibrary& shaders, const OceanSettings& settings)
    : settings_(settings),
      bins_(settings.has_waves ? make_wave_bins(settings.sea, settings.waves) : WaveBins{ladder(settings.sea), 0, {}}),
      statistics_(settings.has_waves ? sea_statistics(settings.sea, bins_) : SeaStatistics{}),
      waves_(device, settings.sea, settings.waves, bins_, statistics_, settings.water.anisotropy,
             on_gpu(device, settings.wave_place) ? WaveImages::Filled::stored : WaveImages::Filled::written),
      chop_(settings.sea.chop),
      drawn_seed_(settings.sea.seed),
      quadtree_(settings.lod) {
  if (!settings.has_waves) {
    // Nothing computes them.
  } else if (on_gpu(device, settings.wave_place)) {
    compute_ = std::make_unique<WaveCompute>(device, shaders, settings.sea, bins_, waves_);
    const WaveQuality longest{64, std::min(2, settings.waves.cascades)};  // waves of some 6 m and more
    long_waves_ = std::make_unique<WaveField>(settings.sea, longest);
  } else {
    upload_ = std::make_unique<WaveUpload>(device, settings.sea, settings.waves, bins_, waves_);
  }
  for (const auto& source : settings.sources) {
    if (source->still()) continue;
    sources_.push_back(std::make_unique<DrawnSource>(device, source, waves_.half_storage()));
    const SourceStatistics s = source->along_curves() && settings.place.shore
                                   ? settings.place.shore->bent(source->statistics())
                                   : source->statistics();
    of_sources_.height_variance += s.height_variance;
    of_sources_.largest_height_m += s.largest_height_m;
    of_sources_.largest_shift_m += s.largest_shift_m;
    if (source->along_curves())
      source_error_.add_along_curves(s);
    else
      source_error_.add(*source);
  }
  const bool pressed = settings.pressure && !settings.pressure->empty();
  if (settings.dynamic_waves && !still(*settings.dynamic_waves, pressed))
    dynamic_waves_ = std::make_unique<DrawnDynamicWaves>(device, *settings.dynamic_waves, settings.pressure);
  if (!settings.place.empty())
    place_ = std::make_unique<DrawnPlace>(device, settings.place,
                                          make_shallows(settings.sea, bins_, settings.sources, settings.place),
                                          settings.sea.depth_m);
  if (settings.foam && keeps_foam(*settings.foam, bool(shallows()), dynamic_waves_ != nullptr)) {
    TileSources moving = settings.sources;
    const bool along_curves =
        settings.place.shore != nullptr && device.facts().float32_linear;  // or else they are not drawn (DrawnShore)
    if (!along_curves) std::erase_if(moving, [](const auto& source) { return source->along_curves(); });
    foam_ = std::make_unique<DrawnFoam>(device, *settings.foam, settings.sea, settings.waves, std::move(moving),
                                        along_curves ? settings.place.shore : nullptr);
    if (shallows()) foam_->sea().set_water(still_water(shallows().from));
  }
  if (settings.spray && settings.spray->amount > 0.0) make_spray();
}

void Ocean::make_spray() {
  const double foam_life_s = settings_.foam ? settings_.foam->settings.life_s : FoamSettings{}.life_s;
  spray_ = std::make_unique<Spray>(*settings_.spray, settings_.sea, settings_.waves, settings_.sources, foam_life_s);
  const std::shared_ptr<const Inputs> level = settings_.place.of(InputTarget::level),
                                      clip = settings_.place.of(InputTarget::clip);
  const std::shared_ptr<const ClipVolumes> volumes = settings_.place.volumes;
  if (!level && !clip && !volumes && !shallows()) return;
  spray_->set_water(
      [level, clip, volumes, bed = place_.get(), place = settings_.place.settings](glm::dvec2 at, double time_s) {
        constexpr double footprint_m = 1.0;
        const auto value = [&](const std::shared_ptr<const Inputs>& inputs, InputTarget kind) {
          return double(inputs->value(at, footprint_m, time_s, place_outside(place, kind)).x);
        };
        Spray::Water water;
        if (level) water.still_m = value(level, InputTarget::level);
        if (const ShallowsMix& mix = bed->shallows()) {
          water.depth_m = mix.from->still_m(at, footprint_m, time_s) - mix.bed_m(at, footprint_m, time_s);
          water.waves = double(mix.waves(at, water.depth_m).share[0]);
        }
        const bool dry = clip && value(clip, InputTarget::clip) > 0.5;
        if (volumes ? volumes->clipped({at.x, water.still_m, at.y}, dry) : dry) water.depth_m = 0.0;
        return water;
      });
}

ShallowsMix Ocean::shallows() const { return place_ ? place_->shallows() : ShallowsMix{}; }

void Ocean::update(Frame& frame, double time_s, const glm::dvec3& viewer_m) {
  const std::int64_t ticks = ticks_from_seconds(time_s);
  if (changing()) follow_change(frame, ticks);
  if (compute_) compute_->update(frame, ticks);
  if (upload_) upload_->update(frame, ticks);
  for (const auto& source : sources_) source->update(frame, ticks);
  if (long_waves_ && long_ticks_ != ticks) {
    long_waves_->evaluate(ticks, long_tiles_);
    long_ticks_ = ticks;
  }
  if (dynamic_waves_) dynamic_waves_->update(frame, time_s, viewer_m);
  if (place_) place_->update(frame, time_s, viewer_m);
  if (foam_) foam_->update(frame, time_s, viewer_m, dynamic_waves_ ? &dynamic_waves_->sea().surface() : nullptr);
  if (spray_) spray_->update(time_s, viewer_m);
  time_s_ = time_s;
}

double Ocean::others_height_m() const {
  return most_share() * of_sources_.largest_height_m + (dynamic_waves_ ? dynamic_waves_->height_m() : 0.0) +
         (place_ ? place_->level_m() : 0.0);
}
double Ocean::most_share() const { return place_ && place_->shallows() ? place_->shallows().most_share() : 1.0; }
double Ocean::land_m() const { return place_ ? place_->land_m() : 0.0; }
double Ocean::others_shift_m() const {
  return most_share() * of_sources_.largest_shift_m + (dynamic_waves_ ? dynamic_waves_->shift_m() : 0.0);
}

void Ocean::add_uses(Uses& uses) const {
  waves_.add_reads(uses);
  for (const auto& source : sources_) source->add_uses(uses, Access::surface_read);
  if (dynamic_waves_) dynamic_waves_->add_uses(uses, Access::surface_read);
  if (place_) place_->add_uses(uses, Access::surface_read);
  if (foam_) foam_->add_uses(uses, Access::surface_read);
}

void Ocean::change(const SeaState& sea, double over_s) {
  assert(grows_out_of(settings_.sea, sea));
  if (!settings_.has_waves) {
    settings_.sea = sea;
    return;
  }
  if (!maker_) maker_ = std::make_unique<SeaMaker>(bins_.ladder, settings_.waves);
  maker_->ask(sea, place_ ? place_->remake(settings_.place, settings_.sources) : nullptr);
  settings_.sea = sea;
  change_s_ = over_s;
  asked_for_ = true;
}

void Ocean::follow_change(Frame& frame, std::int64_t ticks) {
  // What a bed makes of the waves passes from one sea to one other: over a bed a further sea waits for the change that
  // runs.
  const bool waits = blend_ && shallows();
  if (std::optional<MadeSea> made = waits ? std::nullopt : maker_->take()) {
    const bool same_waves = drawn_seed_ == made->state.seed;
    drawn_seed_ = same_waves ? drawn_seed_ : std::nullopt;  // two seas' waves at once, until the change is over
    MadeSea now{made->state, bins_, statistics_};
    const std::shared_ptr<MadePlace> bed = std::move(made->place);
    now.state.chop = chop_;
    blend_.emplace(std::move(now), std::move(*made), ticks,
                   ticks + std::max<std::int64_t>(1, ticks_from_seconds(change_s_)), same_waves);
    asked_for_ = false;
    if (bed != nullptr) place_->begin_change(std::move(*bed));
  }
  if (!blend_) return;
  if (shallows().to) place_->change(blend_->over(ticks) ? 1.0 : std::min(blend_->share(ticks), 0x1.fffffep-1));
  blend_->amplitudes(ticks, bins_);
  statistics_ = blend_->statistics(ticks);
  chop_ = blend_->chop(ticks);
  waves_.take(bins_, chop_, statistics_);
  if (compute_) compute_->take(frame, bins_, chop_);
  if (upload_) upload_->take(bins_, chop_, statistics_);
  if (foam_) foam_->sea().take(bins_, chop_, statistics_, settings_.sea.wind_speed_mps);
  if (spray_) spray_->take(bins_, chop_, statistics_, settings_.sea);
  if (long_waves_) {
    long_waves_->take(bins_, chop_, statistics_);
    long_ticks_.reset();
  }
  if (!blend_->over(ticks)) return;
  if (foam_ && shallows()) foam_->sea().set_water(still_water(shallows().from));
  if (foam_) foam_->set_wind(settings_.sea);
  drawn_seed_ = blend_->to().state.seed;
  blend_.reset();
}

DisplacementBounds Ocean::bounds(const Viewpoint& viewpoint) const {
  DisplacementBounds result;
  result.vertical_m = settings_.lod.max_height_m > 0.0
                          ? settings_.lod.max_height_m
                          : most_share() * statistics_.largest_height_m + others_height_m() + land_m();
  result.horizontal_m = most_share() * statistics_.largest_shift_m + others_shift_m();
  result.mesh_error = statistics_.mesh_error;
  const WaveField* field = upload_ ? &upload_->field() : long_waves_.get();
  const WaveTiles* tiles = upload_ ? upload_->tiles() : long_ticks_ ? &long_tiles_ : nullptr;
  if (tiles != nullptr)
    result.below = water_below(*field, *tiles, viewpoint.viewer.position_m, statistics_.near_motion);
  if (sources_.empty() && !dynamic_waves_ && !place_) return result;
  result.mesh_error = source_error_.with(result.mesh_error);
  if (dynamic_waves_) result.near = dynamic_waves_->mesh_errors();
  if (!result.below) return result;
  // Water anywhere may be off by all that the others do, and shallow water stands anywhere between none of its waves
  // and the most that a bed makes of them.
  const double most_m = place_ && place_->shallows() ? most_share() * statistics_.largest_height_m : 0.0;
  const double furthest_m = place_ && place_->shallows() ? most_share() * statistics_.largest_shift_m : 0.0;
  constexpr double largest_deviations = 5.0;
  for (std::size_t n = 0; n < result.below->off.vertical_m.size(); ++n) {
    const double land_m =
        place_ && place_->shallows() ? place_->land_m(std::ldexp(NearMotion::least_distance_m, int(n))) : 0.0;
    result.below->off.vertical_m[n] = others_height_m() + most_m + land_m;
    result.below->off.horizontal_m[n] = others_shift_m() + furthest_m;
    double& moved = result.below->motion.horizontal_m[n];
    moved = std::hypot(moved, others_shift_m() / largest_deviations);
  }
  return result;
}

const SurfaceSelection& Ocean::select(const Viewpoint& viewpoint) {
  selection_ = &select(viewpoint, quadtree_);
  return *selection_;
}

const SurfaceSelection& Ocean::select(const Viewpoint& viewpoint, Quadtree& patches) const {
  patches.apply(settings_.lod);
  const bool all_here = upload_ && upload_->tiles() != nullptr && sources_.empty() && !dynamic_waves_ && !place_;
  const DisplacementBounds bounds = this->bounds(viewpoint);
  const SurfaceSelection& selection =
      patches.select(viewpoint, bounds, all_here ? &upload_->field() : nullptr, all_here ? upload_->tiles() : nullptr);
  if (place_ && place_->clips())
    patches.leave_out(
        bounds, [&](glm::dvec2 least, glm::dvec2 most) { return place_->clipped(least, most, bounds.vertical_m); });
  return selection;
}

bool Ocean::eyes_in_air(const Viewpoint& viewpoint) const {
  constexpr double margin_m = 0.5;  // the near plane reaches less far
  return std::all_of(viewpoint.eyes.begin(), viewpoint.eyes.end(), [&](const View& eye) {
    const glm::dvec3& place = eye.pose.position_m;
    if (place.y > most_share() * statistics_.largest_height_m + others_height_m() + land_m() + margin_m) return true;
    if (!upload_ || place.y < margin_m || most_share() > 1.0) return false;
    const QueryAnswer water = upload_->query({place.x, place.z});
    return water.converged && place.y > water.height_m + others_height_m() + margin_m;
  });
}

void Ocean::apply(const LodSettings& lod, const WaterSettings& water) {
  quadtree_.apply(lod);
  settings_.lod = lod;
  settings_.water = water;
}

void Ocean::describe(gpu::FrameData& data, const Viewpoint& viewpoint, const SurfaceSelection& selection) const {
  const SurfaceSelection& s = selection;
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  data.sea = waves_.sea_data(s.grid_origin_m);
  for (const auto& source : sources_) {
    const std::string_view name = source->source().name();
    const auto one = [](gpu::CascadeData& laid) { return std::span(&laid, 1); };
    source->describe(name == "baked"      ? one(data.sea.baked)
                     : name == "gerstner" ? one(source->source().along_curves() ? data.sea.shore : data.sea.gerstner)
                                          : std::span(data.sea.particles),
                     s.grid_origin_m);
  }
  data.sea.footprint.y = settings_.baked_fade_m > 0.0 ? float(1.0 / settings_.baked_fade_m) : 0.0f;
  if (dynamic_waves_) dynamic_waves_->describe(data.sea.dynamic, s.grid_origin_m);
  if (place_) place_->describe(data.sea.place, s.grid_origin_m, time_s_);
  if (foam_) foam_->describe(data.foam, s.grid_origin_m);
  data.sea.footprint.z += float(others_height_m() + land_m());
  // Twice the bound, which is of a normal sea, and one in ten thousand may pass it.
  data.sea.footprint.x = float(std::max(2.0 * (most_share() * statistics_.largest_shift_m + others_shift_m()), 0.01));
  data.viewer =
      glm::vec4(float(viewer.x - s.grid_origin_m.x), float(viewer.z - s.grid_origin_m.y), float(viewer.y), 0.0f);
  data.morph = s.morph;
  data.grid = glm::ivec4(s.tree_centre, s.skirt_rows, data.grid.w);
  data.skirt = glm::vec4(s.skirt_to_multiplier, s.skirt_to_horizon, float(s.unit_m),
                         settings_.lod.earth_curvature ? 1.0f / gpu::earth_radius_m : 0.0f);
  data.sea.footprint.w = float(4.0 * std::sqrt(statistics_.height_variance + of_sources_.height_variance));
  const WaterOptics optics = water_optics(settings_.water.chlorophyll_mg_m3);
  data.water_absorption = glm::vec4(glm::vec3(optics.absorption), float(settings_.water.crest_light));
  data.water_backscatter = glm::vec4(glm::vec3(optics.backscatter), float(settings_.water.glitter));
  data.water_reflectance = glm::vec4(glm::vec3(radiance_from_below(optics)), float(sun_share_entering(data.sun.y)));
  data.whitecap = glm::vec4(float(settings_.water.whitecaps), 0.4f, 0.0f, 0.0f);
}

}  // namespace seascape
