// Widgets over a window's picture, with the window's own pointer and keyboard.
#pragma once
#include "platform/window.h"

struct ImGuiContext;

namespace seascape {

class WindowOverlay final : public Overlay {
 public:
  // Uploads its fonts at once. The window and its device must outlive it.
  WindowOverlay(Device& device, Window& window);
  ~WindowOverlay() override;
  WindowOverlay(const WindowOverlay&) = delete;
  WindowOverlay& operator=(const WindowOverlay&) = delete;

  void begin(bool pointer_is_free) override;
  void end() override;
  bool wants_keyboard() const override;
  bool wants_pointer() const override;

 private:
  Device& device_;
  Window& window_;
  ImGuiContext* context_;  // its own: other overlays have theirs
  Owned<VkDescriptorPool> pool_;
};

}  // namespace seascape
