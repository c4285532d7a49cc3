#include "platform/headset.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "platform/headset_overlay.h"

namespace seascape {

namespace {

bool fov_is_sound(const XrFovf& fov) {
  constexpr float most = 1.55f, least = 0.017f;  // 89 degrees, and one from side to side
  return fov.angleRight - fov.angleLeft > least && fov.angleUp - fov.angleDown > least &&
         std::abs(fov.angleLeft) < most && std::abs(fov.angleRight) < most && std::abs(fov.angleUp) < most &&
         std::abs(fov.angleDown) < most;
}

std::uint32_t pixels(double asked, std::uint32_t most) {
  return std::uint32_t(std::clamp(std::round(asked), 1.0, double(most)));
}

constexpr XrFovf usual_fov{-0.785f, 0.785f, 0.785f, -0.785f};

Fov fov_from(const XrFovf& fov) {
  return {std::tan(double(fov.angleLeft)), std::tan(double(fov.angleRight)), std::tan(double(fov.angleUp)),
          std::tan(double(fov.angleDown))};
}

}  // namespace

Headset::Headset(HeadsetSystem& system, Device& device, const HeadsetOptions& options)
    : system_(system), api_(system.api()), device_(device), options_(options), mask_(system) {
  const HeadsetFacts& facts = system.facts();
  most_width_ = options.width ? options.width : pixels(facts.width * options.most_scale, facts.most_width);
  most_height_ = options.height ? options.height : pixels(facts.height * options.most_scale, facts.most_height);
  most_width_ = std::min(most_width_, facts.most_width);
  most_height_ = std::min(most_height_, facts.most_height);
  room_ = {most_width_, most_height_};
  if (options.symmetric) {
    constexpr double wider = 1.5, higher = 1.2;  // the field of both eyes against one's: headsets have 1.1 to 1.4
    room_ = {pixels(wider * most_width_, facts.most_width), pixels(higher * most_height_, facts.most_height)};
  }
  choose_size();
  for (XrView& view : located_) view = {XR_TYPE_VIEW, nullptr, nowhere, usual_fov};
  try {
    begin_session();
  } catch (...) {
    end_session();
    throw;
  }
  spdlog::info("headset: {} on {} {}, {}x{} pixels an eye", facts.headset, facts.runtime, facts.runtime_version, width_,
               height_);
}

Headset::~Headset() {
  device_.wait_for_gpu();
  try {
    if (frame_begun_) end_frame(false);
  } catch (const Error&) {  // there is nobody left to show anything
  }
  end_session();
}

// Between frames: what is drawn is as large as what is shown of it.
void Headset::choose_size() {
  const HeadsetFacts& facts = system_.facts();
  width_ = pixels((options_.width ? options_.width : facts.width) * options_.scale, most_width_);
  height_ = pixels((options_.height ? options_.height : facts.height) * options_.scale, most_height_);
}

void Headset::set_rate(double rate_hz) {
  if (rate_hz == options_.rate_hz) return;
  options_.rate_hz = rate_hz;
  if (session_ && !session_lost_) ask_for_rate();
}

// What is held as the hands change does not count for the other.
void Headset::set_left_handed(bool left_handed) {
  if (std::exchange(options_.left_handed, left_handed) != left_handed) gatherer_.reset();
}

void Headset::set_stature(bool seated, double eye_height_m) {
  if (seated == options_.seated && eye_height_m == options_.eye_height_m) return;
  options_.seated = seated;
  options_.eye_height_m = eye_height_m;
  stature_changed_ = true;
}

// begin() makes another. There is no frame of a lost session to end.
void Headset::lose_session(const SessionLost& fault) {
  if (!session_lost_) spdlog::warn("headset: the session is lost ({}); waiting for another", fault.fault());
  session_lost_ = true;
  frame_begun_ = should_render_ = false;
}

void Headset::tell(const HeadsetCall& call) const {
  if (report_) report_(call);
}

void Headset::tell(HeadsetCall::Kind kind, std::span<const XrView> views) const {
  tell({kind, frame_state_.predictedDisplayTime, {views.begin(), views.end()}});
}

// Waits for the time to draw, and begins a frame.
void Headset::begin_frame(DisplayFrame& frame) {
  frame_state_ = {XR_TYPE_FRAME_STATE};
  check_xr(api_.WaitFrame(session_, nullptr, &frame_state_), "xrWaitFrame");
  tell(HeadsetCall::Kind::wait);
  const XrTime time = frame_state_.predictedDisplayTime;
  pass_time(time);
  if (stature_changed_) lay_floor(time);
  controllers_->sync(session_, space_, time, post_, options_.left_handed, state_ == XR_SESSION_STATE_FOCUSED);
  const std::lock_guard lock(device_.queue_mutex());
  check_xr(api_.BeginFrame(session_, nullptr), "xrBeginFrame");
  tell(HeadsetCall::Kind::begin);
  frame_begun_ = true;
  if (frame_state_.shouldRender) {
    frame.colour = colours_.acquire();
    if (depths_) frame.depth = depths_.acquire();
    should_render_ = true;
  }
  frame.period_s = std::max(0.0, double(frame_state_.predictedDisplayPeriod) * 1e-9);
}

// Time stands where a runtime's clock jumps back, and goes on from there.
void Headset::pass_time(XrTime time) {
  constexpr std::int64_t longest_ns = 3'600'000'000'000;
  if (time <= 0) return;  // none at all, to OpenXR
  if (last_time_ && time > *last_time_) elapsed_ns_ += std::min(time - *last_time_, longest_ns);
  last_time_ = time;
}

// Until the runtime gives another session there is none.
void Headset::begin_another_session() {
  device_.wait_for_gpu();
  end_session();
  try {
    begin_session();
    spdlog::info("headset: another session begins");
  } catch (const HeadsetLost&) {
    throw;
  } catch (const Error& fault) {
    spdlog::debug("headset: no session yet: {}", fault.what());
    end_session();
    session_lost_ = true;
  }
}

DisplayFrame Headset::begin() {
  DisplayFrame frame;
  moved_ = should_render_ = false;
  choose_size();
  try {
    take_events();
    if (session_lost_ && !closed_) begin_another_session();
    if (running_ && !closed_) begin_frame(frame);
    if (recentre_wanted_ && head_ && running_) {
      recentre_wanted_ = false;
      centre_under_head();
    }
  } catch (const SessionLost& fault) {
    lose_session(fault);
  }
  if (!frame_begun_ && !closed_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // events are all that comes now
    frame.away = true;
  }
  controllers_gather();
  size_pictures(frame);
  frame.should_render = should_render_;
  frame.time_s = double(elapsed_ns_) * 1e-9;
  frame.closed = closed_;
  frame.focused = state_ == XR_SESSION_STATE_FOCUSED;
  frame.moved = moved_;
  frame.lent = lent_;
  return frame;
}

// By the fields of view that are known now; those of the frame are located when it is drawn.
void Headset::size_pictures(DisplayFrame& frame) {
  shown_ = {width_, height_};
  drawn_ = options_.symmetric ? symmetric_size(located_fields(), shown_, room_) : shown_;
  frame.width = drawn_.x;
  frame.height = drawn_.y;
}

std::array<Fov, 2> Headset::located_fields() const { return {fov_from(located_[0].fov), fov_from(located_[1].fov)}; }

void Headset::controllers_gather() {
  const bool focused = frame_begun_ && controllers_->focused();
  if (focused) {
    if (lost_focus_) gatherer_.reset();  // what is held when the focus comes back was pressed for others
    controllers_->gather(gatherer_);
  }
  lost_focus_ = had_focus_ && !focused;
  had_focus_ = had_focus_ || focused;
  input_ = gatherer_.take();
  input_.hands = focused ? controllers_->hands() : decltype(input_.hands){};
}

// The space's new origin, seen from the old one, is the floor under the head, turned as the head is.
void Headset::centre_under_head() {
  if (options_.seated) floor_m_ += head_->position_m.y - options_.eye_height_m;
  const Pose floor{{head_->position_m.x, 0.0, head_->position_m.z}, heading(head_->orientation)};
  space_offset_ = xr_pose(composed(pose_from(space_offset_), floor));
  move_space();
  moved_ = true;
}

void Headset::locate() const {
  XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO};
  info.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  info.displayTime = frame_state_.predictedDisplayTime;
  info.space = space_;
  XrViewState state{XR_TYPE_VIEW_STATE};
  std::array<XrView, 2> views;
  views.fill({XR_TYPE_VIEW});
  std::uint32_t count = 0;
  const XrResult result = api_.LocateViews(session_, &info, &state, 2, &count, views.data());
  if (result == XR_ERROR_SESSION_LOST) return;  // the next call says so too
  check_xr(result, "xrLocateViews");
  constexpr XrViewStateFlags known = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
  if (count == 2 && (state.viewStateFlags & known) == known)
    for (std::size_t eye = 0; eye < 2; ++eye) {
      if (pose_is_sound(views[eye].pose)) located_[eye].pose = views[eye].pose;
      if (fov_is_sound(views[eye].fov)) {
        located_[eye].fov = views[eye].fov;
      } else if (!fov_told_) {
        fov_told_ = true;
        spdlog::warn(
            "headset: it asks for a field of view from {:.3g} to {:.3g} and {:.3g} to {:.3g} rad: 90 degrees are "
            "drawn instead",
            views[eye].fov.angleLeft, views[eye].fov.angleRight, views[eye].fov.angleDown, views[eye].fov.angleUp);
      }
    }
  tell(HeadsetCall::Kind::locate, located_);
}

Viewpoint Headset::viewpoint(const Pose& carrier) const {
  if (should_render_) locate();
  const std::array<Fov, 2> fields = located_fields();
  if (options_.symmetric) {
    parts_ = symmetric_parts(fields, shown_, drawn_);
    mask_.show_only(fields);
  } else {
    parts_ = {FieldPart{fields[0]}, FieldPart{fields[1]}};
  }
  Viewpoint viewpoint;
  glm::dvec3 middle(0.0);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    eyes_[eye] = {pose_from(located_[eye].pose), parts_[eye].drawn};
    middle += 0.5 * eyes_[eye].pose.position_m;
    viewpoint.eyes.push_back({composed(carrier, eyes_[eye].pose), eyes_[eye].fov});
  }
  // The head lies between its eyes and looks as they do on average, which may squint.
  glm::dquat right = eyes_[1].pose.orientation;
  if (glm::dot(eyes_[0].pose.orientation, right) < 0.0) right = -right;
  head_ = Pose{middle, glm::normalize(eyes_[0].pose.orientation + right)};
  viewpoint.viewer = composed(carrier, *head_);
  viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, drawn_.y);
  return viewpoint;
}

// The runtime takes its images back in the layouts in which it lent them.
void Headset::hand_over(Frame& frame, const RenderTarget& picture, const Image* depth) {
  Uses uses{use(picture.colour(), Access::colour_target)};
  if (depth && depths_) uses.add(use(*depth, Access::depth_target));
  frame.pass("hand over", uses, [](Commands&) {});
}

void Headset::end(Frame& frame, const RenderTarget* picture, const Image* depth) {
  const bool shown = picture != nullptr && should_render_;
  quad_.reset();
  try {
    if (shown && layer_) quad_ = layer_->draw(frame);
  } catch (const SessionLost& fault) {
    lose_session(fault);  // what the frame has drawn is submitted all the same
  }
  if (shown) hand_over(frame, *picture, depth);
  if (picture) frame.submit();
  try {
    if (frame_begun_) end_frame(shown, depth != nullptr);
  } catch (const SessionLost& fault) {
    lose_session(fault);
  }
}

void Headset::end_frame(bool shown, bool with_depth) {
  frame_begun_ = false;
  const std::lock_guard lock(device_.queue_mutex());
  for (HeadsetSwapchain* one : {&colours_, &depths_})
    if (one->acquired()) one->release();
  if (quad_) layer_->release();
  submitted_.reset();
  if (shown && !session_lost_) {
    submitted_ = {located_, {}, with_depth && depths_, quad_};
    for (std::size_t eye = 0; eye < 2; ++eye)
      submitted_->rects[eye] = {{std::int32_t(parts_[eye].from.x), std::int32_t(parts_[eye].from.y)},
                                {std::int32_t(shown_.x), std::int32_t(shown_.y)}};
  }
  tell(HeadsetCall::Kind::end, shown ? std::span<const XrView>(located_) : std::span<const XrView>());
  check_xr(submit(frame_state_.predictedDisplayTime), "xrEndFrame");
}

// Ends the frame of that time with what was submitted last. The queue is still meanwhile.
XrResult Headset::submit(XrTime time) const {
  std::array<XrCompositionLayerProjectionView, 2> views;
  std::array<XrCompositionLayerDepthInfoKHR, 2> depths;
  XrCompositionLayerProjection projection{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD};
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  if (submitted_) {
    for (std::size_t eye = 0; eye < 2; ++eye) {
      XrCompositionLayerProjectionView& view = views[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
      view.pose = submitted_->views[eye].pose;
      view.fov = submitted_->views[eye].fov;
      view.subImage = {colours_.get(), submitted_->rects[eye], std::uint32_t(eye)};
      if (!submitted_->with_depth) continue;
      // Reversed depth: 1 at the near plane, 0 at infinity.
      depths[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR,
                     nullptr,
                     {depths_.get(), submitted_->rects[eye], std::uint32_t(eye)},
                     0.0f,
                     1.0f,
                     FLT_MAX,
                     float(options_.near_m)};
      view.next = &depths[eye];
    }
    projection.space = space_;
    projection.viewCount = 2;
    projection.views = views.data();
    layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection));
  }
  if (submitted_ && submitted_->quad) {
    const Quad& shown = *submitted_->quad;
    quad.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
    quad.space = space_;
    quad.eyeVisibility = XR_EYE_VISIBILITY_BOTH;
    quad.subImage = {shown.swapchain, {{0, 0}, {std::int32_t(shown.width), std::int32_t(shown.height)}}, 0};
    quad.pose = xr_pose(shown.at);
    quad.size = {float(shown.size_m.x), float(shown.size_m.y)};
    layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&quad));
  }
  XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
  info.displayTime = time;
  info.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  info.layerCount = std::uint32_t(layers.size());
  info.layers = layers.data();
  return api_.EndFrame(session_, &info);
}

std::unique_ptr<Overlay> Headset::make_overlay() { return std::make_unique<HeadsetOverlay>(device_, *this); }

void Headset::buzz(int hand, double strength, double seconds) {
  if (controllers_ && state_ == XR_SESSION_STATE_FOCUSED) controllers_->buzz(session_, hand, strength, seconds);
}

void Headset::leave() {
  if (!running_ || XR_FAILED(api_.RequestExitSession(session_))) closed_ = true;
}

}  // namespace seascape
