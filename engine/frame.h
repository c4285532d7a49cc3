// One frame's commands as a list of passes: each runs at once, in program order; barriers, GPU timers and debug labels
// come from its declaration.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <vector>

#include "engine/barrier.h"
#include "engine/pipeline.h"
#include "engine/render_target.h"
#include "engine/stages.h"

namespace seascape {

struct Use {
  const Image* image = nullptr;
  const Buffer* buffer = nullptr;
  Access access{};
  bool discard = false;
};
inline Use use(const Image& image, Access access, bool discard = false) { return {&image, nullptr, access, discard}; }
inline Use use(const Buffer& buffer, Access access) { return {nullptr, &buffer, access, false}; }
// All that a pass uses, without allocation: up to most_barriers. More throw std::length_error.
class Uses {
 public:
  Uses(std::initializer_list<Use> uses) {
    for (const Use& u : uses) add(u);
  }
  void add(const Use& use) {
    if (count_ == list_.size()) throw std::length_error("a pass uses more images and buffers than most_barriers");
    list_[count_++] = use;
  }
  const Use* begin() const { return list_.data(); }
  const Use* end() const { return list_.data() + count_; }

 private:
  std::array<Use, most_barriers> list_;
  std::size_t count_ = 0;
};

// Bytes that commands move through the device's memory. What shaders read and write, what the host writes, and the
// timers' results are not among them.
struct BytesMoved {
  std::uint64_t loaded = 0, stored = 0;  // for attachments, before and after a pass
  std::uint64_t copied = 0;              // from one image or buffer to another: counted once
  BytesMoved& operator+=(const BytesMoved& other) {
    loaded += other.loaded;
    stored += other.stored;
    copied += other.copied;
    return *this;
  }
  bool operator==(const BytesMoved&) const = default;
};

// What a frame recorded. The hash covers every command with its arguments, uploads excepted.
struct FrameCounts {
  std::uint64_t commands = 0, draws = 0, triangles = 0, dispatches = 0, barriers = 0, passes = 0;
  BytesMoved moved;
  std::uint64_t hash = 1469598103934665603ull;
};

// What one pass recorded with one pipeline.
struct PipelineWork {
  const char* pass;
  std::uint32_t pass_number = 0;         // in program order: passes may share a name
  VkPipeline pipeline = VK_NULL_HANDLE;  // null: the pass has bound none yet
  VkImage copied_to = VK_NULL_HANDLE;    // the image that a pass without pipelines copied into last
  std::uint64_t draws = 0, triangles = 0, dispatches = 0, copies = 0;
  BytesMoved moved = {};  // for attachments: in the first row of the pass
};

struct PassTime {
  const char* name;
  double ms;
};

// A list of vertices that the host writes for one frame.
struct VertexList {
  const Buffer* buffer;
  VkDeviceSize offset;
  void* host;  // where to write it; uninitialized
};

// The one place where commands are recorded.
class Commands {
 public:
  // `facing`: the variant that draws only what faces the eye, where the pipeline has it.
  void bind(const Pipeline& pipeline, const Bindings& bindings,
            std::initializer_list<std::uint32_t> uniform_offsets = {}, bool facing = false);
  template <typename T>
  void push(const T& constants) {
    static_assert(sizeof(T) <= 128);
    push_bytes(&constants, sizeof(T));
  }
  void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z);
  void bind_vertices(const VertexList& list, std::uint32_t binding = 0);
  void bind_indices(const Buffer& buffer, VkIndexType type);
  void draw(std::uint32_t vertices, std::uint32_t instances = 1);
  // As the GPU has written it into a buffer (Access::vertex_list), a VkDrawIndirectCommand. How many triangles that are
  // is not counted.
  void draw_indirect(const Buffer& command);
  // `nothing`: so many of the triangles are not there (shaders/shared/patch_instance.h), and are not counted.
  void draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint64_t nothing = 0);
  // Copies texels of a buffer (Access::transfer_read) into an image (Access::transfer_write).
  void copy(const Buffer& from, const Image& to, std::span<const VkBufferImageCopy> regions);
  // Copies all of a buffer (Access::transfer_read) into another of its size (Access::transfer_write), or a part of it.
  void copy(const Buffer& from, const Buffer& to);
  void copy(const Buffer& from, const Buffer& to, const VkBufferCopy& part);
  // Copies the upper left part of all layers of an image (Access::transfer_read) into another of its format
  // (Access::transfer_write).
  void copy(const Image& from, const Image& to, VkExtent2D part);
  // The eye that a pass per eye draws; 0 in a multiview pass, where shaders have gl_ViewIndex.
  std::uint32_t eye() const { return eye_; }
  VkCommandBuffer raw() const { return commands_; }  // for libraries that record by themselves

 private:
  friend class Frame;
  void note(std::uint64_t what);
  void count_draw(std::uint64_t triangles);
  void count_moved(const BytesMoved& bytes);
  void push_bytes(const void* data, std::uint32_t bytes);
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  const Pipeline* pipeline_ = nullptr;
  FrameCounts* counts_ = nullptr;
  std::vector<PipelineWork>* work_ = nullptr;
  std::uint32_t eye_ = 0;
};

class Frame {
 public:
  static constexpr int slots = 2;  // frames in flight
  static constexpr std::uint32_t max_passes = 64;

  // Room for a frame's vertex lists when it begins to be used; it grows with what frames ask for.
  static constexpr VkDeviceSize first_vertex_bytes = 4u << 20;

  explicit Frame(Device& device, VkDeviceSize vertex_bytes = first_vertex_bytes);
  ~Frame();

  // Waits until the slot's last frame has left the GPU (the stage "waiting"), reads its timers, and begins to record.
  void begin();
  template <typename Record>
  void pass(const char* name, const Uses& uses, Record&& record) {
    begin_pass(name, uses);
    record(commands_);
    end_pass();
  }
  // Draws into the target: once for all views, or once an eye where the target says so.
  template <typename Record>
  void draw_pass(const char* name, const RenderTarget& target, const Uses& uses, Record&& record) {
    begin_target(name, target, uses);
    for (std::size_t p = 0; p < target.passes(); ++p) {
      begin_eye(target, p);
      record(commands_);
      end_eye(target, p);
    }
    end_pass();
  }
  // The offset of a copy of `data` in ring(), until this frame has left the GPU.
  template <typename T>
  std::uint32_t upload_uniform(const T& data) {
    return upload_bytes(&data, sizeof(T));
  }
  // Room for `bytes` of vertices, aligned to 16, until this frame has left the GPU.
  VertexList vertices(VkDeviceSize bytes);
  const Buffer& ring() const { return ring_; }
  // Which of the frames in flight this is, 0 to slots - 1: what the host writes for the GPU needs a piece for each.
  int slot() const { return int(number_ % slots); }

  void submit(VkSemaphore wait = VK_NULL_HANDLE, VkSemaphore signal = VK_NULL_HANDLE);
  // Whether all that was submitted has left the GPU: the next begin() waits for nothing.
  bool ready() const;
  void finish();  // waits for all frames, reads their timers

  // What the processor's time goes to, from one begin() to the next.
  Stages& stages() { return stages_; }
  const Stages& stages() const { return stages_; }

  const FrameCounts& counts() const { return counts_; }  // of the frame recorded last
  // The same by pass and pipeline, in program order.
  const std::vector<PipelineWork>& work() const { return work_; }
  // GPU times of the newest frame that has finished, by pass in program order; empty without timestamps.
  const std::vector<PassTime>& times() const { return times_; }
  double gpu_ms() const { return gpu_ms_; }
  std::uint64_t timed_frame() const { return timed_frame_; }
  std::uint64_t number() const { return number_; }

 private:
  struct Slot {
    Owned<VkCommandPool> pool;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    Owned<VkFence> fence;
    Owned<VkQueryPool> queries;
    Buffer stamps;  // the queries' results, copied there by the frame itself
    Buffer vertices;
    std::array<const char*, max_passes> names{};
    std::uint32_t passes = 0;
    std::uint64_t frame = 0, number = 0;  // among all that the device draws; of this frame loop
    bool pending = false;
  };
  void begin_pass(const char* name, const Uses& uses);
  void begin_target(const char* name, const RenderTarget& target, const Uses& uses);
  void begin_eye(const RenderTarget& target, std::size_t pass);
  void end_eye(const RenderTarget& target, std::size_t pass);
  void end_pass();
  void open(const char* name, BarrierBatch& barriers);
  void collect(Slot& slot);
  std::uint32_t upload_bytes(const void* data, std::uint32_t bytes);

  Device& device_;
  std::array<Slot, slots> slots_;
  Buffer ring_;
  std::uint32_t ring_used_ = 0;
  VkDeviceSize vertices_used_ = 0;
  Commands commands_;
  FrameCounts counts_;
  Stages stages_;
  std::vector<PipelineWork> work_;
  std::vector<PassTime> times_;
  double gpu_ms_ = 0.0;
  std::uint64_t number_ = 0, timed_frame_ = 0;
};

}  // namespace seascape
