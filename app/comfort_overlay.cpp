#include "app/comfort_overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shaders/shared/comfort_data.h"
#include "shaders/shared/frame_data.h"

namespace seascape {

namespace {

glm::dvec3 ahead_of(const Viewpoint& viewpoint) { return viewpoint.viewer.orientation * glm::dvec3(0.0, 0.0, -1.0); }

// Whether an eye may see anything farther than `angle` (rad) from a direction. An eye sees a convex cone, and so is
// what lies within a quarter turn of a direction or less: it holds all of the picture if it holds the corners.
bool sees_beyond(const View& eye, const glm::dvec3& ahead, double angle) {
  const double least = std::cos(std::min(angle, glm::half_pi<double>()));
  for (const double x : {eye.fov.left, eye.fov.right})
    for (const double y : {eye.fov.up, eye.fov.down}) {
      const glm::dvec3 corner = eye.pose.orientation * glm::dvec3(x, y, -1.0);
      if (glm::dot(corner, ahead) < least * glm::length(corner)) return true;
    }
  return false;
}

}  // namespace

ComfortOverlay::ComfortOverlay(Device& device, ShaderLibrary& shaders, const RenderTarget& picture,
                               const Buffer& frame_ring) {
  const EffectScope scope(device, "comfort");
  GraphicsSpec spec;
  spec.vertex = "sky.vert";
  spec.fragment = "comfort.frag";
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye}};
  spec.depth_test = spec.depth_write = false;
  spec.blend = true;
  pipeline_ = make_graphics_pipeline(device, shaders, picture, spec);
  bindings_ = Bindings(device, pipeline_,
                       {{.binding = gpu::slot_frame, .buffer = &frame_ring, .range = sizeof(gpu::FrameData)},
                        {.binding = gpu::slot_comfort, .buffer = &frame_ring, .range = sizeof(gpu::ComfortData)}},
                       "comfort");
}

void ComfortOverlay::update(Frame& frame, const Viewpoint& viewpoint, const ComfortShown& shown) {
  const glm::dvec3 ahead = ahead_of(viewpoint);
  const double clear = glm::radians(0.5 * shown.clear_deg);
  const bool vignette =
      shown.clear_deg < 360.0 && std::any_of(viewpoint.eyes.begin(), viewpoint.eyes.end(),
                                             [&](const View& eye) { return sees_beyond(eye, ahead, clear); });
  shows_ = vignette || shown.horizon_line;
  if (!shows_) return;
  uniform_ = frame.upload_uniform(gpu::ComfortData{
      {glm::vec3(ahead), shown.horizon_line ? 1.0f : 0.0f},
      {float(clear), float(glm::radians(std::max(shown.soft_deg, 0.1))), 0.0f, 0.0f},  // never a step
  });
}

bool ComfortOverlay::draw(Commands& commands, std::uint32_t frame_uniform) const {
  if (!shows_) return false;
  commands.bind(pipeline_, bindings_, {frame_uniform, uniform_});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.draw(3);
  return true;
}

}  // namespace seascape
