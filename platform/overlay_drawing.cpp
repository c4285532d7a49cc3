#include "platform/overlay_drawing.h"

#include <imgui.h>

#include <backends/imgui_impl_vulkan.h>

#include <cmath>

#include "engine/frame.h"

namespace seascape {

namespace {

// ImGui writes its colours as they are, and the window's images are sRGB: the colours must be linear light for that.
void make_linear(ImVec4& colour) {
  const auto linear = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
  colour = {linear(colour.x), linear(colour.y), linear(colour.z), colour.w};
}

void set_style(float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  ImGui::StyleColorsDark(&style);
  style.Colors[ImGuiCol_WindowBg] = {0.05f, 0.07f, 0.10f, 0.96f};
  style.Colors[ImGuiCol_Header] = {0.12f, 0.30f, 0.42f, 1.0f};
  style.Colors[ImGuiCol_HeaderHovered] = {0.16f, 0.40f, 0.55f, 1.0f};
  style.Colors[ImGuiCol_FrameBg] = {0.13f, 0.18f, 0.24f, 1.0f};
  style.Colors[ImGuiCol_FrameBgHovered] = {0.18f, 0.27f, 0.36f, 1.0f};
  style.Colors[ImGuiCol_TitleBgActive] = {0.10f, 0.26f, 0.38f, 1.0f};
  style.Colors[ImGuiCol_SliderGrab] = {0.16f, 0.42f, 0.58f, 1.0f};  // dark enough for the figures over it
  style.Colors[ImGuiCol_SliderGrabActive] = {0.20f, 0.52f, 0.70f, 1.0f};
  style.Colors[ImGuiCol_Button] = {0.12f, 0.30f, 0.42f, 1.0f};
  style.Colors[ImGuiCol_ButtonHovered] = {0.16f, 0.40f, 0.55f, 1.0f};
  style.Colors[ImGuiCol_PlotLines] = {0.70f, 0.85f, 0.95f, 1.0f};
  style.Colors[ImGuiCol_PopupBg] = {0.07f, 0.09f, 0.12f, 0.98f};
  style.Colors[ImGuiCol_TextDisabled] = {0.65f, 0.70f, 0.74f, 1.0f};
  for (ImVec4& colour : style.Colors) make_linear(colour);
  style.WindowRounding = 0.0f;
  style.FrameRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.ScaleAllSizes(scale);
}

}  // namespace

Owned<VkDescriptorPool> start_overlay_drawing(Device& device, VkRenderPass pass, float scale, std::string_view name) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
  VkDescriptorPoolCreateInfo create{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  create.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  create.maxSets = 4;
  create.poolSizeCount = 1;
  create.pPoolSizes = &size;
  VkDescriptorPool handle = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device.handle(), &create, nullptr, &handle), "vkCreateDescriptorPool");
  Owned<VkDescriptorPool> pool(device, handle, name);

  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is written but what the user asks for
  io.LogFilename = nullptr;
  ImFontConfig font;
  font.SizePixels = 13.0f * scale;
  io.Fonts->AddFontDefault(&font);
  set_style(scale);
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
  ImGui_ImplVulkan_Init(&info, pass);
  device.run_now([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
  return pool;
}

}  // namespace seascape
