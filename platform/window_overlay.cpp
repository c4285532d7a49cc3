#include "platform/window_overlay.h"

#include <imgui.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>

#include <algorithm>
#include <cmath>

#include "platform/overlay_style.h"

namespace seascape {

WindowOverlay::WindowOverlay(Device& device, Window& window) : device_(device), window_(window) {
  const EffectScope scope(device, "window");
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  pool.maxSets = 4;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  VkDescriptorPool handle = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device.handle(), &pool, nullptr, &handle), "vkCreateDescriptorPool");
  pool_ = Owned<VkDescriptorPool>(device, handle, "overlay");

  context_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is written but what the user asks for
  io.LogFilename = nullptr;
  // Half sizes would blur the font, which is a bitmap of 13 pixels.
  const float scale = float(std::max(1.0, std::round(window.content_scale())));
  ImFontConfig font;
  font.SizePixels = 13.0f * scale;
  io.Fonts->AddFontDefault(&font);
  set_overlay_style(scale);
  ImGui_ImplGlfw_InitForVulkan(window.handle(), true);  // its callbacks call the window's own, which were there first
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = device.instance();
  info.PhysicalDevice = device.physical();
  info.Device = device.handle();
  info.QueueFamily = device.queue_family();
  info.Queue = device.queue();
  info.DescriptorPool = handle;
  info.MinImageCount = info.ImageCount = Frame::slots;  // how many of its vertex buffers may be in flight
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = [](VkResult result) { check(result, "the panel's drawing"); };
  ImGui_ImplVulkan_Init(&info, window.overlay_pass());
  device.run_now([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
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
