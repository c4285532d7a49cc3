// Where frames go and where the viewer's head comes from: a window, a headset, or nothing but memory.
#pragma once
#include <cstdint>

#include <memory>
#include <optional>
#include <string>

#include "engine/frame.h"
#include "engine/view.h"
#include "platform/bindings.h"
#include "platform/hidden_mesh.h"
#include "platform/input.h"
#include "platform/overlay.h"

namespace seascape {

// The side of a picture at a scale, at least one pixel.
std::uint32_t scaled_pixels(std::uint32_t pixels, double scale);

// What a display says before a frame is drawn.
struct DisplayFrame {
  double time_s = 0.0;                     // when the frame will be seen, seconds since the display was made
  bool should_render = true;               // false: minimised, or the headset is off; the frame is still ended
  bool closed = false;                     // the user has gone
  std::uint32_t width = 0, height = 0;     // pixels an eye
  double period_s = 0.0;                   // from one frame to the next, where the display says
  bool away = false;                       // nobody looks: no frame was begun at all
  bool focused = true;                     // what is done is meant for it
  bool moved = false;                      // the display's own space lies elsewhere from now on: it was centred anew
  std::shared_ptr<const LentImages> lent;  // what the picture has to be drawn into; null: images of its own
  std::size_t colour = 0, depth = 0;       // which of them
};

// For as long as it lives a display shows its last picture over and over.
struct HeldPicture {
  virtual ~HeldPicture() = default;
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
  // Ends the frame: submits what `frame` has recorded and shows `picture` (one layer a view), with its depth where the
  // display wants one. Without a picture nothing was recorded and nothing is shown.
  virtual void end(Frame& frame, const RenderTarget* picture, const Image* depth = nullptr) = 0;

  // What was done up to the last begin().
  virtual const Input& input() const;
  // The head as it was tracked last, in metres from the middle of the floor; nothing where it is not.
  virtual std::optional<Pose> head() const { return std::nullopt; }
  // What lies ahead of the head becomes forward, and the middle of the floor comes under it.
  virtual void recentre() {}
  // What a hand (0 left, 1 right) feels: strength 0 to 1, for a time (s).
  virtual void buzz(int /*hand*/, double /*strength*/, double /*seconds*/) {}
  // The size of pictures from the next frame on, against what the display asks for, within most_size().
  virtual void set_scale(double) {}
  // For work between two frames that takes longer than one; end() has been called, and nothing else is until what it
  // returns is gone. Null: a display that keeps its picture by itself.
  virtual std::unique_ptr<HeldPicture> hold_picture() { return nullptr; }
  // Whether its time goes on while nothing is drawn. Else frames are as far apart as they say, however long they take.
  virtual bool in_real_time() const { return true; }
  virtual double scale() const { return 1.0; }  // that they have
  // Pictures a second, asked of the display once a change; 0: its own.
  virtual void set_rate(double /*rate_hz*/) {}
  // Whether sticks and buttons of the two hands change places.
  virtual void set_left_handed(bool) {}
  // Someone who sits gets a floor so low that the eyes are `eye_height_m` over it, measured now and as it is centred
  // anew. A display that knows no floor takes it to be as far below.
  virtual void set_stature(bool /*seated*/, double /*eye_height_m*/) {}
  // Asks the display to come to its end, which begin() then says.
  virtual void leave() {}
  // Of the pictures that it takes.
  virtual VkFormat colour() const { return VK_FORMAT_R8G8B8A8_SRGB; }
  virtual bool shows_depth() const { return false; }
  virtual glm::uvec2 most_size() const { return {0, 0}; }  // for which there is to be room; 0: as they come
  // What no eye can see of the frame's pictures, once its viewpoint is known; null: it never says so.
  virtual const HiddenMesh* hidden() const { return nullptr; }
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
