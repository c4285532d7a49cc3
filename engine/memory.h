// Device memory: blocks by memory type, divided first-fit; buffers and images in blocks of their own kind.
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/vulkan.h"

namespace seascape {

class Device;
class Memory;

// A piece of a block; given back after the frames in flight.
class Allocation {
 public:
  Allocation() = default;
  Allocation(Allocation&& other) noexcept;
  Allocation& operator=(Allocation&& other) noexcept;
  ~Allocation();
  VkDeviceMemory memory() const { return memory_; }
  VkDeviceSize offset() const { return offset_; }
  void* mapped() const { return mapped_; }  // null where the host does not see it

 private:
  friend class Memory;
  Device* device_ = nullptr;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkDeviceSize offset_ = 0;
  void* mapped_ = nullptr;
};

// Any thread.
class Memory {
 public:
  // `holds`: what new memory is filled with, where the host sees it (DeviceOptions::memory_holds).
  Memory(Device& device, std::optional<std::uint8_t> holds);
  ~Memory();

  // `wanted` flags are required, `preferred` taken where a type has them too. Throws Error when memory has run out.
  Allocation allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred,
                      bool image);
  void free(VkDeviceMemory memory, VkDeviceSize offset);  // at once; Allocation calls it late

  std::uint64_t block_bytes() const;  // taken from the driver
  std::uint64_t used_bytes() const;   // handed out
  std::size_t blocks() const;         // how many allocations of the driver that is

 private:
  struct Range {
    VkDeviceSize offset, size;
  };
  struct Block {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    std::uint32_t type = 0;
    bool image = false;
    char* mapped = nullptr;
    std::vector<Range> free, used;
  };
  Block& new_block(std::uint32_t type, bool image, VkDeviceSize least);
  Device& device_;
  std::optional<std::uint8_t> holds_;
  VkPhysicalDeviceMemoryProperties properties_{};
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace seascape
