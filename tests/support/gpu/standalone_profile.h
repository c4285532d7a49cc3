// The limits of a standalone headset, as data: what low and medium may ask of Vulkan. Of two devices or sources the
// stricter counts.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

#include "engine/vulkan.h"

namespace seascape::test {

// Where the rows are from. Quest 2 has an Adreno 650, Quest 3 an Adreno 740; both run Android and have what its profile
// promises. No public report of their drivers' limits was at hand, so that their own numbers, which are larger, are not
// used.
namespace source {
// Vulkan 1.1 specification, table "Required Limits"; the same numbers are in Khronos' Vulkan-Profiles,
// VP_LUNARG_minimum_requirements_1_1.
inline constexpr std::string_view vulkan = "Vulkan 1.1, Required Limits";
// Vulkan 1.1 specification, tables "Mandatory format support".
inline constexpr std::string_view formats = "Vulkan 1.1, Mandatory format support";
// Khronos' Vulkan-Profiles, profiles/Android/VP_ANDROID_vulkan_profile_2022.json (Vulkan 1.1.106).
inline constexpr std::string_view android = "Android Vulkan profile 2022";
// Khronos' hello_xr, which runs on Quest, draws with it: graphicsplugin_vulkan.cpp, m_depthFormat.
inline constexpr std::string_view hello_xr = "OpenXR-SDK-Source, hello_xr";
// developers.meta.com/horizon/documentation/unreal/po-memory-ram: an app on Quest 2 may take 4.4 GiB, on Quest 3 5.75.
inline constexpr std::string_view memory = "Meta, memory limits";
// Meta's performance targets (shared/facts/headset.md, section 4): Quest 2 50 to 100 draws and less than 750,000
// triangles a frame, Quest 3 150 draws and less than 1,000,000.
inline constexpr std::string_view targets = "Meta, performance targets";
}  // namespace source

struct ProfileLimit {
  std::string_view name;  // Vulkan's, where it has one
  std::uint64_t most;
  std::string_view from;
};

inline constexpr ProfileLimit standalone_limits[] = {
    {"maxImageDimension2D", 4096, source::vulkan},
    {"maxImageArrayLayers", 256, source::vulkan},
    {"maxUniformBufferRange", 16384, source::vulkan},
    {"maxStorageBufferRange", 134217728, source::vulkan},
    {"maxPushConstantsSize", 128, source::vulkan},
    {"maxMemoryAllocationCount", 4096, source::vulkan},
    {"maxSamplerAllocationCount", 4000, source::vulkan},
    {"maxBoundDescriptorSets", 4, source::vulkan},
    {"maxPerStageDescriptorSamplers", 16, source::vulkan},
    {"maxPerStageDescriptorUniformBuffers", 12, source::vulkan},
    {"maxPerStageDescriptorStorageBuffers", 4, source::vulkan},
    {"maxPerStageDescriptorSampledImages", 16, source::vulkan},
    {"maxPerStageDescriptorStorageImages", 4, source::vulkan},
    {"maxPerStageResources", 44, source::android},  // Vulkan 1.1: 128
    {"maxDescriptorSetSamplers", 48, source::android},
    {"maxDescriptorSetUniformBuffersDynamic", 8, source::vulkan},
    {"maxDescriptorSetStorageBuffers", 24, source::vulkan},
    {"maxDescriptorSetSampledImages", 48, source::android},
    {"maxDescriptorSetStorageImages", 12, source::android},
    {"maxPerSetDescriptors", 1024, source::vulkan},
    {"maxVertexInputAttributes", 16, source::vulkan},
    {"maxVertexOutputComponents", 64, source::vulkan},
    {"maxFragmentInputComponents", 64, source::vulkan},
    {"maxFragmentOutputAttachments", 4, source::vulkan},
    {"maxFragmentCombinedOutputResources", 4, source::vulkan},  // Android: 8
    {"maxComputeSharedMemorySize", 16384, source::vulkan},
    {"maxComputeWorkGroupInvocations", 128, source::vulkan},
    {"maxComputeWorkGroupSize[0]", 128, source::vulkan},
    {"maxComputeWorkGroupSize[1]", 128, source::vulkan},
    {"maxComputeWorkGroupSize[2]", 64, source::vulkan},
    {"maxMultiviewViewCount", 6, source::vulkan},
    // An eighth of what an app may take: the rest is the process itself, with the sea on the processor, recorded loops
    // and sounds, and the runtime's swapchains.
    {"bytes of buffers and images", 4505ull * 1024 * 1024 / 8, source::memory},
    {"draws", 100, source::targets},
    {"triangles", 750000, source::targets},
};

// SPIR-V capabilities, by number.
struct ProfileCapability {
  std::uint32_t capability;
  std::string_view name, from;
};
inline constexpr ProfileCapability standalone_capabilities[] = {

    {0, "Matrix", source::vulkan},
    {1, "Shader", source::vulkan},
    {50, "ImageQuery", source::vulkan},
    {4439, "MultiView", source::vulkan},
    {52, "InterpolationFunction", source::android},  // surface_clip.frag, where the device has sampleRateShading
};

// What a format's images may be used for.
struct ProfileFormat {
  VkFormat format;
  VkFormatFeatureFlags features;
  std::string_view from;
};
inline constexpr VkFormatFeatureFlags sampled_linear =
    VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
inline constexpr VkFormatFeatureFlags blended =
    VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
inline constexpr ProfileFormat standalone_formats[] = {
    {VK_FORMAT_R8G8B8A8_UNORM, sampled_linear | blended | VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, source::formats},
    {VK_FORMAT_R8G8B8A8_SRGB, sampled_linear | blended, source::formats},
    {VK_FORMAT_R16_SFLOAT, sampled_linear | blended, source::formats},
    {VK_FORMAT_R16G16_SFLOAT, sampled_linear | blended, source::formats},
    {VK_FORMAT_R16G16B16A16_SFLOAT, sampled_linear | blended | VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, source::formats},
    {VK_FORMAT_R32G32B32A32_SFLOAT,
     VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT,
     source::formats},
    // Vulkan has 32-bit depth or 24-bit, as the device likes.
    {VK_FORMAT_D32_SFLOAT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
     source::hello_xr},
    // With a stencil every device has one of two formats, and ours is taken where it is this one.
    {VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
     source::formats},
};

// Samples of a target: 1 and 4 on every device (Vulkan 1.1, Required Limits).
inline constexpr std::uint32_t standalone_samples = VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT;

struct StandaloneProfile {
  std::span<const ProfileLimit> limits = standalone_limits;
  std::span<const ProfileCapability> capabilities = standalone_capabilities;
  std::span<const ProfileFormat> formats = standalone_formats;
  std::uint32_t samples = standalone_samples;
};

// An eye of Quest 2 at its recommended size, and how far it sees, in degrees.
inline constexpr std::uint32_t standalone_width = 1440, standalone_height = 1584;

}  // namespace seascape::test
