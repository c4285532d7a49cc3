// Images that a pass draws into for all views at once: colour, depth, and the multisampled ones resolved in the tile.
#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "engine/resources.h"

namespace seascape {

// What a pass's stencil is cleared to (TargetSpec::stencil): see Stencil in engine/pipeline.h.
constexpr std::uint32_t stencil_in_air = 128;

struct TargetSpec {
  std::uint32_t width = 1, height = 1;
  int views = 1;         // layers of every image: the eyes
  bool per_eye = false;  // a pass per eye instead of one multiview pass (drivers whose multiview is at fault)
  VkFormat colour = VK_FORMAT_R8G8B8A8_SRGB;  // VK_FORMAT_UNDEFINED: depth alone, of one sample
  VkFormat second = VK_FORMAT_UNDEFINED;      // of a second colour image that is drawn at once, with one sample
  int samples = 1;
  bool depth = true;
  bool stencil = false;      // beside the depth, for the side of the water that a sample is on (GraphicsSpec::stencil)
  bool keep_depth = false;   // a pass after may read it, and the stencil: stored, a layer a view
  bool show_depth = false;   // whoever shows the picture gets its depth too, one sample a pixel
  bool clear_colour = true;  // or else whoever reads it knows from the depth where nothing was drawn
  std::array<float, 4> clear{0.0f, 0.0f, 0.0f, 1.0f};
};

// Images that another owns (a headset's runtime) and lends for a frame each: of colour, of depth, or of both. They are
// as large as a target's own would be or larger, with a layer a view, and outlive the target.
struct LentImages {
  std::uint32_t width = 0, height = 0;
  std::vector<VkImage> colours;  // of TargetSpec::colour
  std::vector<VkImage> depths;   // of the device's depth format
};

// An attachment of a target's pass, and what of it is read from memory before and written there after.
struct TargetAttachment {
  enum class Part { colour, depth, second, resolved, resolved_depth } part;
  VkFormat format;
  int samples;
  VkAttachmentLoadOp load;
  VkAttachmentStoreOp store;
};
// In the order of the pass's attachments.
std::vector<TargetAttachment> attachments_of(const TargetSpec& spec, const DeviceFacts& facts);

class RenderTarget {
 public:
  RenderTarget() = default;
  // `lent`: what to draw into instead of images of its own; null: nothing. With spec.show_depth a single-sampled depth
  // is among what is kept: that of the pass itself, or of several samples the first (shown_depth() is null where the
  // device cannot resolve depths, or one sample has a stencil beside it, which nobody who shows a picture has).
  RenderTarget(Device& device, std::string_view name, const TargetSpec& spec, const LentImages* lent = nullptr);

  // Which of the lent images the next passes draw into. What they hold is lost.
  void choose(std::size_t colour, std::size_t depth);
  // Draws into the upper left part only: of at most the size that it was made with.
  void set_area(std::uint32_t width, std::uint32_t height);

  // Its width and height are those that are drawn.
  const TargetSpec& spec() const { return spec_; }
  VkRenderPass render_pass() const { return render_pass_; }
  VkSampleCountFlagBits samples() const { return VkSampleCountFlagBits(spec_.samples); }
  bool has_depth() const { return spec_.depth; }
  bool has_colour() const { return spec_.colour != VK_FORMAT_UNDEFINED; }
  // Bytes of memory that drawing all views once reads and writes for attachments: those of a tile in between are not.
  std::uint64_t loaded_bytes() const;
  std::uint64_t stored_bytes() const;
  // One framebuffer for a multiview pass, or one an eye.
  std::size_t passes() const { return spec_.per_eye ? std::size_t(spec_.views) : 1; }
  VkFramebuffer framebuffer(std::size_t pass) const {
    return framebuffers_[(chosen_colour_ * depth_count() + chosen_depth_) * passes() + pass].get();
  }
  // The picture: one layer a view, single-sampled. Only with has_colour().
  const Image& colour() const { return colours_[chosen_colour_]; }
  const Image* second() const { return second_ ? &second_ : nullptr; }
  // A pass per eye resolves its samples here and copies them to the eye's layer: Mesa 22.3's software driver, the one
  // that needs a pass per eye, resolves into layer 0 whatever the view says.
  const Image* resolved_eye() const { return resolved_eye_ ? &resolved_eye_ : nullptr; }
  const Image* multisampled() const { return multisampled_ ? &multisampled_ : nullptr; }
  // With spec.stencil and spec.keep_depth: what a pass after may read of it; null else.
  VkImageView stencil_view() const { return stencil_view_; }
  const Image* depth() const { return !spec_.depth ? nullptr : depth_ ? &depth_ : &shown_depths_[chosen_depth_]; }
  // With spec.show_depth: what is shown of it, one layer a view. It is depth() itself where that has one sample.
  const Image* shown_depth() const { return shown_depths_.empty() ? nullptr : &shown_depths_[chosen_depth_]; }
  // That a pass resolves its samples' depth into; null where it does not.
  const Image* resolved_depth() const { return spec_.samples > 1 ? shown_depth() : nullptr; }

 private:
  std::size_t depth_count() const { return std::max<std::size_t>(1, shown_depths_.size()); }
  void make_images(Device& device, std::string_view name, const LentImages* lent);
  void make_framebuffers(Device& device, std::string_view name);
  TargetSpec spec_;
  std::vector<TargetAttachment> attachments_;
  VkExtent2D image_size_{};  // of every image, or less where images are lent that are larger
  VkRenderPass render_pass_ = VK_NULL_HANDLE;
  VkImageView stencil_view_ = VK_NULL_HANDLE;
  std::vector<Image> colours_, shown_depths_;  // lent ones, or one
  std::size_t chosen_colour_ = 0, chosen_depth_ = 0;
  Image second_, resolved_eye_, multisampled_, depth_;
  std::vector<Owned<VkFramebuffer>> framebuffers_;  // of each colour and depth, a pass after the other
};

}  // namespace seascape
