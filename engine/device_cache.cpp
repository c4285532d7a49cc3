// The driver's pipelines, kept on disk from one start to the next.
#include <fmt/format.h>

#include <cstring>

#include "engine/device.h"

namespace seascape {

namespace {

std::string name_of(const VkPhysicalDeviceProperties& properties) {
  std::string name =
      fmt::format("pipelines-{:x}-{:x}-{:x}-", properties.vendorID, properties.deviceID, properties.driverVersion);
  for (const std::uint8_t byte : properties.pipelineCacheUUID) name += fmt::format("{:02x}", byte);
  return name;
}

// Whether a cache's own header says that this driver has made it: not every driver looks.
bool is_of(const VkPhysicalDeviceProperties& properties, std::span<const std::uint8_t> data) {
  VkPipelineCacheHeaderVersionOne head;
  if (data.size() < sizeof head) return false;
  std::memcpy(&head, data.data(), sizeof head);
  return head.headerSize >= sizeof head && head.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         head.vendorID == properties.vendorID && head.deviceID == properties.deviceID &&
         std::memcmp(head.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

}  // namespace

void Device::load_pipeline_cache() {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  const auto kept = cache_.read(name_of(properties));
  if (kept && is_of(properties, *kept)) {
    info.initialDataSize = kept->size();
    info.pInitialData = kept->data();
    if (vkCreatePipelineCache(device_, &info, nullptr, &pipeline_cache_) == VK_SUCCESS) {
      kept_hash_ = hash_bytes(*kept);
      return;
    }
  }
  info.initialDataSize = 0;
  info.pInitialData = nullptr;
  check(vkCreatePipelineCache(device_, &info, nullptr, &pipeline_cache_), "vkCreatePipelineCache");
}

void Device::keep_pipeline_cache() const {
  if (cache_.folder().empty() || pipelines_made_ == 0) return;
  std::size_t size = 0;
  if (vkGetPipelineCacheData(device_, pipeline_cache_, &size, nullptr) != VK_SUCCESS || size == 0) return;
  std::vector<std::uint8_t> data(size);
  if (vkGetPipelineCacheData(device_, pipeline_cache_, &size, data.data()) != VK_SUCCESS) return;
  data.resize(size);
  if (hash_bytes(data) == kept_hash_) return;
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  cache_.write(name_of(properties), data);
}

}  // namespace seascape
