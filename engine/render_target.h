// Images that a pass draws into for all views at once: colour, depth, and the multisampled ones resolved in the tile.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/resources.h"

namespace seascape {

struct TargetSpec {
  std::uint32_t width = 1, height = 1;
  int views = 1;         // layers of every image: the eyes
  bool per_eye = false;  // a pass per eye instead of one multiview pass (drivers whose multiview is at fault)
  VkFormat colour = VK_FORMAT_R8G8B8A8_SRGB;
  VkFormat second = VK_FORMAT_UNDEFINED;  // of a second colour image that is drawn at once, with one sample
  int samples = 1;
  bool depth = true;
  bool keep_depth = false;   // a pass after may read it: stored, a layer a view
  bool clear_colour = true;  // or else whoever reads it knows from the depth where nothing was drawn
  std::array<float, 4> clear{0.0f, 0.0f, 0.0f, 1.0f};
};

class RenderTarget {
 public:
  RenderTarget() = default;
  RenderTarget(Device& device, std::string_view name, const TargetSpec& spec);

  const TargetSpec& spec() const { return spec_; }
  VkRenderPass render_pass() const { return render_pass_; }
  VkSampleCountFlagBits samples() const { return VkSampleCountFlagBits(spec_.samples); }
  bool has_depth() const { return spec_.depth; }
  // One framebuffer for a multiview pass, or one an eye.
  std::size_t passes() const { return framebuffers_.size(); }
  VkFramebuffer framebuffer(std::size_t pass) const { return framebuffers_[pass].get(); }
  // The picture: one layer a view, single-sampled.
  const Image& colour() const { return colour_; }
  const Image* second() const { return second_ ? &second_ : nullptr; }
  // A pass per eye resolves its samples here and copies them to the eye's layer: Mesa 22.3's software driver, the one
  // that needs a pass per eye, resolves into layer 0 whatever the view says.
  const Image* resolved_eye() const { return resolved_eye_ ? &resolved_eye_ : nullptr; }
  const Image* multisampled() const { return multisampled_ ? &multisampled_ : nullptr; }
  const Image* depth() const { return depth_ ? &depth_ : nullptr; }

 private:
  TargetSpec spec_;
  VkRenderPass render_pass_ = VK_NULL_HANDLE;
  Image colour_, second_, resolved_eye_, multisampled_, depth_;
  std::vector<Owned<VkFramebuffer>> framebuffers_;
};

}  // namespace seascape
