// Where frames go and where the viewer's head comes from: a window, a headset, or nothing but memory.
#pragma once
#include <cstdint>

#include <memory>
#include <string>

#include "engine/frame.h"
#include "engine/view.h"
#include "platform/bindings.h"
#include "platform/input.h"
#include "platform/overlay.h"

namespace seascape {

// What a display says before a frame is drawn.
struct DisplayFrame {
  double time_s = 0.0;                  // when the frame will be seen, seconds since the display was made
  bool should_render = true;            // false: minimised, or the headset is off; the frame is still ended
  bool closed = false;                  // the user has gone
  std::uint32_t width = 0, height = 0;  // pixels an eye
};

class Display {
 public:
  virtual ~Display() = default;
  virtual const char* name() const = 0;
  virtual int views() const = 0;
  // Waits for the time to begin a frame and takes in events. Every begun frame must be ended.
  virtual DisplayFrame begin() = 0;
  // Whether it knows where the head is. A viewpoint's carrier is then the middle of the floor on which one stands, and
  // else it is the head.
  virtual bool tracks_head() const { return false; }
  // Where the eyes are when the head (a headset's own tracking included) rides on `carrier`, for this frame.
  virtual Viewpoint viewpoint(const Pose& carrier) const = 0;
  // Ends the frame: submits what `frame` has recorded and shows `picture` (one layer a view). Without a picture nothing
  // was recorded and nothing is shown.
  virtual void end(Frame& frame, const RenderTarget* picture) = 0;

  // What was done up to the last begin().
  virtual const Input& input() const;
  // Where its user stands: other bindings hold in a boat.
  virtual void set_post(Post) {}
  // The lens of the next viewpoint, where the display has none of its own.
  virtual void set_lens(double /*vertical_fov_deg*/, double /*eye_distance_m*/) {}
  // Hides the pointer and lets the mouse move without end, to look around.
  virtual void hold_mouse(bool) {}
  virtual void set_title(const std::string&) {}
  // What widgets are laid over it with; null where there is nowhere to show any. The display must outlive it.
  virtual std::unique_ptr<Overlay> make_overlay() { return nullptr; }
};

}  // namespace seascape
