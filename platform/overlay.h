// Dear ImGui on a window: its context, fonts and pipeline, one frame at a time.
#pragma once
#include "platform/window.h"

namespace seascape {

class Overlay {
 public:
  // Uploads its fonts at once. The window and its device must outlive it.
  Overlay(Device& device, Window& window);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  // Between these two the caller builds the frame's widgets with ImGui's own calls; what was built last is drawn over
  // every picture the window shows. `mouse_is_free`: the pointer is visible, widgets may have it.
  void begin(bool mouse_is_free);
  void end();

  bool wants_keyboard() const;  // somebody types into a field
  bool wants_mouse() const;     // the pointer is over a widget

 private:
  Device& device_;
  Window& window_;
  Owned<VkDescriptorPool> pool_;
};

}  // namespace seascape
