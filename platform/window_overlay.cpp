#include "platform/window_overlay.h"

#include <imgui.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>

#include <algorithm>
#include <cmath>

#include "platform/overlay_drawing.h"

namespace seascape {

WindowOverlay::WindowOverlay(Device& device, Window& window) : device_(device), window_(window) {
  const EffectScope scope(device, "window");
  context_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(context_);
  ImGui_ImplGlfw_InitForVulkan(window.handle(), true);  // its callbacks call the window's own, which were there first
  // Half sizes would blur the font, which is a bitmap of 13 pixels.
  const float scale = float(std::max(1.0, std::round(window.content_scale())));
  pool_ = start_overlay_drawing(device, window.overlay_pass(), scale, "overlay");
  window.before_events([context = context_] { ImGui::SetCurrentContext(context); });
  window.draw_over([context = context_](VkCommandBuffer commands, std::uint32_t width, std::uint32_t height) {
    ImGui::SetCurrentContext(context);
    ImDrawData* data = ImGui::GetDrawData();
    // A window that has changed since the widgets were laid out: they are drawn when they fit again.
    if (data && data->DisplaySize.x * data->FramebufferScale.x <= float(width) &&
        data->DisplaySize.y * data->FramebufferScale.y <= float(height))
      ImGui_ImplVulkan_RenderDrawData(data, commands);
  });
}

WindowOverlay::~WindowOverlay() {
  window_.draw_over(nullptr);
  window_.before_events(nullptr);
  device_.wait_for_gpu();
  ImGui::SetCurrentContext(context_);
  ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context_);
}

void WindowOverlay::begin(bool pointer_is_free) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  if (pointer_is_free)
    io.ConfigFlags &= ~ImGuiConfigFlags_NoMouse;
  else
    io.ConfigFlags |= ImGuiConfigFlags_NoMouse;
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void WindowOverlay::end() {
  ImGui::SetCurrentContext(context_);
  ImGui::Render();
}

bool WindowOverlay::wants_keyboard() const {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetIO().WantTextInput;
}

bool WindowOverlay::wants_pointer() const {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetIO().WantCaptureMouse;
}

}  // namespace seascape
