// Buffers, images and samplers, each with the memory it lies in and the state its last use left it in.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/device.h"

namespace seascape {

// What the last passes did to a buffer or image; the frame derives barriers from it.
struct UseState {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags write_stages = 0;  // of the last write
  VkAccessFlags write_access = 0;
  VkPipelineStageFlags read_stages = 0;     // of reads since
  VkPipelineStageFlags visible_stages = 0;  // where the last write has been made visible
  VkAccessFlags visible_access = 0;
};

enum class HostAccess {
  none,
  write,
  read
};  // device-local; mapped for upload; mapped and cached, to read what lies there

class Buffer {
 public:
  Buffer() = default;
  Buffer(Device& device, std::string_view name, VkDeviceSize bytes, VkBufferUsageFlags usage,
         HostAccess host = HostAccess::none);
  VkBuffer get() const { return buffer_.get(); }
  VkDeviceSize bytes() const { return bytes_; }
  template <typename T>
  T* mapped() const {
    return static_cast<T*>(allocation_.mapped());
  }
  UseState& state() const { return state_; }
  explicit operator bool() const { return bool(buffer_); }

 private:
  Allocation allocation_;
  Owned<VkBuffer> buffer_;
  VkDeviceSize bytes_ = 0;
  mutable UseState state_;
};

// A device-local buffer filled at once: set-up work.
Buffer make_filled_buffer(Device& device, std::string_view name, const void* data, VkDeviceSize bytes,
                          VkBufferUsageFlags usage);

struct ImageSpec {
  std::uint32_t width = 1, height = 1, layers = 1, levels = 1;
  VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
  VkImageUsageFlags usage = 0;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  bool transient = false;  // lives inside one render pass: lazily allocated where the device has such memory
  bool array = true;       // views are 2-D arrays even with one layer
  VkFormat mutable_as = VK_FORMAT_UNDEFINED;  // another format that views may take
  bool host = false;                          // its texels lie row after row in memory that the host sees and writes
  VkComponentMapping channels{};              // what shaders get as red, green, blue and alpha
};

// Whether the device samples such an image, with linear filters, where the host has written it: software drivers do,
// most others not with levels and layers.
bool host_may_write(const Device& device, const ImageSpec& spec);

class Image {
 public:
  Image() = default;
  Image(Device& device, std::string_view name, const ImageSpec& spec);
  // An image that another owns, such as a swapchain's: only its view is ours. `spec` says what it was made with.
  Image(Device& device, std::string_view name, VkImage borrowed, const ImageSpec& spec);
  VkImage get() const { return borrowed_ ? borrowed_ : image_.get(); }
  VkImageView view() const { return view_.get(); }
  const ImageSpec& spec() const { return spec_; }
  VkImageAspectFlags aspect() const;       // that is read: of depth and stencil, the depth
  VkImageAspectFlags all_aspects() const;  // that it has
  // Of an image that the host writes: a level of a layer, and the bytes from row to row. Sees what the next submission
  // sees.
  struct HostTexels {
    std::byte* first;
    std::size_t row_bytes;
  };
  HostTexels host_texels(std::uint32_t level, std::uint32_t layer) const;
  // A further view of `levels` levels from `level` and `layers` layers from `layer`, owned by the image.
  VkImageView subview(std::uint32_t level, std::uint32_t levels, std::uint32_t layer, std::uint32_t layers,
                      bool array = true);
  // Of depth and stencil, the stencil of all layers, as unsigned integers. Owned by the image.
  VkImageView stencil_view();
  UseState& state() const { return state_; }
  explicit operator bool() const { return get() != VK_NULL_HANDLE; }

 private:
  Owned<VkImageView> make_view(std::uint32_t level, std::uint32_t levels, std::uint32_t layer, std::uint32_t layers,
                               bool array, VkImageAspectFlags aspect);
  Device* device_ = nullptr;
  std::string name_;
  ImageSpec spec_;
  Allocation allocation_;
  Owned<VkImage> image_;
  VkImage borrowed_ = VK_NULL_HANDLE;
  Owned<VkImageView> view_;
  std::vector<Owned<VkImageView>> subviews_;
  mutable UseState state_;
};

struct SamplerSpec {
  bool linear = true;
  bool repeat = true;                              // false: it holds its edge
  float anisotropy = 1.0f;                         // clamped to what the device has
  std::optional<VkSamplerAddressMode> across, up;  // instead of `repeat`
  std::optional<VkCompareOp> compare = {};         // of depths: what is asked for against what is there
};
Owned<VkSampler> make_sampler(Device& device, std::string_view name, const SamplerSpec& spec);

std::uint32_t bytes_per_texel(VkFormat format);

// One level of one layer, tightly packed, after waiting for the device: tests and pictures. `part`: only so much of it,
// from the upper left; with a width of 0 all.
std::vector<std::uint8_t> read_image(Device& device, const Image& image, std::uint32_t layer, std::uint32_t level = 0,
                                     VkExtent2D part = {0, 0});
std::vector<std::uint8_t> read_buffer(Device& device, const Buffer& buffer);

}  // namespace seascape
