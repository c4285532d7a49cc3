#include "app/sky.h"

#include <glm/gtc/constants.hpp>

#include "shaders/shared/frame_data.h"
#include "shaders/shared/sky_push.h"

namespace seascape {

glm::dvec3 sun_direction(const SkySettings& settings) {
  const double e = glm::radians(settings.sun_elevation_deg), a = glm::radians(settings.sun_to_deg);
  return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

Sky::Sky(Device& device, ShaderLibrary& shaders) {
  const EffectScope scope(device, "sky");
  ImageSpec map;
  map.width = gpu::sky_map_width;
  map.height = gpu::sky_map_height;
  map.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  map.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  map.array = false;
  map_ = Image(device, "sky map", map);
  sampler_ = make_sampler(device, "sky", {true, true, 1.0f});
  multiple_ = Buffer(device, "sky multiple scattering", gpu::sky_multiple_size * gpu::sky_multiple_size * 16,
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  light_ = Buffer(
      device, "sky light", sizeof(gpu::SkyLight),
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  multiple_pipeline_ = make_compute_pipeline(device, shaders, "sky_multiple.comp");
  map_pipeline_ = make_compute_pipeline(device, shaders, "sky_map.comp");
  light_pipeline_ = make_compute_pipeline(device, shaders, "sky_light.comp");
  multiple_bindings_ = Bindings(device, multiple_pipeline_, {{.binding = 0, .buffer = &multiple_}}, "sky multiple");
  map_bindings_ = Bindings(device, map_pipeline_,
                           {{.binding = 0, .buffer = &multiple_}, {.binding = 1, .view = map_.view()}}, "sky map");
  light_bindings_ = Bindings(device, light_pipeline_,
                             {{.binding = 0, .buffer = &light_}, {.binding = 1, .view = map_.view()}}, "sky light");
}

bool Sky::update(Frame& frame, const SkySettings& settings) {
  if (made_ && settings.sun_elevation_deg == made_for_.sun_elevation_deg &&
      settings.sun_to_deg == made_for_.sun_to_deg && settings.haze == made_for_.haze)
    return false;
  made_ = true;
  made_for_ = settings;
  const gpu::SkyPush push{glm::vec4(glm::vec3(sun_direction(settings)), float(settings.haze))};
  frame.pass("sky multiple", {use(multiple_, Access::compute_write)}, [&](Commands& c) {
    c.bind(multiple_pipeline_, multiple_bindings_);
    c.push(push);
    c.dispatch(gpu::sky_multiple_size / 8, gpu::sky_multiple_size / 8, 1);
  });
  frame.pass("sky map", {use(multiple_, Access::compute_read), use(map_, Access::compute_write, true)},
             [&](Commands& c) {
               c.bind(map_pipeline_, map_bindings_);
               c.push(push);
               c.dispatch(gpu::sky_map_width / 8, gpu::sky_map_height / 8, 1);
             });
  frame.pass("sky light", {use(map_, Access::compute_read), use(light_, Access::compute_write)}, [&](Commands& c) {
    c.bind(light_pipeline_, light_bindings_);
    c.push(push);
    c.dispatch(1, 1, 1);
  });
  return true;
}

}  // namespace seascape
