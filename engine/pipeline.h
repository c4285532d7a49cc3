// Pipelines and their bindings: layouts come from the SPIR-V that is loaded; one descriptor set, written once.
#pragma once
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "engine/resources.h"
#include "engine/shader.h"

namespace seascape {

class RenderTarget;

// A pipeline with its layout. Uniform buffers are bound with dynamic offsets, in order of binding.
class Pipeline {
 public:
  Pipeline() = default;
  VkPipeline get() const { return pipeline_.get(); }
  // The variant that draws only triangles that face the eye (GraphicsSpec::facing), or else the pipeline itself.
  VkPipeline facing() const { return facing_ ? facing_.get() : pipeline_.get(); }
  VkPipelineLayout layout() const { return layout_.get(); }
  VkDescriptorSetLayout set_layout() const { return set_layout_.get(); }
  const std::vector<ShaderBinding>& bindings() const { return bindings_; }
  std::uint32_t push_bytes() const { return push_bytes_; }
  VkShaderStageFlags push_stages() const { return push_stages_; }
  VkPipelineBindPoint bind_point() const { return bind_point_; }
  std::uint32_t dynamic_uniforms() const { return dynamic_uniforms_; }
  std::uint64_t hash() const { return hash_; }
  const std::vector<std::shared_ptr<const Shader>>& shaders() const { return shaders_; }
  explicit operator bool() const { return bool(pipeline_); }

 private:
  friend Pipeline make_compute_pipeline(Device&, ShaderLibrary&, const std::string&, const std::vector<SpecValue>&);
  friend class GraphicsBuilder;
  void make_layout(Device& device, std::string_view name);
  std::vector<std::shared_ptr<const Shader>> shaders_;
  std::vector<Owned<VkShaderModule>> modules_;
  std::vector<ShaderBinding> bindings_;
  std::uint32_t push_bytes_ = 0, dynamic_uniforms_ = 0;
  VkShaderStageFlags push_stages_ = 0;
  VkPipelineBindPoint bind_point_ = VK_PIPELINE_BIND_POINT_GRAPHICS;
  std::uint64_t hash_ = 0;
  Owned<VkDescriptorSetLayout> set_layout_;
  Owned<VkPipelineLayout> layout_;
  Owned<VkPipeline> pipeline_, facing_;
};

Pipeline make_compute_pipeline(Device& device, ShaderLibrary& shaders, const std::string& name,
                               const std::vector<SpecValue>& values = {});

// What draws do with the stencil, which counts how often the line of sight through a sample passes the water's surface:
// from air into water one more, out of it one less, whatever lies before. It begins at what a line that ends in the air
// or in the water would have to count for an eye in air, so that in the end it is stencil_in_air or more where the eye
// is in air there, and less where it is in water.
enum class Stencil {
  none,
  begin_in_water,  // the line ends in the water: one less than the picture was cleared to
  count,           // triangles that face the eye lead into water, others out of it
  in_air,          // only samples whose line begins in air
  in_water
};

// For triangles that face the eye, or for the others. A draw that only tests it writes none of its bits: then it may be
// tested before pixels are shaded, even where a shader discards.
VkStencilOpState stencil_state(Stencil use, bool front);

struct GraphicsSpec {
  std::string vertex, fragment;   // shader names, "surface.vert"
  std::vector<SpecValue> values;  // for both stages; a stage ignores what it does not have
  std::vector<VkVertexInputBindingDescription> buffers;
  std::vector<VkVertexInputAttributeDescription> attributes;
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  bool facing = false;  // a variant besides, of the same shaders, that draws only what faces the eye
  bool depth_test = true, depth_write = true;
  VkCompareOp depth_compare = VK_COMPARE_OP_GREATER;  // reversed depth
  bool wireframe = false;
  bool blend = false;  // alpha over
  bool colour = true;  // false: nothing but depth and stencil is written
  Stencil stencil = Stencil::none;
};
Pipeline make_graphics_pipeline(Device& device, ShaderLibrary& shaders, const RenderTarget& target,
                                const GraphicsSpec& spec);

// What a binding is bound to.
struct Bound {
  std::uint32_t binding;
  const Buffer* buffer = nullptr;
  VkDeviceSize range = VK_WHOLE_SIZE;  // of a dynamic uniform: bytes seen at the offset
  VkImageView view = VK_NULL_HANDLE;
  VkSampler sampler = VK_NULL_HANDLE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;  // of a sampled image
};

// A descriptor set with everything a pipeline's shaders use. Entries that the stripped shaders do not have are passed
// over; a binding without an entry is a programmer's mistake (Error).
class Bindings {
 public:
  Bindings() = default;
  Bindings(Device& device, const Pipeline& pipeline, const std::vector<Bound>& entries, std::string_view name);
  VkDescriptorSet get() const { return set_; }

 private:
  Owned<VkDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace seascape
