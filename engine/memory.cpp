#include "engine/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/device.h"
#include "engine/error.h"

namespace seascape {

namespace {
constexpr VkDeviceSize block_size = 64u << 20;

VkDeviceSize align(VkDeviceSize value, VkDeviceSize alignment) {
  return (value + alignment - 1) / alignment * alignment;
}
}  // namespace

Allocation::Allocation(Allocation&& other) noexcept { *this = std::move(other); }

Allocation& Allocation::operator=(Allocation&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(memory_, other.memory_);
  std::swap(offset_, other.offset_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

Allocation::~Allocation() {
  if (memory_) device_->retire_memory(memory_, offset_);
}

Memory::Memory(Device& device, std::optional<std::uint8_t> holds) : device_(device), holds_(holds) {
  vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties_);
}

Memory::~Memory() {
  for (auto& block : blocks_) vkFreeMemory(device_.handle(), block->memory, nullptr);
}

Memory::Block& Memory::new_block(std::uint32_t type, bool image, VkDeviceSize least) {
  auto block = std::make_unique<Block>();
  block->size = std::max(least, least > block_size / 2 ? least : block_size);
  block->type = type;
  block->image = image;
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = block->size;
  info.memoryTypeIndex = type;
  VkResult result = vkAllocateMemory(device_.handle(), &info, nullptr, &block->memory);
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY && block->size > least) {  // a small device: take just what is needed
    info.allocationSize = block->size = least;
    result = vkAllocateMemory(device_.handle(), &info, nullptr, &block->memory);
  }
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
    throw Error(device_.facts().name, fmt::format("no memory left for {} MiB more", least >> 20),
                "choose a smaller --size, fewer msaa samples or a lower --preset");
  check(result, "vkAllocateMemory");
  if (properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) {
    void* mapped = nullptr;
    result = vkMapMemory(device_.handle(), block->memory, 0, VK_WHOLE_SIZE, 0, &mapped);
    if (result < 0) vkFreeMemory(device_.handle(), block->memory, nullptr);
    check(result, "vkMapMemory");
    block->mapped = static_cast<char*>(mapped);
  }
  block->free.push_back({0, block->size});
  blocks_.push_back(std::move(block));
  return *blocks_.back();
}

Allocation Memory::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted,
                            VkMemoryPropertyFlags preferred, bool image) {
  int best = -1;
  for (int pass = 0; pass < 2 && best < 0; ++pass) {
    const VkMemoryPropertyFlags flags = pass == 0 ? wanted | preferred : wanted;
    for (std::uint32_t t = 0; t < properties_.memoryTypeCount && best < 0; ++t)
      if ((needs.memoryTypeBits >> t & 1u) && (properties_.memoryTypes[t].propertyFlags & flags) == flags)
        best = int(t);
  }
  if (best < 0) throw Error(device_.facts().name, "the device has no memory of the kind needed", "use another device");
  const auto type = std::uint32_t(best);

  auto take = [&](Block& block) -> std::pair<bool, VkDeviceSize> {
    for (std::size_t i = 0; i < block.free.size(); ++i) {
      const Range range = block.free[i];
      const VkDeviceSize start = align(range.offset, needs.alignment);
      if (start + needs.size > range.offset + range.size) continue;
      block.free.erase(block.free.begin() + std::ptrdiff_t(i));
      if (start + needs.size < range.offset + range.size)
        block.free.insert(block.free.begin() + std::ptrdiff_t(i),
                          {start + needs.size, range.offset + range.size - start - needs.size});
      if (start > range.offset)
        block.free.insert(block.free.begin() + std::ptrdiff_t(i), {range.offset, start - range.offset});
      block.used.push_back({start, needs.size});
      return {true, start};
    }
    return {false, 0};
  };
  const std::lock_guard lock(mutex_);
  Block* chosen = nullptr;
  VkDeviceSize offset = 0;
  for (auto& block : blocks_)
    if (block->type == type && block->image == image)
      if (auto [fits, at] = take(*block); fits) {
        chosen = block.get();
        offset = at;
        break;
      }
  if (!chosen) {
    chosen = &new_block(type, image, needs.size);
    offset = take(*chosen).second;
  }
  Allocation allocation;
  allocation.device_ = &device_;
  allocation.memory_ = chosen->memory;
  allocation.offset_ = offset;
  allocation.mapped_ = chosen->mapped ? chosen->mapped + offset : nullptr;
  if (holds_ && allocation.mapped_ != nullptr) std::memset(allocation.mapped_, *holds_, needs.size);
  return allocation;
}

void Memory::free(VkDeviceMemory memory, VkDeviceSize offset) {
  const std::lock_guard lock(mutex_);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = *blocks_[b];
    if (block.memory != memory) continue;
    auto used = std::find_if(block.used.begin(), block.used.end(), [&](const Range& r) { return r.offset == offset; });
    if (used == block.used.end()) return;
    const Range range = *used;
    block.used.erase(used);
    if (block.used.empty()) {  // an empty block goes back whole, so that memory returns to its baseline
      vkFreeMemory(device_.handle(), block.memory, nullptr);
      blocks_.erase(blocks_.begin() + std::ptrdiff_t(b));
      return;
    }
    auto next = std::find_if(block.free.begin(), block.free.end(), [&](const Range& r) { return r.offset > offset; });
    next = block.free.insert(next, range);
    if (next + 1 != block.free.end() && next->offset + next->size == (next + 1)->offset) {
      next->size += (next + 1)->size;
      block.free.erase(next + 1);
    }
    if (next != block.free.begin() && (next - 1)->offset + (next - 1)->size == next->offset) {
      (next - 1)->size += next->size;
      block.free.erase(next);
    }
    return;
  }
}

std::uint64_t Memory::block_bytes() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t sum = 0;
  for (const auto& block : blocks_) sum += block->size;
  return sum;
}

std::uint64_t Memory::used_bytes() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t sum = 0;
  for (const auto& block : blocks_)
    for (const Range& range : block->used) sum += range.size;
  return sum;
}

std::size_t Memory::blocks() const {
  const std::lock_guard lock(mutex_);
  return blocks_.size();
}

}  // namespace seascape
