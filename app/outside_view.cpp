#include "app/outside_view.h"

#include <algorithm>

#include "app/frame.h"
#include "app/quality.h"
#include "ocean/effects.h"

namespace seascape {

namespace {

Settings low(Settings settings) {
  apply_preset(settings, "low");
  return settings;
}

RenderTarget make_picture(Device& device, VkExtent2D size, bool deferred, int samples) {
  TargetSpec spec;
  spec.width = size.width;
  spec.height = size.height;
  spec.samples = samples;
  spec.depth = !deferred;
  return RenderTarget(device, "outside", spec);
}

}  // namespace

OutsideView::OutsideView(Device& device, ShaderLibrary& shaders, Experience& experience, const Frame& frame,
                         VkExtent2D size)
    : lod_(low(experience.scene().settings).lod), mesher_(lod_), deferred_(device.facts().software) {
  const Settings settings = low(experience.scene().settings);
  const EffectScope scope(device, "mirror");
  picture_ = make_picture(device, size, deferred_, deferred_ ? 1 : std::min(4, device.facts().max_samples));
  SurfaceLook look;
  look.tile_shape = true;
  look.foam = calls_for(experience.scene().effects, "foam");
  look.deferred = deferred_;
  look.anisotropy = std::min(float(settings.water.anisotropy), device.facts().max_anisotropy);
  Sky& sky = experience.sky();
  SurfaceLight light{&frame.ring(), sky.map().view(), sky.sampler(), &sky.light()};
  if (const SunMap* map = experience.sun_map()) {
    light.sun_map = map->target().depth()->view();
    light.sun_map_sampler = map->sampler();
  }
  look.solids = experience.solids() != nullptr;
  surface_ = std::make_unique<Surface>(device, shaders, picture_, experience.ocean().pieces(), light, look);
  if (look.solids)
    solids_ = std::make_unique<DrawnSolids>(device, shaders, picture_, light, experience.solid_sources(),
                                            SolidLook{.tile_shape = true,
                                                      .points = deferred_ ? &surface_->target(picture_) : nullptr,
                                                      .depths = surface_->depths(),
                                                      .anisotropy = look.anisotropy});
  if (deferred_) return;
  GraphicsSpec behind;
  behind.vertex = "sky.vert";
  behind.fragment = "sky.frag";
  behind.values = {{gpu::value_multiview, true}, {gpu::value_tile_shape, true}, {gpu::value_debug, false}};
  behind.depth_write = false;
  behind.depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  sky_pipeline_ = make_graphics_pipeline(device, shaders, picture_, behind);
  sky_bindings_ = Bindings(device, sky_pipeline_,
                           {{.binding = gpu::slot_frame, .buffer = &frame.ring(), .range = sizeof(gpu::FrameData)},
                            {.binding = gpu::slot_sky_map, .view = sky.map().view(), .sampler = sky.sampler()},
                            {.binding = gpu::slot_sky_light, .buffer = &sky.light()}},
                           "outside sky");
}

void OutsideView::draw(Frame& frame, Experience& e, const Viewpoint& viewpoint) {
  Ocean& ocean = e.ocean();
  Settings settings = low(e.scene().settings);
  lod_ = settings.lod;
  held_ = ocean.waves_held();
  const SurfaceSelection& selection = ocean.select(viewpoint, mesher_, lod_);
  const ModelSettings things = settings.models;
  settings = e.scene().settings;
  settings.render.debug = DebugView::none;
  gpu::FrameData data = frame_data(settings, viewpoint, picture_.spec().height);
  ocean.describe(data, viewpoint, selection);
  if (solids_) {
    solids_->update(frame, viewpoint, e.sea()->time_s(), {ocean.highest_m()}, things);
    e.solids()->describe_sun(data, viewpoint.viewer.position_m);
  }
  const std::uint32_t uniform = frame.upload_uniform(data);
  Uses uses{use(e.sky().map(), Access::surface_read), use(e.sky().light(), Access::surface_read)};
  ocean.add_uses(uses);
  if (solids_) solids_->add_uses(uses);
  if (const SunMap* map = e.sun_map()) uses.add(use(*map->target().depth(), Access::fragment_sample));
  frame.draw_pass("outside", surface_->target(picture_), uses, [&](Commands& c) {
    surface_->draw(c, frame, selection, uniform, EyesIn::air,
                   settings.render.facing_only && ocean.eyes_in_air(viewpoint));
    if (solids_) solids_->draw(c, uniform, EyesIn::air);
    if (deferred_) return;
    c.bind(sky_pipeline_, sky_bindings_, {uniform, 0u});
    c.push(gpu::DrawPush{c.eye()});
    c.draw(3);
    if (solids_) solids_->draw_blended(c, uniform, EyesIn::air);
  });
  if (!deferred_) return;
  surface_->add_points(uses);
  frame.draw_pass("outside light", picture_, uses, [&](Commands& c) {
    surface_->light(c, uniform, EyesIn::air);
    if (solids_) solids_->draw_blended(c, uniform, EyesIn::air);
  });
}

}  // namespace seascape
