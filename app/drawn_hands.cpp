#include "app/drawn_hands.h"

#include <algorithm>

#include "shaders/shared/frame_data.h"
#include "shaders/shared/hand_limb.h"

namespace seascape {

DrawnHands::DrawnHands(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light,
                       bool tile_shape, const Image* depths)
    : device_(device), depths_(depths) {
  const EffectScope scope(device, "hands");
  GraphicsSpec spec;
  spec.vertex = "hand.vert";
  spec.fragment = "hand.frag";
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye},
                 {gpu::value_tile_shape, tile_shape},
                 {gpu::value_depth_sampled, depths != nullptr}};
  spec.buffers = {{0, sizeof(gpu::HandLimb), VK_VERTEX_INPUT_RATE_INSTANCE}};
  spec.attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::HandLimb, from)},
                     {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::HandLimb, to)},
                     {2, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::HandLimb, colour)}};
  pipeline_ = make_graphics_pipeline(device, shaders, picture, spec);
  entries_ = {{.binding = gpu::slot_frame, .buffer = light.frame_ring, .range = sizeof(gpu::FrameData)},
              {.binding = gpu::slot_sky_map, .view = light.sky_map, .sampler = light.sky_sampler},
              {.binding = gpu::slot_sky_light, .buffer = light.sky_light}};
  if (depths != nullptr) sampler_ = make_sampler(device, "hands", {false, false, 1.0f});
  limbs_.reserve(2 * most_limbs + most_aim_limbs);
  bind();
}

void DrawnHands::bind() {
  std::vector<Bound> entries = entries_;
  if (depths_ != nullptr)
    entries.push_back({.binding = gpu::slot_sea_depths, .view = depths_->view(), .sampler = sampler_.get()});
  bindings_ = Bindings(device_, pipeline_, entries, "hands");
}

void DrawnHands::resize(const Image* depths) {
  if (depths_ == nullptr) return;
  const EffectScope scope(device_, "hands");
  depths_ = depths;
  bind();
}

void DrawnHands::update(Frame& frame, std::span<const ShownHand> hands, const std::optional<ShownAim>& aim,
                        const glm::dvec3& viewer_m) {
  limbs_.clear();
  for (const ShownHand& hand : hands) append_hand(hand.pose, hand.right, hand.closed, limbs_);
  if (aim) append_aim(*aim, viewer_m, limbs_);
  if (limbs_.empty()) return;
  // The nearest last: a picture that is lit after its depths are drawn has no depth of its own.
  const auto away = [&](const Limb& limb) { return glm::distance(0.5 * (limb.from_m + limb.to_m), viewer_m); };
  std::stable_sort(limbs_.begin(), limbs_.end(), [&](const Limb& a, const Limb& b) { return away(a) > away(b); });
  list_ = frame.vertices(limbs_.size() * sizeof(gpu::HandLimb));
  auto* to = static_cast<gpu::HandLimb*>(list_.host);
  for (const Limb& limb : limbs_) {
    to->from = glm::vec4(glm::vec3(limb.from_m - viewer_m), float(limb.from_radius_m));
    to->to = glm::vec4(glm::vec3(limb.to_m - viewer_m), float(limb.to_radius_m));
    to->colour = glm::vec4(limb.colour, limb.glows ? 1.0f : 0.0f);
    ++to;
  }
}

void DrawnHands::draw(Commands& commands, std::uint32_t frame_uniform) const {
  if (limbs_.empty()) return;
  commands.bind(pipeline_, bindings_, {frame_uniform, 0u});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.bind_vertices(list_);
  commands.draw(gpu::limb_vertices, std::uint32_t(limbs_.size()));
}

}  // namespace seascape
