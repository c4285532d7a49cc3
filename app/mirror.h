// The desktop's window on what someone sees in a headset: copies of the eyes' pictures or a view from behind, with
// widgets and input of its own. Nothing of the headset's frame ever waits for it.
#pragma once
#include <future>

#include "app/mirror_widgets.h"
#include "app/outside_camera.h"
#include "app/outside_view.h"
#include "app/panel.h"
#include "app/picture_copy.h"
#include "platform/window.h"

namespace seascape {

// Its pictures are drawn by frames of its own, submitted after the headset's, one at a time: while one is on the GPU,
// or the window has no image free, none is begun and no copy wanted.
class Mirror {
 public:
  // Opens the window. All outlive it. Throws Error where none can be opened.
  Mirror(WindowSystem& system, Device& device, ShaderLibrary& shaders, const WindowOptions& window);
  ~Mirror();
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;

  // First in each frame of the headset: takes in what was done at the desk, and brings to the screen what was drawn
  // last. `now_s` counts from anywhere. The panel of the desk takes what is meant for it out of the input.
  Input begin(double now_s, const MirrorSettings& settings);
  // Whether someone has closed the window since the last call; closed() until open() or another view is asked for.
  bool take_closed() { return std::exchange(told_closed_, false); }
  bool closed() const { return closed_; }
  void open() { closed_ = false; }

  // Whether the headset's frame is to be copied, for the picture that is due now.
  bool wants_copy() const { return due_ && !shows_third(); }
  // Whether show() has something to show now.
  bool due() const { return due_; }
  // Once a frame of the headset, whose head it was, after `dt_s` (s).
  void follow(const Pose& head, double dt_s) { camera_.step(head, camera_settings_, dt_s); }
  void note(double cpu_ms, double gpu_ms) { widgets_.note(cpu_ms, gpu_ms); }

  struct Shown {
    const PictureCopy& copy;  // of the headset's frame, or of one before
    Experience& experience;   // whose frame has been ended
    double sea_time_s;
    const Settings& initial;  // what the panel goes back to
    const PanelFacts& facts;
    std::string_view message;  // at the window's foot; empty: none
  };
  // When it is due, after the headset's frame was ended: draws and submits. Returns what was asked for in the panel.
  PanelWish show(const Shown& shown);
  // The last picture from behind, where that is what is shown; waits for the device.
  std::optional<Image8> third() const;

  // The experience's objects go (Experience::before_build).
  void let_go();
  void hold_mouse(bool held);
  void set_title(const std::string& title) { window_.set_title(title + " (mirror)"); }
  bool takes_pointer() const { return overlay_->wants_pointer(); }
  // What the GPU took for the newest of its pictures that is known to have left it.
  double gpu_ms() const { return frame_.gpu_ms(); }
  // Why there is no view from behind; once.
  std::optional<std::string> take_fault() { return std::exchange(fault_, std::nullopt); }

 private:
  bool shows_third() const { return settings_.view == MirrorView::third && outside_ != nullptr; }
  VkExtent2D third_size() const;
  void prepare_third(Experience& experience);
  void draw_third(const Shown& shown);
  std::vector<WindowPart> parts_of(const PictureCopy& copy) const;
  PanelWish draw_widgets(const Shown& shown);

  Device& device_;
  ShaderLibrary& shaders_;
  Window window_;
  std::unique_ptr<Overlay> overlay_;
  Frame frame_;
  Panel panel_;
  MirrorWidgets widgets_;
  MirrorSettings settings_;
  OutsideCamera camera_;
  OutsideCameraSettings camera_settings_;
  std::unique_ptr<OutsideView> outside_;
  std::future<std::unique_ptr<OutsideView>> coming_;
  bool cannot_ = false, third_drawn_ = false;
  std::optional<std::string> fault_;
  bool mouse_held_ = false, due_ = false, closed_ = false, told_closed_ = false, visible_ = true;
  double next_s_ = 0.0;  // when the next picture is due
};

}  // namespace seascape
