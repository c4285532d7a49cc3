#include "platform/headset_overlay.h"

#include <imgui.h>

#include <backends/imgui_impl_vulkan.h>

#include <algorithm>
#include <utility>

#include "platform/overlay_drawing.h"

namespace seascape {

namespace {

constexpr double before_m = 1.2, below_m = 0.15;        // of the board, against the head
constexpr double press_strength = 0.4, press_s = 0.02;  // what a hand feels of it
constexpr float font_scale = 2.0f;  // 13 pixels of 0.9 m on 900 at 1.2 m are 0.6 degrees: too small to read

// ImGui's calls go to the context that is current: each overlay has its own.
class Current {
 public:
  explicit Current(ImGuiContext* context) : before_(ImGui::GetCurrentContext()) { ImGui::SetCurrentContext(context); }
  ~Current() { ImGui::SetCurrentContext(before_); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  ImGuiContext* before_;
};

TargetSpec board_spec(std::uint32_t width, std::uint32_t height, VkFormat colour) {
  TargetSpec spec;
  spec.width = width;
  spec.height = height;
  spec.colour = colour;
  spec.depth = false;
  spec.clear = {0.0f, 0.0f, 0.0f, 0.0f};
  return spec;
}

}  // namespace

std::optional<glm::dvec2> pointed_at(const Pose& ray, const Pose& board, const glm::dvec2& size_m) {
  const Pose seen = composed(inverse(board), ray);
  const glm::dvec3 from = seen.position_m, ahead = seen.orientation * glm::dvec3(0.0, 0.0, -1.0);
  if (from.z <= 0.0 || ahead.z >= -1e-6) return std::nullopt;
  const glm::dvec3 met = from + ahead * (from.z / -ahead.z);
  const glm::dvec2 share(met.x / size_m.x + 0.5, 0.5 - met.y / size_m.y);
  if (share.x < 0.0 || share.x > 1.0 || share.y < 0.0 || share.y > 1.0) return std::nullopt;
  return share;
}

HeadsetOverlay::HeadsetOverlay(Device& device, Headset& headset) : device_(device), headset_(headset) {
  const EffectScope scope(device, "panel");
  make_board();
  ImGuiContext* const before = ImGui::GetCurrentContext();
  context_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(before);  // the first of a process would else stay current, and outlive its end so
  const Current current(context_);
  ImGui::GetIO().DisplaySize = {float(width_), float(height_)};
  ImGui::GetIO().MouseDrawCursor = true;
  pool_ = start_overlay_drawing(device, board_.render_pass(), font_scale, "panel");
  headset.show(this);
}

HeadsetOverlay::~HeadsetOverlay() {
  headset_.show(nullptr);
  device_.wait_for_gpu();
  {
    const Current current(context_);
    ImGui_ImplVulkan_Shutdown();
  }
  ImGui::DestroyContext(context_);
}

// Of the session that there is.
void HeadsetOverlay::make_board() {
  const EffectScope scope(device_, "panel");
  HeadsetSwapchainSpec spec{
      width_, height_, 1, headset_.colour(),
      XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT};
  swapchain_ = HeadsetSwapchain(headset_.system(), device_, headset_.session(), spec);
  const LentImages lent{width_, height_, swapchain_.images(), {}};
  board_ = RenderTarget(device_, "panel", board_spec(width_, height_, headset_.colour()), &lent);
}

void HeadsetOverlay::reset() {
  board_ = {};
  swapchain_ = {};
}

// Before the head, upright, facing it.
void HeadsetOverlay::place() {
  const Pose head = headset_.head().value_or(Pose{{0.0, 1.7, 0.0}});
  const glm::dquat turned = heading(head.orientation);
  at_ = {head.position_m + turned * glm::dvec3(0.0, -below_m, -before_m), turned};
}

void HeadsetOverlay::point() {
  ImGuiIO& io = ImGui::GetIO();
  const Input& input = headset_.input();
  const glm::dvec2 size_m(width_m_, width_m_ * height_ / width_);
  pointed_at_ = false;
  constexpr float away = -1e9f;
  io.MousePos = {away, away};
  const bool was_down = std::exchange(io.MouseDown[0], false);
  if (!shown_) return;
  for (const std::size_t hand : {1u, 0u}) {
    if (!input.hands[hand]) continue;
    const std::optional<glm::dvec2> at = pointed_at(input.hands[hand]->aim, at_, size_m);
    if (!at) continue;
    io.MousePos = {float(at->x * width_), float(at->y * height_)};
    io.MouseDown[0] = input.held(hand == 0 ? Action::select_left : Action::select_right);
    io.MouseWheel = float(input.value(Action::move_y)) * io.DeltaTime * 10.0f;
    if (io.MouseDown[0] && !was_down) headset_.buzz(int(hand), press_strength, press_s);
    pointed_at_ = true;
    return;
  }
}

void HeadsetOverlay::begin(bool) {
  before_ = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().DeltaTime = float(std::clamp(headset_.period_s(), 1e-3, 0.1));
  point();
  ImGui_ImplVulkan_NewFrame();
  ImGui::NewFrame();
}

void HeadsetOverlay::end() {
  ImGui::Render();
  const ImDrawData* data = ImGui::GetDrawData();
  // ImGui draws its pointer always: what else there is counts.
  renders_ = data->TotalVtxCount > 0 && ImGui::GetIO().MetricsRenderWindows > 0;
  if (renders_ && !shown_) place();
  shown_ = renders_;
  ImGui::SetCurrentContext(before_);
}

std::optional<Headset::Quad> HeadsetOverlay::draw(Frame& frame) {
  if (!renders_) return std::nullopt;
  if (!swapchain_) make_board();
  {
    const std::lock_guard lock(device_.queue_mutex());
    board_.choose(swapchain_.acquire(), 0);
  }
  const Current current(context_);
  frame.draw_pass("panel", board_, {},
                  [](Commands& c) { ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), c.raw()); });
  return Headset::Quad{swapchain_.get(), width_, height_, at_, {width_m_, width_m_ * height_ / width_}};
}

void HeadsetOverlay::release() { swapchain_.release(); }

}  // namespace seascape
