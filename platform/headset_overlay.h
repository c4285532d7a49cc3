// Widgets on a board that stands before the wearer of a headset, who points at it with a hand.
#pragma once
#include "engine/render_target.h"
#include "platform/headset.h"

struct ImGuiContext;

namespace seascape {

class HeadsetOverlay final : public Overlay, public Headset::Layer {
 public:
  // Uploads its fonts at once. The headset and its device must outlive it.
  HeadsetOverlay(Device& device, Headset& headset);
  ~HeadsetOverlay() override;
  HeadsetOverlay(const HeadsetOverlay&) = delete;
  HeadsetOverlay& operator=(const HeadsetOverlay&) = delete;

  void begin(bool pointer_is_free) override;
  void end() override;
  bool wants_keyboard() const override { return false; }
  bool wants_pointer() const override { return pointed_at_; }

  std::optional<Headset::Quad> draw(Frame& frame) override;
  void release() override;
  void reset() override;

 private:
  void place();
  void point();
  void make_board();
  static constexpr std::uint32_t width_ = 900, height_ = 1100;  // pixels
  static constexpr double width_m_ = 0.9;
  Device& device_;
  Headset& headset_;
  ImGuiContext *context_ = nullptr, *before_ = nullptr;
  Owned<VkDescriptorPool> pool_;
  HeadsetSwapchain swapchain_;
  RenderTarget board_;
  Pose at_;
  bool shown_ = false, pointed_at_ = false, renders_ = false;
};

// Where a ray meets a board of this size (m) from its front, as shares of its width and height from the upper left;
// nothing where it does not.
std::optional<glm::dvec2> pointed_at(const Pose& ray, const Pose& board, const glm::dvec2& size_m);

}  // namespace seascape
