#include "app/solids/solid_surroundings.h"

#include "shaders/shared/solid_data.h"

namespace seascape {

SolidSurroundings::SolidSurroundings(Device& device, ShaderLibrary& shaders, const SurfaceLight& light)
    : light_(light.sky_light) {
  const EffectScope scope(device, "models");
  ImageSpec sky;
  sky.width = sky.height = gpu::solid_sky_side;
  sky.layers = gpu::solid_sky_layers;
  sky.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  sky.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  sky_ = Image(device, "solid sky", sky);
  ImageSpec albedo;
  albedo.width = albedo.height = gpu::solid_albedo_side;
  albedo.format = sky.format;
  albedo.usage = sky.usage;
  albedo.array = false;
  albedo_ = Image(device, "solid albedo", albedo);
  sampler_ = make_sampler(device, "solid sky", {.linear = true, .repeat = false});
  sky_pipeline_ = make_compute_pipeline(device, shaders, "solid_sky.comp");
  albedo_pipeline_ = make_compute_pipeline(device, shaders, "solid_albedo.comp");
  sky_bindings_ = Bindings(device, sky_pipeline_,
                           {{.binding = 0, .view = light.sky_map, .sampler = light.sky_sampler},
                            {.binding = 1, .buffer = light.sky_light},
                            {.binding = 2, .view = sky_.view()}},
                           "solid sky");
  albedo_bindings_ = Bindings(device, albedo_pipeline_, {{.binding = 0, .view = albedo_.view()}}, "solid albedo");
}

void SolidSurroundings::update(Frame& frame, const Image& sky_map, const glm::vec4& water_reflectance,
                               bool sky_is_new) {
  if (!lit_)
    frame.pass("solid albedo", {use(albedo_, Access::compute_write, true)}, [&](Commands& c) {
      c.bind(albedo_pipeline_, albedo_bindings_);
      c.dispatch(gpu::solid_albedo_side / 8, gpu::solid_albedo_side / 8, 1);
    });
  if (!lit_ || sky_is_new || lit_by_ != water_reflectance)
    frame.pass("solid sky",
               {use(sky_map, Access::compute_sample), use(*light_, Access::compute_read),
                use(sky_, Access::compute_write, true)},
               [&](Commands& c) {
                 c.bind(sky_pipeline_, sky_bindings_);
                 c.push(gpu::SolidSkyPush{water_reflectance});
                 c.dispatch(gpu::solid_sky_side / 8, gpu::solid_sky_side / 8, gpu::solid_sky_layers);
               });
  lit_ = true;
  lit_by_ = water_reflectance;
}

void SolidSurroundings::add_uses(Uses& uses) const {
  uses.add(use(sky_, Access::fragment_sample));
  uses.add(use(albedo_, Access::fragment_sample));
}

}  // namespace seascape
