// One Vulkan device with its queue, memory and the list of everything alive on it.
#pragma once
#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/disk_cache.h"
#include "engine/memory.h"
#include "engine/objects.h"
#include "engine/vulkan.h"

namespace seascape {

struct DeviceOptions {
  bool validation = false;  // the Khronos layer with synchronization validation; missing layer: Error
  bool core_only = false;   // use nothing beyond Vulkan 1.1's floor, as on a driver that has no more
  bool present = false;     // with a swapchain
  bool show_depth = false;  // depths are shown too, where several samples can be resolved
  std::vector<std::string> instance_extensions;  // what a window needs
  DiskCache cache;                               // where the driver's pipelines are kept for later starts
  // What new memory holds, where the host sees it: a device's may hold anything, and software drivers' mostly holds
  // zeros, by which a test would pass that reads what nobody wrote.
  std::optional<std::uint8_t> memory_holds;

  // A headset's runtime has its own way of making the instance and the device, and says which GPU it shows pictures
  // from. Without them Vulkan's own are called.
  std::function<VkResult(const VkInstanceCreateInfo&, VkInstance*)> create_instance;
  std::function<VkPhysicalDevice(VkInstance)> choose_physical;  // throws Error where it has none
  std::function<VkResult(VkPhysicalDevice, const VkDeviceCreateInfo&, VkDevice*)> create_device;
};

// What the chosen device is and can do.
struct DeviceFacts {
  std::string name, driver, api_version, kind;
  bool software = false;        // a CPU driver such as lavapipe
  bool wireframe = false;       // polygon mode line
  bool float32_linear = false;  // RGBA32F can be filtered
  bool vertex_stores = false;   // vertex shaders may write buffers (test probes only)
  bool sample_shading = false;  // pixels may ask for what lies at their samples
  bool clip_distances = false;  // vertex shaders may cut triangles off at planes of their own
  bool depth_resolve = false;   // a pass can resolve its samples' depth
  bool depth_linear = false;    // depths can be filtered where they are sampled
  bool block_textures = false;  // textures may lie in 4 x 4 blocks: BC1 to BC5
  float max_anisotropy = 1.0f;
  int max_samples = 1;              // of a colour and depth target
  std::uint32_t sample_counts = 1;  // those that it has: a bit each, 2 | 8 say
  bool timestamps = false;
  double timestamp_period_ns = 1.0;
  std::uint32_t max_workgroup = 128, shared_memory = 16384;
  std::uint32_t uniform_alignment = 256;
  std::uint32_t sampled_images = 16;  // that one stage of a pipeline may read
  VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
  VkFormat depth_stencil_format = VK_FORMAT_D32_SFLOAT_S8_UINT;  // or D24_UNORM_S8_UINT: every device has one of them
};

// A discrete GPU, or else an integrated one, or else any; SEASCAPE_DEVICE names another by part of its name. Throws
// Error where none has Vulkan 1.1.
VkPhysicalDevice best_physical(VkInstance instance);

// Objects may be made and given up, shaders loaded and set-up commands run on any thread, while another one draws.
class Device {
 public:
  // Picks best_physical(). Throws
  // Error when there is no loader, no driver or no device with Vulkan 1.1 and multiview.
  explicit Device(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }
  // Held by whoever gives the queue something to do or waits for the device.
  std::mutex& queue_mutex() { return queue_mutex_; }
  std::uint32_t queue_family() const { return queue_family_; }
  const DeviceFacts& facts() const { return facts_; }
  Memory& memory() { return *memory_; }

  void wait_idle();
  void wait_for_gpu() noexcept;  // the same, with nothing freed and no result

  // Validation messages since the start or the last clear, oldest first (validation on only).
  std::vector<std::string> validation_messages() const;
  void clear_validation_messages();

  // Everything alive, in order of creation.
  std::vector<ObjectRecord> objects() const;
  std::uint64_t objects_made() const { return created_; }  // of all kinds, since the start
  std::uint64_t pipelines_made() const { return pipelines_made_; }

  // What a pipeline is to be made with: called once for each. Counted are those that were given what an earlier start
  // has left.
  VkPipelineCache pipeline_cache() {
    pipelines_given_kept_ += kept_hash_ != 0;
    return pipeline_cache_;
  }
  std::uint64_t pipelines_given_kept() const { return pipelines_given_kept_; }

  // Records and runs commands at once, and waits for them: set-up work only.
  template <typename Record>
  void run_now(Record&& record) {
    const std::lock_guard lock(now_mutex_);
    VkCommandBuffer commands = begin_now();
    record(commands);
    end_now(commands);
  }

  // What multiview_known_to_work() found, once it has been called.
  std::optional<bool>& multiview_checked() { return multiview_checked_; }

  // Called by frame loops: gives the frame a number of its own among all that this device draws. Objects that are given
  // up from then on are freed once it, or a later one, has finished.
  std::uint64_t begin_frame() { return ++frame_number_; }
  void frames_finished_to(std::uint64_t number);

  VkRenderPass cached_render_pass(const std::string& key, const VkRenderPassCreateInfo& info);
  // Of a pass of one subpass, which also resolves the first sample's depth into `depth_resolve`
  // (DeviceFacts::depth_resolve).
  VkRenderPass cached_render_pass(const std::string& key, const VkRenderPassCreateInfo& info,
                                  const VkAttachmentReference& depth_resolve);
  void debug_name(VkObjectType type, std::uint64_t handle, const char* name);
  void label_begin(VkCommandBuffer commands, const char* name) const;
  void label_end(VkCommandBuffer commands) const;
  void retire_memory(VkDeviceMemory memory, VkDeviceSize offset);

 private:
  friend void detail::adopt(Device&, VkObjectType, std::uint64_t, std::string_view, std::uint64_t, MadeWith);
  friend void detail::retire(Device&, VkObjectType, std::uint64_t);
  struct Retired {
    std::uint64_t frame;
    VkObjectType type;  // VK_OBJECT_TYPE_DEVICE_MEMORY: handle and offset of an allocation
    std::uint64_t handle, offset;
  };
  void create_instance(const DeviceOptions& options);
  void choose_physical(const DeviceOptions& options);
  void create_device(const DeviceOptions& options);
  void load_pipeline_cache();
  void keep_pipeline_cache() const;
  template <class Create>
  VkRenderPass cached(const std::string& key, const Create& create);
  void give_back();                     // all that there is, at the end or where the beginning failed
  void destroy(const Retired& object);  // with mutex_ held
  VkCommandBuffer begin_now();
  void end_now(VkCommandBuffer commands);
  static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                   VkDebugUtilsMessageTypeFlagsEXT,
                                                   const VkDebugUtilsMessengerCallbackDataEXT*, void*);

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t queue_family_ = 0;
  VkCommandPool now_pool_ = VK_NULL_HANDLE;
  VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
  DiskCache cache_;
  std::uint64_t kept_hash_ = 0;  // of what the cache began with; 0: with nothing
  DeviceFacts facts_;
  std::optional<bool> multiview_checked_;
  std::unique_ptr<Memory> memory_;
  std::map<std::uint64_t, ObjectRecord> records_;  // by creation number
  std::map<std::pair<VkObjectType, std::uint64_t>, std::uint64_t> creation_;
  std::atomic<std::uint64_t> created_ = 0, pipelines_made_ = 0, pipelines_given_kept_ = 0;
  std::map<std::string, VkRenderPass> render_passes_;
  std::deque<Retired> retired_;
  std::atomic<std::uint64_t> frame_number_ = 0;
  bool debug_utils_ = false;
  PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
  PFN_vkCreateRenderPass2KHR create_render_pass_2_ = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT begin_label_ = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT end_label_ = nullptr;
  mutable std::mutex mutex_;  // of the lists of objects, and of render passes
  std::mutex queue_mutex_, now_mutex_;
  mutable std::mutex message_mutex_;
  std::vector<std::string> messages_;
};

}  // namespace seascape
