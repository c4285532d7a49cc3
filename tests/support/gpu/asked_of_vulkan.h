// What all that is alive on a device has asked of Vulkan, in Vulkan's own terms, and what of it a profile lacks.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "engine/objects.h"
#include "tests/support/gpu/standalone_profile.h"

namespace seascape::test {

struct Asked {
  struct Number {
    std::uint64_t most = 0;
    std::string by;  // who asked for the most
  };
  std::map<std::string, Number, std::less<>> numbers;  // by ProfileLimit::name
  std::map<std::uint32_t, std::string> capabilities;   // of SPIR-V, and the shader that declares each
  std::map<std::string, std::string> extensions;       // likewise
  std::map<VkFormat, std::map<VkFormatFeatureFlagBits, std::string>> formats;  // and the image that has each
  std::map<std::uint32_t, std::string> samples;

  void ask(std::string_view limit, std::uint64_t number, const std::string& by);
  // The most of both.
  void merge(const Asked& other);
};

// Of images, views, buffers, samplers and pipelines with their shaders. Every sampled image is taken to be filtered,
// and every colour image that is drawn into to be blended into.
Asked asked_by(const std::vector<ObjectRecord>& objects);

// A sentence for each limit that is exceeded, and for each thing that the profile does not have.
std::vector<std::string> beyond(const StandaloneProfile& profile, const Asked& asked);

}  // namespace seascape::test
