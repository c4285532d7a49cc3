#include "app/frame.h"

#include <algorithm>
#include <cmath>

#include "app/eyes_in_water.h"

namespace seascape {

namespace {

// Haze takes contrast down to 2 % at the visibility (Koschmieder 1924).
double extinction(double visibility_m) { return std::log(50.0) / visibility_m; }

gpu::ViewData view_data(const View& eye, const Pose& viewer, double near_m, std::uint32_t height) {
  gpu::ViewData data{};
  const glm::dmat4 projected = projection(eye.fov, near_m);
  data.clip_from_relative = glm::mat4(projected * eye_from_relative(eye.pose, viewer.position_m));
  const glm::dmat3 world(glm::mat3_cast(eye.pose.orientation));
  data.ray_x = glm::vec4(glm::vec3(world * glm::dvec3(1.0 / projected[0][0], 0.0, 0.0)), 0.0f);
  data.ray_y = glm::vec4(glm::vec3(world * glm::dvec3(0.0, 1.0 / projected[1][1], 0.0)), 0.0f);
  data.ray_z = glm::vec4(
      glm::vec3(world * glm::dvec3(projected[2][0] / projected[0][0], projected[2][1] / projected[1][1], -1.0)), 0.0f);
  data.eye = glm::vec4(glm::vec3(eye.pose.position_m - viewer.position_m), float((eye.fov.up - eye.fov.down) / height));
  return data;
}

// In a scene with portals the sea is drawn where it is seen through one. Eyes in the water see as far as its colour
// lets them.
const SurfaceSelection& in_sight(Experience& e, const SurfaceSelection& chosen, const Viewpoint& viewpoint,
                                 const gpu::FrameData& data, const Ocean::EyesSide& side) {
  static const SurfaceSelection none;
  if (e.shaped() && !e.scene().shapes.portals.empty())
    return side.eyes == EyesIn::air ? none : e.ocean().within_portals(viewpoint, side.portals);
  return side.eyes == EyesIn::water && !e.shaped() ? e.ocean().within_sight(viewpoint, data) : chosen;
}

// Where water is kept out it is dry at any depth under open air; a hull there hides the hole that it makes in the sea,
// so that through it nothing is seen from the water.
NearWaterSight water_near(Experience& e, const Ocean::EyesSide& side, const glm::dvec3& viewer_m,
                          const gpu::FrameData& data) {
  const DrawnPlace* const place = e.ocean().place();
  const bool holes = place != nullptr && place->field(InputTarget::clip) != nullptr,
             dry_hulls = place != nullptr && e.sea()->clip_volumes();
  NearWaterSight near{
      .highest_m = e.ocean().highest_m(),
      .from_above = side.from_above || (holes && side.eyes != EyesIn::air),
      .sight_m = e.shaped() || holes ? 1e9 : sight_in_water_m(data),  // air between shows what is farther
      .high_air = side.high_air || holes,
      .deep_air = dry_hulls,
      .portals = e.scene().shapes.portals.empty() ? nullptr : &side.portals};
  constexpr double over_m = 0.3;  // clear of ripples
  const double water_m = std::max(viewer_m.y + std::max(side.over_viewer_m, 0.0), side.still_m);
  if (side.eyes != EyesIn::air) near.middle_m = glm::dvec3(viewer_m.x, water_m + over_m, viewer_m.z);
  return near;
}

// What a frame of this quality has less of than the settings say, but for what is told where it is drawn.
void lower(Ocean& ocean, SunMap* sun_map, const DrawnQuality& quality) {
  ocean.step_foam_by(int(std::lround(1.0 / quality.foam)));
  if (sun_map) sun_map->draw_share(quality.shadows);
}

gpu::FrameData lowered(gpu::FrameData data, const DrawnQuality& quality) {
  data.air.w = std::max(1.0f, data.air.w * float(quality.anisotropy));
  return data;
}

ModelSettings drawn_models(const Scene& scene, const DrawnQuality& quality) {
  ModelSettings models = scene.settings.models;
  models.detail *= quality.detail;
  return models;
}

}  // namespace

gpu::FrameData frame_data(const Settings& settings, const Viewpoint& viewpoint, std::uint32_t height) {
  gpu::FrameData data{};
  for (std::size_t i = 0; i < viewpoint.eyes.size() && i < 2; ++i)
    data.view[i] = view_data(viewpoint.eyes[i], viewpoint.viewer, settings.render.near_m, height);
  data.sun = glm::vec4(glm::vec3(sun_direction(settings.sky)), float(std::cos(glm::radians(0.267))));
  data.air = glm::vec4(float(extinction(settings.sky.visibility_m)), float(settings.sky.exposure_ev),
                       float(settings.render.near_m), float(settings.water.anisotropy));
  data.shown.x = int(settings.render.debug);
  return data;
}

QueryAnswer water_at_camera(Experience& experience, const glm::dvec3& camera_m, double time_s) {
  constexpr double float_m = 0.5;  // what floats there is so large
  Sea& sea = *experience.sea();
  Stages& stages = experience.frame().stages();
  stages.time("sea", [&] { sea.advance(time_s, camera_m); });
  stages.time("waves", [&] { experience.ocean().make_waves(experience.frame(), time_s); });
  QueryAnswer answer;
  stages.time("queries", [&] {
    answer = sea.view_at(time_s, SeaDetail::felt).query({camera_m.x, camera_m.z}, {.footprint_m = float_m});
  });
  return answer;
}

void draw_frame(Experience& e, Frame& frame, const Viewpoint& viewpoint, double time_s) {
  const Settings& settings = e.scene_.settings;
  const glm::dvec3& viewer_m = viewpoint.viewer.position_m;
  Stages& stages = frame.stages();

  // 1. What the sea does: its change, those who act on it, dynamic waves around the viewer. Then what of it the GPU
  // needs: transforms or tiles, windows of places, foam. Each only if the scene asked for it.
  lower(*e.ocean_, e.sun_map_.get(), e.quality_);
  stages.time("sea", [&] { e.sea_->advance(time_s, viewer_m); });
  e.ocean_->update(frame, time_s, viewer_m);

  // 2. The light: only when sun or haze have changed.
  bool sky_is_new = false;
  stages.time("sky", [&] { sky_is_new = e.sky_->update(frame, settings.sky); });

  // 3. The patches for all eyes together, chosen by the viewer's head; what the shaders are told.
  const SurfaceSelection* selection = nullptr;
  stages.time("traversal", [&] { selection = &e.ocean_->select(viewpoint, e.quality_.mesh); });
  gpu::FrameData data = lowered(frame_data(settings, viewpoint, e.options_.height), e.quality_);
  e.ocean_->describe(data, viewpoint);
  if (e.bodies_) e.boat_shapes_->place(e.scene_.objects, *e.bodies_, time_s);
  Ocean::EyesSide side;
  if (e.underwater()) stages.time("queries", [&] { side = find_eyes(e, data, viewpoint); });
  const EyesIn eyes = side.eyes;
  if (e.solids_)
    stages.time("things", [&] {
      e.solid_surroundings_->update(frame, e.sky_->map(), data.water_reflectance, sky_is_new);
      e.solids_->update(frame, viewpoint, time_s, water_near(e, side, viewer_m, data),
                        drawn_models(e.scene_, e.quality_));
      e.solids_->describe(data);
      e.solids_->cast(data, viewpoint, drawn_models(e.scene_, e.quality_), time_s);
    });
  const std::uint32_t uniform = frame.upload_uniform(data);
  if (e.solids_) stages.time("recording", [&] { e.solids_->draw_sun_map(frame, uniform); });
  // What is drawn of the viewer himself, and over what he sees.
  if (e.hands_) e.hands_->update(frame, e.shown_hands_, e.shown_aim_, viewer_m);
  if (e.hidden_area_) e.hidden_area_->update(frame, viewpoint, e.hidden_mesh_);
  if (e.comfort_) e.comfort_->update(frame, viewpoint, e.comfort_shown_);
  if (e.underwater()) stages.time("queries", [&] { e.update_head(frame, viewpoint, side, time_s); });
  selection = &in_sight(e, *selection, viewpoint, data, side);
  const bool facing_only = settings.render.facing_only && eyes == EyesIn::air && e.ocean_->eyes_in_air(viewpoint);

  // 4. Spray, where there is any: what is to be seen of it at this moment.
  if (e.spray_)
    stages.time("spray", [&] { e.spray_->update(frame, *e.ocean_->spray(), time_s, viewer_m, e.quality_.spray); });

  // 5. Things in the water, for the surface to refract. Sea and things, the sky where none of them is, what lies over
  // them: in the tile the finished picture, else the lit one. Deferred: what the sea is in each pixel, then its light.
  const bool tile = e.in_tile(), deferred = e.deferred();
  const RenderTarget& drawn = tile ? e.picture_ : e.lit_;
  const Use probe =
      e.options_.probe ? use(e.surface_->probed(), Access::vertex_store) : use(e.sky_->light(), Access::surface_read);
  Uses uses{use(e.sky_->map(), Access::surface_read), use(e.sky_->light(), Access::surface_read), probe};
  e.ocean_->add_uses(uses);
  if (e.solids_) e.solids_->add_uses(uses);
  const auto record = [&](const char* name, const RenderTarget& target, const Uses& used, const auto& commands) {
    stages.time("recording", [&] { frame.draw_pass(name, target, used, commands); });
  };
  if (e.solids_) stages.time("recording", [&] { e.solids_->draw_for_refraction(frame, uses, uniform); });
  e.surface_->prepare(frame, uniform, uses);
  const auto finish = [&](Commands& c, bool shown) {  // over what a screen shows, the vignette and the horizon's line
    if (shown && e.comfort_ && e.comfort_->draw(c, uniform) && e.hidden_area_) e.hidden_area_->cover(c);
  };
  const auto draw_over = [&](Commands& c) {  // the sea and solid things; the nearest last
    if (e.solids_) e.solids_->draw_blended(c, uniform, eyes);
    if (e.hands_) e.hands_->draw(c, uniform);
    if (e.spray_ && eyes != EyesIn::water) e.spray_->draw(c, uniform);
    if (e.bubbles_) e.bubbles_->draw(c, uniform);
    if (e.lens_) e.lens_->draw(c, uniform);
    finish(c, tile);
  };
  record("surface", e.surface_->target(drawn), uses, [&](Commands& c) {
    if (e.hidden_area_) e.hidden_area_->hide(c);  // nothing that comes after is nearer
    e.surface_->draw(c, frame, *selection, uniform, eyes, facing_only);
    if (e.solids_) e.solids_->draw(c, uniform, eyes);
    if (side.bed != nullptr) e.surface_->draw_bed(c, frame, *side.bed, uniform);
    if (deferred) return;
    e.draw_sky(c, uniform, eyes);
    draw_over(c);
  });
  if (deferred) {
    e.surface_->add_points(uses);
    record("light", drawn, uses, [&](Commands& c) {
      e.surface_->light(c, uniform, eyes);
      draw_over(c);
    });
  }

  // 6. The depth that is shown with the picture, where no pass leaves it there by itself.
  if (e.shown_depth_) stages.time("recording", [&] { e.shown_depth_->draw(frame); });

  // 7. The desktop frame's tone mapping.
  if (!tile)
    record("tone", e.picture_, Uses{use(e.lit_.colour(), Access::fragment_sample)}, [&](Commands& c) {
      c.bind(e.tone_pipeline_, e.tone_bindings_, {uniform});
      c.push(gpu::DrawPush{c.eye()});
      c.draw(3);
      finish(c, true);
    });
}

}  // namespace seascape
