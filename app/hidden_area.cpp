#include "app/hidden_area.h"

#include <bit>

#include "shaders/shared/frame_data.h"
#include "shaders/shared/hidden_corner.h"

namespace seascape {

HiddenArea::HiddenArea(Device& device, ShaderLibrary& shaders, const RenderTarget& target, const RenderTarget& picture,
                       bool deferred) {
  const EffectScope scope(device, "hidden");
  GraphicsSpec spec;
  spec.vertex = "hidden.vert";
  spec.fragment = deferred ? "hidden_points.frag" : "hidden.frag";
  const float footprints = target.second() != nullptr ? 2.0f : 1.0f;  // as the surface's points keep them
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye},
                 {gpu::value_anisotropy, std::bit_cast<std::uint32_t>(footprints)}};
  spec.buffers = {{0, sizeof(gpu::HiddenCorner), VK_VERTEX_INPUT_RATE_VERTEX}};
  spec.attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::HiddenCorner, at)}};
  hiding_ = make_graphics_pipeline(device, shaders, target, spec);
  spec.fragment = "hidden.frag";
  spec.depth_test = spec.depth_write = false;
  covering_ = make_graphics_pipeline(device, shaders, picture, spec);
}

void HiddenArea::update(Frame& frame, const Viewpoint& viewpoint, const HiddenMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t eye = 0; eye < viewpoint.eyes.size(); ++eye) count += mesh.corners[eye].size();
  count_ = std::uint32_t(count);
  if (count_ == 0) return;
  list_ = frame.vertices(count * sizeof(gpu::HiddenCorner));
  auto* to = static_cast<gpu::HiddenCorner*>(list_.host);
  for (std::size_t eye = 0; eye < viewpoint.eyes.size(); ++eye) {
    const glm::dmat4 projected = projection(viewpoint.eyes[eye].fov, 1.0);  // in that plane w is 1
    for (const glm::vec2& corner : mesh.corners[eye]) {
      const glm::dvec4 at = projected * glm::dvec4(corner, -1.0, 1.0);
      (to++)->at = {float(at.x), float(at.y), float(eye), 0.0f};
    }
  }
}

void HiddenArea::draw(Commands& commands, const Pipeline& pipeline) const {
  if (count_ == 0) return;
  commands.bind(pipeline, {});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.bind_vertices(list_);
  commands.draw(count_);
}

void HiddenArea::hide(Commands& commands) const { draw(commands, hiding_); }

void HiddenArea::cover(Commands& commands) const { draw(commands, covering_); }

}  // namespace seascape
