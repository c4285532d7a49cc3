// Vulkan and the check that every one of its results gets, in release builds too.
#pragma once
#include <vulkan/vulkan.h>

namespace seascape {

// Throws Error for any negative result, naming the call; positive results (suboptimal, timeout) pass through.
VkResult check(VkResult result, const char* call);
const char* result_name(VkResult result);

}  // namespace seascape
