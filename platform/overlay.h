// Widgets over a display's picture, one frame at a time, built with Dear ImGui's own calls.
#pragma once

namespace seascape {

class Overlay {
 public:
  virtual ~Overlay() = default;
  // Between these two the caller builds the frame's widgets; what was built last is shown with every picture.
  // `pointer_is_free`: the pointer is visible, widgets may have it.
  virtual void begin(bool pointer_is_free) = 0;
  virtual void end() = 0;

  virtual bool wants_keyboard() const = 0;  // somebody types into a field
  virtual bool wants_pointer() const = 0;   // the pointer is over a widget
};

}  // namespace seascape
