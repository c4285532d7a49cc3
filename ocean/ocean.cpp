#include "ocean/ocean.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "ocean/foam/crest_steps.h"
#include "ocean/mesh/quadtree.h"
#include "ocean/mesh/tree_frame.h"
#include "ocean/mesh/water_below.h"
#include "ocean/surface/water_types.h"
#include "shaders/shared/skirt.h"

namespace seascape {

namespace {
double foam_life_s(const OceanSettings& settings) {
  return settings.foam ? settings.foam->settings.life_s : FoamSettings{}.life_s;
}
bool wants_spray(const OceanSettings& settings) { return settings.spray && settings.spray->amount > 0.0; }
}  // namespace

template <class Piece>
Piece* Ocean::add(std::unique_ptr<Piece> piece) {
  Piece* const added = piece.get();
  pieces_.push_back(std::move(piece));
  return added;
}

Ocean::Ocean(Device& device, ShaderLibrary& shaders, Sea& sea, const OceanSettings& settings, OceanState before)
    : sea_(sea), settings_(settings), mesher_(std::make_unique<Quadtree>(settings.lod)) {
  const SeaSpec& spec = sea.spec();
  waves_ = add(std::make_unique<DrawnWaves>(device, shaders, sea, settings.wave_place, settings.water.anisotropy,
                                            Frame::slots + int(settings.seen_elsewhere)));
  for (const auto& source : spec.sources)
    sources_.push_back(add(std::make_unique<DrawnSource>(device, source, waves().half_storage())));
  measure_sources();
  if (sea.dynamic_waves()) dynamic_waves_ = add(std::make_unique<DrawnDynamicWaves>(device, *spec.dynamic_waves));
  if (sea.wakes()) wakes_ = add(std::make_unique<DrawnWakes>(device, *spec.wakes));
  if (!spec.place.empty()) place_ = add(std::make_unique<DrawnPlace>(device, sea));
  if (wants_foam(settings)) {
    if (before.foam != nullptr && &before.foam->sea() == &sea &&
        before.foam->settings().windows == settings.foam->settings.windows)
      before.foam->apply(settings.foam->settings);
    else  // waves along curves are not drawn by every device (DrawnShore)
      before.foam =
          std::make_unique<FoamSea>(*settings.foam, sea, device.facts().float32_linear ? spec.place.shore : nullptr);
    foam_ = add(std::make_unique<DrawnFoam>(device, std::move(before.foam)));
  }
  if (!wants_spray(settings)) return;
  spray_ = std::move(before.spray);
  if (spray_ != nullptr && &spray_->sea() == &sea && spray_->settings().most == settings.spray->most)
    spray_->apply(*settings.spray, foam_life_s(settings));
  else
    spray_ = std::make_unique<Spray>(*settings.spray, sea, foam_life_s(settings));
}

void Ocean::measure_sources() {
  const SeaSpec& spec = sea_.spec();
  of_sources_ = {};
  source_error_ = {};
  for (const auto& source : spec.sources) {
    const SourceStatistics s = source->along_curves() && spec.place.shore ? spec.place.shore->bent(source->statistics())
                                                                          : source->statistics();
    of_sources_.height_variance += s.height_variance;
    of_sources_.largest_height_m += s.largest_height_m;
    of_sources_.largest_shift_m += s.largest_shift_m;
    if (source->along_curves())
      source_error_.add_along_curves(s);
    else
      source_error_.add(*source);
  }
}

OceanState Ocean::give_up() {
  OceanState state{foam_ != nullptr ? foam_->give_up() : nullptr, std::move(spray_)};
  if (state.foam) state.foam->forget_views();
  if (state.spray) state.spray->forget_views();
  return state;
}

void Ocean::make_waves(Frame& frame, double time_s) { waves_->make(frame, time_s); }

void Ocean::live_through(Stages& stages, double time_s, const glm::dvec3& viewer_m) {
  step_together(foam_ != nullptr ? &foam_->sea() : nullptr, spray_.get(), time_s, viewer_m, stages);
}

void Ocean::update(Frame& frame, double time_s, const glm::dvec3& viewer_m) {
  Stages& stages = frame.stages();
  water_ = {};  // whose memory the next one may take
  stages.time("waves", [&] {
    make_waves(frame, time_s);
    // What is beneath the viewer: the picture's own waves where the processor makes them.
    water_ = waves_->by_processor() ? waves_->view() : sea_.view_at(time_s, SeaDetail::felt);
  });
  live_through(stages, time_s, viewer_m);
  const DrawnMoment moment{sea_, water_, time_s, viewer_m};
  for (const auto& piece : pieces_) stages.time(piece->stage(), [&] { piece->update(frame, moment); });
  near_.clear();
  const auto add_near = [&](const auto* drawn) {
    if (drawn) near_.insert(near_.end(), drawn->mesh_errors().begin(), drawn->mesh_errors().end());
  };
  add_near(dynamic_waves_);
  add_near(wakes_);
  std::stable_sort(near_.begin(), near_.end(), [](const auto& a, const auto& b) { return a.reach_m < b.reach_m; });
}

void Ocean::take(SeaSpec spec) {
  const TileSources before = sea_.spec().sources;
  MakePlace place = place_ ? place_->remake(spec.place, spec.sources) : nullptr;
  sea_.apply(std::move(spec), std::move(place));
  if (sea_.spec().sources != before) measure_sources();
  for (const auto& piece : pieces_) piece->take(sea_);
  if (foam_) foam_->sea().take_sea();
}

void Ocean::change(const SeaState& state, double over_s) {
  sea_.change(state, over_s, place_ ? place_->remake(sea_.spec().place, sea_.spec().sources) : nullptr);
}

WaterReach Ocean::others_reach() const {
  WaterReach reach{most_share() * of_sources_.largest_height_m, most_share() * of_sources_.largest_shift_m};
  for (const auto& piece : pieces_) {
    const WaterReach own = piece->reach();
    reach.height_m += own.height_m;
    reach.shift_m += own.shift_m;
  }
  return reach;
}
bool Ocean::waves_alone() const { return sources_.empty() && !dynamic_waves_ && !wakes_ && !place_; }
double Ocean::most_share() const { return place_ && sea_.shallows() ? sea_.shallows().most_share() : 1.0; }
double Ocean::land_m() const { return place_ ? place_->land_m() : 0.0; }

void Ocean::add_uses(Uses& uses) const {
  for (const auto& piece : pieces_) piece->add_uses(uses);
}

DisplacementBounds Ocean::bounds(const Viewpoint& viewpoint) const {
  const WaterReach others = others_reach();
  DisplacementBounds result;
  result.vertical_m = settings_.lod.max_height_m > 0.0
                          ? settings_.lod.max_height_m
                          : most_share() * sea_.statistics().largest_height_m + others.height_m + land_m();
  result.horizontal_m = most_share() * sea_.statistics().largest_shift_m + others.shift_m;
  result.mesh_error = sea_.statistics().mesh_error;
  if (water_ && sea_.spec().has_waves)
    result.below =
        water_below(water_.field(), water_.tiles(), viewpoint.viewer.position_m, sea_.statistics().near_motion);
  if (result.below && !waves_->by_processor()) {
    // The felt water is known, another one is drawn: each lacks some waves that the other may have.
    const double apart_m = std::hypot(sea_.left_out_m(SeaDetail::felt), sea_.left_out_m(SeaDetail::drawn));
    result.below->motion.add(apart_m, sea_.chop());
  }
  if (waves_alone()) return result;
  result.mesh_error = source_error_.with(result.mesh_error);
  result.near = near_;
  if (!result.below) return result;
  // Water anywhere may be off by all that the others do, and shallow water stands anywhere between none of its waves
  // and the most that a bed makes of them.
  const double most_m = place_ && sea_.shallows() ? most_share() * sea_.statistics().largest_height_m : 0.0;
  const double furthest_m = place_ && sea_.shallows() ? most_share() * sea_.statistics().largest_shift_m : 0.0;
  constexpr double largest_deviations = 5.0;
  for (std::size_t n = 0; n < result.below->off.vertical_m.size(); ++n) {
    const double land_m =
        place_ && sea_.shallows() ? place_->land_m(std::ldexp(NearMotion::least_distance_m, int(n))) : 0.0;
    result.below->off.vertical_m[n] = others.height_m + most_m + land_m;
    result.below->off.horizontal_m[n] = others.shift_m + furthest_m;
    double& moved = result.below->motion.horizontal_m[n];
    moved = std::hypot(moved, others.shift_m / largest_deviations);
  }
  return result;
}

const SurfaceSelection& Ocean::select(const Viewpoint& viewpoint, double coarser) {
  LodSettings lod = settings_.lod;
  lod.pixel_error = std::min(coarser * lod.pixel_error, 64.0);
  lod.threshold = std::min(coarser * lod.threshold, 4.0);
  selection_ = &select(viewpoint, *mesher_, lod);
  return *selection_;
}

const SurfaceSelection& Ocean::select(const Viewpoint& viewpoint, Mesher& mesher, const LodSettings& lod) const {
  mesher.apply(lod);
  MeshWater water(bounds(viewpoint));
  const SeaView& drawn = waves_->view();
  if (drawn && waves_alone()) {
    water.field = &drawn.field();
    water.tiles = &drawn.tiles();
  }
  if (place_ && place_->clips())
    water.gone = [&](glm::dvec2 least, glm::dvec2 most) {
      return place_->clipped(least, most, water.bounds.vertical_m);
    };
  return mesher.select(viewpoint, water);
}

double sight_in_water_m(const gpu::FrameData& data) {
  const glm::vec3 dims = glm::vec3(data.water_absorption) + glm::vec3(data.water_backscatter);
  return 7.0 / double(std::min({dims.x, dims.y, dims.z}));
}

template <class Kept>
const SurfaceSelection& Ocean::keep(const Kept& kept) {
  const SurfaceSelection& all = *selection_;
  within_sight_.mesh = all.mesh;
  within_sight_.unit_m = all.unit_m;
  within_sight_.grid_origin_m = all.grid_origin_m;
  within_sight_.patches.resize(all.patches.size());
  const auto end = std::copy_if(all.patches.begin(), all.patches.end(), within_sight_.patches.begin(), kept);
  within_sight_.patches.resize(std::size_t(end - within_sight_.patches.begin()));
  return within_sight_;
}

const SurfaceSelection& Ocean::within_sight(const Viewpoint& viewpoint, const gpu::FrameData& data) {
  const SurfaceSelection& all = *selection_;
  const double sight_m = sight_in_water_m(data) + double(data.sea.footprint.x);  // which is more than water moves
  const glm::dvec2 viewer =
      (glm::dvec2(viewpoint.viewer.position_m.x, viewpoint.viewer.position_m.z) - all.grid_origin_m) / all.unit_m;
  return keep([&](const gpu::PatchInstance& patch) {
    if ((patch.flags & gpu::patch_skirt) != 0u) return false;
    const glm::dvec2 least(patch.corner), most = least + double(gpu::patch_quads * patch.stride);
    return glm::length(glm::clamp(viewer, least, most) - viewer) * all.unit_m <= sight_m;
  });
}

const SurfaceSelection& Ocean::within_portals(const Viewpoint& viewpoint, const PortalSight& portals) {
  const SurfaceSelection& all = *selection_;
  const DisplacementBounds most = bounds(viewpoint);
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  return keep([&](const gpu::PatchInstance& patch) {
    if ((patch.flags & gpu::patch_skirt) != 0u) return true;
    const double half_m = 0.5 * gpu::patch_quads * patch.stride * all.unit_m;
    const glm::dvec2 middle =
        all.grid_origin_m + glm::dvec2(patch.corner) * all.unit_m + half_m - glm::dvec2(viewer.x, viewer.z);
    const double far_m = glm::length(middle) + 2.0 * half_m;
    return portals.may_show({middle.x, -viewer.y, middle.y}, std::hypot(std::numbers::sqrt2 * half_m, most.vertical_m) +
                                                                 most.horizontal_m + curvature_drop(far_m * far_m));
  });
}

const SurfaceSelection* Ocean::select_bed(const Viewpoint& viewpoint, const PortalSight* portals,
                                          gpu::FrameData& data) {
  if (!place_ || !place_->has_bed()) return nullptr;
  BedInSight bed;
  bed.sight_m = std::min(sight_in_water_m(data), bed.sight_m);
  const glm::dvec2 range_m = place_->bed_m(bed.sight_m);
  bed.lowest_m = std::max(range_m.x, viewpoint.viewer.position_m.y - bed.sight_m);
  bed.highest_m = std::max(std::min(range_m.y, highest_m()), bed.lowest_m);  // what is higher the surface hides
  bed.earth_curvature = settings_.lod.earth_curvature;
  bed.portals = portals;
  const SurfaceSelection& selected = bed_mesh_.select(viewpoint, bed);
  data.bed_mesh = selected.mesh;
  data.bed_mesh.from_grid = glm::vec2(selected.grid_origin_m - selection_->grid_origin_m);
  return &selected;
}

double Ocean::highest_m() const { return most_share() * sea_.statistics().largest_height_m + others_reach().height_m; }

bool Ocean::eyes_in_air(const Viewpoint& viewpoint) const {
  constexpr double margin_m = 0.5;  // the near plane reaches less far
  const WaterReach others = others_reach();
  return std::all_of(viewpoint.eyes.begin(), viewpoint.eyes.end(), [&](const View& eye) {
    const glm::dvec3& place = eye.pose.position_m;
    if (place.y > most_share() * sea_.statistics().largest_height_m + others.height_m + land_m() + margin_m)
      return true;
    if (!waves_->by_processor() || place.y < margin_m || most_share() > 1.0) return false;
    const QueryAnswer water = waves_->view().query({place.x, place.z});
    return water.converged && place.y > water.height_m + others.height_m + margin_m;
  });
}

Ocean::EyesSide Ocean::eyes_in(const Viewpoint& viewpoint, double reach_m) const {
  const double highest_m = this->highest_m() + land_m() + reach_m;
  if (std::all_of(viewpoint.eyes.begin(), viewpoint.eyes.end(),
                  [&](const View& eye) { return eye.pose.position_m.y > highest_m; }))
    return {};
  constexpr double deviations = 5.0;  // one place in two million lacks more
  const double apart_m =
      reach_m + deviations * std::hypot(sea_.left_out_m(SeaDetail::felt), sea_.left_out_m(SeaDetail::drawn));
  const SeaView felt = sea_.view_at(sea_.time_s(), SeaDetail::felt);
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  const QueryAnswer at_viewer = felt.query({viewer.x, viewer.z});
  EyesSide side{.still_m = at_viewer.still_m, .over_viewer_m = at_viewer.clipped ? 0.0 : at_viewer.height_m - viewer.y};
  int above = 0, below = 0;
  double corner = 1.0;  // how far one of a near plane is, over how far the plane is
  for (const View& eye : viewpoint.eyes)
    for (const double across : {eye.fov.left, eye.fov.right})
      for (const double up : {eye.fov.up, eye.fov.down}) corner = std::max(corner, std::hypot(1.0, across, up));
  for (const View& eye : viewpoint.eyes) {
    const glm::dvec3& place = eye.pose.position_m;
    const QueryAnswer water = felt.query({place.x, place.z});
    // At the horizon each millimetre counts: there the picture's own waves are asked, where the processor has them.
    const QueryAnswer drawn = waves_->by_processor() && waves_alone() ? water_.query({place.x, place.z}) : water;
    if (const auto n = std::size_t(&eye - viewpoint.eyes.data()); n < side.over_eye.size()) {
      side.over_eye[n] = {drawn.height_m - place.y, -drawn.normal.x / drawn.normal.y, -drawn.normal.z / drawn.normal.y};
      const double unsure_m = waves_->by_processor() && waves_alone() ? 0.0 : apart_m - reach_m,
                   folded_m = drawn.converged ? 0.0 : 0.5;
      side.near[n] = near_water(eye, reach_m / corner, reach_m, side.over_eye[n], unsure_m);
      side.near[n].rest_m += glm::dvec2(place.x - drawn.displacement.x, place.z - drawn.displacement.z);
      side.near[n].half_m += drawn.residual_m + folded_m;
      if (!water.clipped) side.depth_m[n] = side.over_eye[n].x;
    }
    above += water.clipped || (water.converged && place.y > water.height_m + apart_m);
    below += !water.clipped && water.converged && place.y < water.height_m - apart_m;
  }
  const int all = int(viewpoint.eyes.size());
  side.eyes = above == all ? EyesIn::air : below == all ? EyesIn::water : EyesIn::either;
  side.from_above = side.eyes != EyesIn::water;
  return side;
}

bool Ocean::wants_foam(const OceanSettings& settings) const {
  return settings.foam &&
         keeps_foam(*settings.foam, bool(sea_.shallows()), dynamic_waves_ || wakes_, sea_.spec().actors_foam);
}

bool Ocean::takes(const OceanSettings& settings) const {
  return wants_foam(settings) == (foam_ != nullptr) && wants_spray(settings) == (spray_ != nullptr);
}

void Ocean::apply(const OceanSettings& settings) {
  if (foam_) validate(settings.foam->settings);  // before anything changes
  if (spray_) validate(*settings.spray);
  mesher_->apply(settings.lod);
  if (foam_) foam_->sea().apply(settings.foam->settings);
  if (spray_) spray_->apply(*settings.spray, foam_life_s(settings));
  if (place_) place_->apply(settings.place);
  settings_ = settings;
}

void Ocean::describe(gpu::FrameData& data, const Viewpoint& viewpoint, const SurfaceSelection& selection) const {
  const SurfaceSelection& s = selection;
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  for (const auto& piece : pieces_) piece->describe(data, s.grid_origin_m);
  data.sea.footprint.y = settings_.baked_fade_m > 0.0 ? float(1.0 / settings_.baked_fade_m) : 0.0f;
  const WaterReach others = others_reach();
  data.sea.footprint.z += float(others.height_m + land_m());
  // Twice the bound, which is of a normal sea, and one in ten thousand may pass it.
  data.sea.footprint.x =
      float(std::max(2.0 * (most_share() * sea_.statistics().largest_shift_m + others.shift_m), 0.01));
  data.viewer = glm::vec4(float(viewer.x - s.grid_origin_m.x), float(viewer.z - s.grid_origin_m.y), float(viewer.y),
                          settings_.lod.earth_curvature ? 1.0f / gpu::earth_radius_m : 0.0f);
  data.mesh = s.mesh;
  data.sea.footprint.w = float(4.0 * std::sqrt(sea_.statistics().height_variance + of_sources_.height_variance));
  const WaterOptics optics = water_optics(settings_.water);
  data.water_absorption = glm::vec4(glm::vec3(optics.absorption), float(settings_.water.crest_light));
  data.water_backscatter = glm::vec4(glm::vec3(optics.backscatter), float(settings_.water.glitter));
  data.water_reflectance = glm::vec4(glm::vec3(radiance_from_below(optics)), float(sun_share_entering(data.sun.y)));
  data.water_scattering = glm::vec4(glm::vec3(optics.scattering), 0.0f);
  data.whitecap = glm::vec4(float(settings_.water.whitecaps), 0.4f, 0.0f, 0.0f);
}

}  // namespace seascape
