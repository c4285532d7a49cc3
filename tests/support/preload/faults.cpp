// Loaded before the program's libraries (LD_PRELOAD), makes its machine fail where the environment says: a device
// without memory, a device that is lost, a process killed while it writes. The program itself knows nothing of it.
//
// - SEASCAPE_FAIL_FROM=n: the n-th object or allocation asked of the device, and all after it, get
//   VK_ERROR_OUT_OF_DEVICE_MEMORY
// - SEASCAPE_FAIL_ONCE=n: the n-th alone
// - SEASCAPE_LOSE_AT=n: the n-th submission, and whatever waits after it, get VK_ERROR_DEVICE_LOST
// - SEASCAPE_STOP_AT=n, SEASCAPE_CRASH_AT=n: SIGTERM or SIGSEGV at the n-th submission
// - SEASCAPE_KILL_AT_WRITE=n: SIGKILL in the middle of the n-th write into a file of a temporary name
// - SEASCAPE_STOP_AT_WRITE=n: SIGTERM before it
// - SEASCAPE_KILL_AT_RENAME=n: SIGKILL just before the n-th such file gets its own name
// - SEASCAPE_NO_THREADS=1: no thread can be made
// - SEASCAPE_COUNTS=FILE: written at the end: how many objects, submissions, writes and renames there were
#include <dlfcn.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>

namespace {

long number(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : 0;
}

const long fail_from = number("SEASCAPE_FAIL_FROM"), fail_once = number("SEASCAPE_FAIL_ONCE"),
           lose_at = number("SEASCAPE_LOSE_AT"), kill_at_write = number("SEASCAPE_KILL_AT_WRITE"),
           kill_at_rename = number("SEASCAPE_KILL_AT_RENAME"), stop_at = number("SEASCAPE_STOP_AT"),
           stop_at_write = number("SEASCAPE_STOP_AT_WRITE"), crash_at = number("SEASCAPE_CRASH_AT");
std::atomic<long> objects{0}, submissions{0}, writes{0}, renames{0};
std::atomic<bool> lost{false};

bool no_memory() {
  const long n = ++objects;
  return (fail_from > 0 && n >= fail_from) || n == fail_once;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool temporary(const char* name) { return name != nullptr && std::strstr(name, ".tmp-") != nullptr; }

std::mutex mutex;
std::set<std::FILE*>& opened() {
  static std::set<std::FILE*> files;
  return files;
}

std::FILE* open(const char* function, const char* name, const char* mode) {
  std::FILE* file = next<std::FILE* (*)(const char*, const char*)>(function)(name, mode);
  if (file != nullptr && temporary(name)) {
    const std::lock_guard lock(mutex);
    opened().insert(file);
  }
  return file;
}

struct AtEnd {
  ~AtEnd() {
    const char* name = std::getenv("SEASCAPE_COUNTS");
    if (name == nullptr) return;
    std::FILE* file = next<std::FILE* (*)(const char*, const char*)>("fopen")(name, "w");
    if (file == nullptr) return;
    std::fprintf(file, "%ld %ld %ld %ld\n", objects.load(), submissions.load(), writes.load(), renames.load());
    std::fclose(file);
  }
} at_end;

}  // namespace

#define FROM_DEVICE(name, parameters, arguments)                               \
  extern "C" __attribute__((visibility("default"))) VkResult name parameters { \
    if (no_memory()) return VK_ERROR_OUT_OF_DEVICE_MEMORY;                     \
    static const auto real = next<PFN_##name>(#name);                          \
    return real arguments;                                                     \
  }
#define CREATED(name, Info, Handle)                                                                              \
  FROM_DEVICE(name, (VkDevice device, const Info* info, const VkAllocationCallbacks* callbacks, Handle* handle), \
              (device, info, callbacks, handle))

CREATED(vkAllocateMemory, VkMemoryAllocateInfo, VkDeviceMemory)
CREATED(vkCreateBuffer, VkBufferCreateInfo, VkBuffer)
CREATED(vkCreateImage, VkImageCreateInfo, VkImage)
CREATED(vkCreateImageView, VkImageViewCreateInfo, VkImageView)
CREATED(vkCreateSampler, VkSamplerCreateInfo, VkSampler)
CREATED(vkCreateShaderModule, VkShaderModuleCreateInfo, VkShaderModule)
CREATED(vkCreateDescriptorSetLayout, VkDescriptorSetLayoutCreateInfo, VkDescriptorSetLayout)
CREATED(vkCreatePipelineLayout, VkPipelineLayoutCreateInfo, VkPipelineLayout)
CREATED(vkCreateDescriptorPool, VkDescriptorPoolCreateInfo, VkDescriptorPool)
CREATED(vkCreateCommandPool, VkCommandPoolCreateInfo, VkCommandPool)
CREATED(vkCreateFence, VkFenceCreateInfo, VkFence)
CREATED(vkCreateQueryPool, VkQueryPoolCreateInfo, VkQueryPool)
CREATED(vkCreateRenderPass, VkRenderPassCreateInfo, VkRenderPass)
CREATED(vkCreateFramebuffer, VkFramebufferCreateInfo, VkFramebuffer)
FROM_DEVICE(vkAllocateDescriptorSets, (VkDevice device, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets),
            (device, info, sets))
FROM_DEVICE(vkAllocateCommandBuffers,
            (VkDevice device, const VkCommandBufferAllocateInfo* info, VkCommandBuffer* buffers),
            (device, info, buffers))
FROM_DEVICE(vkMapMemory,
            (VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size, VkMemoryMapFlags flags,
             void** data),
            (device, memory, offset, size, flags, data))
FROM_DEVICE(vkCreateComputePipelines,
            (VkDevice device, VkPipelineCache cache, uint32_t count, const VkComputePipelineCreateInfo* infos,
             const VkAllocationCallbacks* callbacks, VkPipeline* pipelines),
            (device, cache, count, infos, callbacks, pipelines))
FROM_DEVICE(vkCreateGraphicsPipelines,
            (VkDevice device, VkPipelineCache cache, uint32_t count, const VkGraphicsPipelineCreateInfo* infos,
             const VkAllocationCallbacks* callbacks, VkPipeline* pipelines),
            (device, cache, count, infos, callbacks, pipelines))

extern "C" {

__attribute__((visibility("default"))) int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                                                          void* (*run)(void*), void* with) {
  static const bool none = number("SEASCAPE_NO_THREADS") != 0;
  if (none) return EAGAIN;
  static const auto real = next<decltype(&pthread_create)>("pthread_create");
  return real(thread, attributes, run, with);
}

__attribute__((visibility("default"))) VkResult vkQueueSubmit(VkQueue queue, uint32_t count,
                                                              const VkSubmitInfo* submits, VkFence fence) {
  const long n = ++submissions;
  if (n == lose_at) lost = true;
  if (n == stop_at) raise(SIGTERM);
  if (n == crash_at) raise(SIGSEGV);
  if (lost) return VK_ERROR_DEVICE_LOST;
  static const auto real = next<PFN_vkQueueSubmit>("vkQueueSubmit");
  return real(queue, count, submits, fence);
}

__attribute__((visibility("default"))) VkResult vkWaitForFences(VkDevice device, uint32_t count, const VkFence* fences,
                                                                VkBool32 all, uint64_t timeout) {
  if (lost) return VK_ERROR_DEVICE_LOST;
  static const auto real = next<PFN_vkWaitForFences>("vkWaitForFences");
  return real(device, count, fences, all, timeout);
}

// What was submitted before is over with the device.
__attribute__((visibility("default"))) VkResult vkQueueWaitIdle(VkQueue queue) {
  static const auto real = next<PFN_vkQueueWaitIdle>("vkQueueWaitIdle");
  const VkResult result = real(queue);
  return lost ? VK_ERROR_DEVICE_LOST : result;
}

__attribute__((visibility("default"))) VkResult vkDeviceWaitIdle(VkDevice device) {
  static const auto real = next<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle");
  const VkResult result = real(device);
  return lost ? VK_ERROR_DEVICE_LOST : result;
}

__attribute__((visibility("default"))) std::FILE* fopen(const char* name, const char* mode) {
  return open("fopen", name, mode);
}
__attribute__((visibility("default"))) std::FILE* fopen64(const char* name, const char* mode) {
  return open("fopen64", name, mode);
}

__attribute__((visibility("default"))) int fclose(std::FILE* file) {
  {
    const std::lock_guard lock(mutex);
    opened().erase(file);
  }
  static const auto real = next<int (*)(std::FILE*)>("fclose");
  return real(file);
}

__attribute__((visibility("default"))) size_t fwrite(const void* from, size_t size, size_t count, std::FILE* file) {
  static const auto real = next<size_t (*)(const void*, size_t, size_t, std::FILE*)>("fwrite");
  bool ours = false;
  {
    const std::lock_guard lock(mutex);
    ours = opened().count(file) != 0;
  }
  const long n = ours ? ++writes : 0;
  if (ours && n == kill_at_write) {
    real(from, 1, size * count / 2, file);
    std::fflush(file);
    raise(SIGKILL);
  }
  if (ours && n == stop_at_write) raise(SIGTERM);
  return real(from, size, count, file);
}

__attribute__((visibility("default"))) int rename(const char* from, const char* to) {
  if (temporary(from) && ++renames == kill_at_rename) raise(SIGKILL);
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  return real(from, to);
}

}  // extern "C"
