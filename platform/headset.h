// A display on a head, through OpenXR: two eyes in one picture of two layers, hands, and the runtime's own clock.
#pragma once
#include <functional>
#include <optional>
#include <span>

#include "platform/display.h"
#include "platform/headset_input.h"
#include "platform/headset_mask.h"
#include "platform/headset_swapchain.h"
#include "platform/symmetric_field.h"

namespace seascape {

struct HeadsetOptions {
  double near_m = 0.1;        // of the pictures' projection
  double scale = 1.0;         // of the recommended size, for the first frame
  double most_scale = 1.5;    // there is room for as much: a larger one takes pictures to their edge and no further
  double eye_height_m = 1.7;  // over the floor, where a runtime knows no floor or one sits
  double rate_hz = 0.0;       // asked for; 0: the runtime's own
  bool left_handed = false, seated = false;
  bool in_real_time = true;  // false: the runtime's time stands between frames
  bool symmetric = false;    // both eyes are drawn with one field of view, where there is room (symmetric_field.h)
  std::uint32_t width = 0, height = 0;  // pixels an eye; 0: as recommended
};

// What was called and with what, in order, for whoever checks the order or wants to draw the same again.
struct HeadsetCall {
  enum class Kind { wait, begin, locate, end } kind;
  std::int64_t time_ns = 0;   // the predicted display time that it was given or gave
  std::vector<XrView> views;  // located, or submitted
  bool repeated = false;      // submitted before
};

class Headset final : public Display {
 public:
  // Throws Error where the runtime shows nothing that the device draws. System and device must outlive it.
  Headset(HeadsetSystem& system, Device& device, const HeadsetOptions& options);
  ~Headset() override;
  Headset(const Headset&) = delete;
  Headset& operator=(const Headset&) = delete;

  const char* name() const override { return "headset"; }
  int views() const override { return 2; }
  // Throws HeadsetLost where the runtime is gone. A session that is lost is begun anew, as soon as the runtime gives
  // one.
  DisplayFrame begin() override;
  bool tracks_head() const override { return true; }
  Viewpoint viewpoint(const Pose& carrier) const override;
  void end(Frame& frame, const RenderTarget* picture, const Image* depth = nullptr) override;
  const Input& input() const override { return input_; }
  void set_post(Post post) override { post_ = post; }
  std::optional<Pose> head() const override { return head_; }
  void recentre() override { recentre_wanted_ = true; }
  void buzz(int hand, double strength, double seconds) override;
  std::unique_ptr<HeldPicture> hold_picture() override;
  bool in_real_time() const override { return options_.in_real_time; }
  void set_scale(double scale) override { options_.scale = scale; }
  double scale() const override { return double(height_) / system_.facts().height; }
  void set_rate(double rate_hz) override;
  void set_left_handed(bool left_handed) override;
  void set_stature(bool seated, double eye_height_m) override;
  void leave() override;
  VkFormat colour() const override { return colour_; }
  bool shows_depth() const override { return depth_format_ != VK_FORMAT_UNDEFINED; }
  glm::uvec2 most_size() const override { return room_; }
  const HiddenMesh* hidden() const override { return mask_.offered() || options_.symmetric ? &mask_.mesh() : nullptr; }

  // A layer over the picture, submitted with it.
  struct Quad {
    XrSwapchain swapchain;
    std::uint32_t width, height;  // of it, pixels
    Pose at;                      // its middle, from the floor's middle; it faces +z
    glm::dvec2 size_m;
  };
  class Layer {
   public:
    virtual ~Layer() = default;
    // Records into the frame what it shows, and says where; nothing: nothing to show.
    virtual std::optional<Quad> draw(Frame& frame) = 0;
    virtual void release() = 0;  // once that is submitted
    virtual void reset() = 0;    // the session is gone, and all that was made of it
  };
  void show(Layer* layer) { layer_ = layer; }  // null: none
  std::unique_ptr<Overlay> make_overlay() override;
  double period_s() const { return double(frame_state_.predictedDisplayPeriod) * 1e-9; }
  const HeadsetSystem& system() const { return system_; }
  XrSession session() const { return session_; }
  // Waits for the time of a frame and ends it with what the last one showed, on any thread between two frames. False,
  // and nothing more to be done, where that showed nothing or the runtime refuses.
  bool repeat_frame();

  // Has each call told, in order.
  void report_to(std::function<void(const HeadsetCall&)> report) { report_ = std::move(report); }

 private:
  void begin_session();
  void end_session();
  void choose_space();
  void make_pictures();
  void ask_for_rate();
  void take_events();
  void take_state(XrSessionState state);
  void move_space();
  void lay_floor(XrTime time);
  double floor_of_who_stands_m() const;
  void choose_size();
  void begin_frame(DisplayFrame& frame);
  void pass_time(XrTime time);
  void begin_another_session();
  void lose_session(const SessionLost& fault);
  void controllers_gather();
  void centre_under_head();
  void locate() const;
  std::array<Fov, 2> located_fields() const;
  void size_pictures(DisplayFrame& frame);
  void hand_over(Frame& frame, const RenderTarget& picture, const Image* depth);
  void end_frame(bool shown, bool with_depth = false);
  XrResult submit(XrTime time) const;
  void tell(const HeadsetCall& call) const;
  void tell(HeadsetCall::Kind kind, std::span<const XrView> views = {}) const;

  HeadsetSystem& system_;
  const XrApi& api_;
  Device& device_;
  HeadsetOptions options_;
  XrSession session_ = XR_NULL_HANDLE;
  XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
  XrSpace space_ = XR_NULL_HANDLE, view_space_ = XR_NULL_HANDLE;
  XrReferenceSpaceType space_type_ = XR_REFERENCE_SPACE_TYPE_LOCAL;
  XrPosef space_offset_ = nowhere;
  double floor_m_ = 0.0;          // its height in the runtime's own space
  bool stature_changed_ = false;  // since the floor was laid
  std::unique_ptr<HeadsetInput> controllers_;
  mutable HeadsetMask mask_;
  VkFormat colour_ = VK_FORMAT_UNDEFINED, depth_format_ = VK_FORMAT_UNDEFINED;
  HeadsetSwapchain colours_, depths_;
  std::shared_ptr<const LentImages> lent_;
  std::uint32_t width_ = 0, height_ = 0, most_width_ = 0, most_height_ = 0;
  glm::uvec2 room_{0u};                       // of the images: for the largest pictures, and what is drawn beside them
  glm::uvec2 shown_{0u}, drawn_{0u};          // of this frame: what the eyes are shown, within what is drawn
  mutable std::array<FieldPart, 2> parts_{};  // which part of it
  Layer* layer_ = nullptr;
  std::optional<Quad> quad_;  // of this frame
  struct Submitted {          // a picture, as the last frame showed it
    std::array<XrView, 2> views;
    std::array<XrRect2Di, 2> rects;
    bool with_depth;
    std::optional<Quad> quad;
  };
  std::optional<Submitted> submitted_;  // nothing: that frame showed nothing
  bool running_ = false;                // between xrBeginSession and xrEndSession
  bool session_lost_ = false, closed_ = false, recentre_wanted_ = false, moved_ = false;
  bool frame_begun_ = false, should_render_ = false, had_focus_ = false, lost_focus_ = false;
  XrFrameState frame_state_{XR_TYPE_FRAME_STATE};
  std::optional<XrTime> last_time_;  // of this session
  std::int64_t elapsed_ns_ = 0;      // of all sessions
  Post post_ = Post::afoot;
  InputGatherer gatherer_;
  Input input_;
  mutable std::optional<Pose> head_;
  mutable std::array<XrView, 2> located_{};
  mutable std::array<View, 2> eyes_{};  // in the space
  mutable bool fov_told_ = false;
  std::function<void(const HeadsetCall&)> report_;
};

}  // namespace seascape
