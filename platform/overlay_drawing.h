// How every overlay of widgets is drawn, wherever it is shown.
#pragma once
#include <string_view>

#include "engine/device.h"

namespace seascape {

// Has the current ImGui context draw in render passes like `pass`, with its fonts `scale` times 13 pixels high, and
// uploads them at once. Returns what its descriptors come from: it outlives ImGui_ImplVulkan_Shutdown().
Owned<VkDescriptorPool> start_overlay_drawing(Device& device, VkRenderPass pass, float scale, std::string_view name);

}  // namespace seascape
