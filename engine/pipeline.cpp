#include "engine/pipeline.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/error.h"
#include "engine/render_target.h"

namespace seascape {

namespace {

Owned<VkShaderModule> make_module(Device& device, const Shader& shader) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = shader.words.size() * 4;
  info.pCode = shader.words.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule");
  return Owned<VkShaderModule>(device, module, shader.name, info.codeSize);
}

// Each tile, window and map of a scene's effects is an image, and devices need not have more than 16 a stage.
void expect_images_fit(const Device& device, const Shader& shader) {
  const auto images = std::count_if(shader.bindings.begin(), shader.bindings.end(), [](const ShaderBinding& b) {
    return b.type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE || b.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  });
  if (images > std::ptrdiff_t(device.facts().sampled_images))
    throw Error(device.facts().name,
                fmt::format("{} reads {} images for the scene's effects, and the device allows {} in a stage",
                            shader.name, images, device.facts().sampled_images),
                "leave out some of the scene's effects, or use another device");
}

void set_stencil(VkPipelineDepthStencilStateCreateInfo& info, Stencil use) {
  if (use == Stencil::none) return;
  info.stencilTestEnable = VK_TRUE;
  info.front = stencil_state(use, true);
  info.back = stencil_state(use, false);
}

}  // namespace

VkStencilOpState stencil_state(Stencil use, bool front) {
  const auto state = [](VkStencilOp op, VkCompareOp compare, std::uint32_t reference) {
    const std::uint32_t writes = op == VK_STENCIL_OP_KEEP ? 0 : 0xff;
    return VkStencilOpState{VK_STENCIL_OP_KEEP, op, op, compare, 0xff, writes, reference};
  };
  switch (use) {
    case Stencil::none:
      break;
    case Stencil::begin_in_water:
      return state(VK_STENCIL_OP_REPLACE, VK_COMPARE_OP_ALWAYS, stencil_in_air - 1);
    case Stencil::count:  // what lies behind counts too
      return state(front ? VK_STENCIL_OP_INCREMENT_AND_WRAP : VK_STENCIL_OP_DECREMENT_AND_WRAP, VK_COMPARE_OP_ALWAYS,
                   0);
    case Stencil::in_air:
      return state(VK_STENCIL_OP_KEEP, VK_COMPARE_OP_LESS_OR_EQUAL, stencil_in_air);
    case Stencil::in_water:
      return state(VK_STENCIL_OP_KEEP, VK_COMPARE_OP_GREATER, stencil_in_air);
  }
  return {};
}

void Pipeline::make_layout(Device& device, std::string_view name) {
  std::vector<VkDescriptorSetLayoutBinding> list;
  for (const auto& shader : shaders_) {
    expect_images_fit(device, *shader);
    hash_ = hash_ * 1099511628211ull ^ shader->hash;
    if (shader->push_bytes) {
      push_bytes_ = std::max(push_bytes_, shader->push_bytes);
      push_stages_ |= VkShaderStageFlags(shader->stage);
    }
    for (const ShaderBinding& b : shader->bindings) {
      auto found = std::find_if(list.begin(), list.end(), [&](const auto& l) { return l.binding == b.binding; });
      if (found == list.end()) {
        list.push_back({b.binding, b.type, 1, VkShaderStageFlags(shader->stage), nullptr});
        bindings_.push_back(b);
      } else {
        found->stageFlags |= VkShaderStageFlags(shader->stage);
      }
    }
  }
  if (push_bytes_ > 128) throw Error(std::string(name), "needs more than 128 bytes of push constants", "use a buffer");
  std::sort(bindings_.begin(), bindings_.end(), [](const auto& a, const auto& b) { return a.binding < b.binding; });
  for (const ShaderBinding& b : bindings_) dynamic_uniforms_ += b.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.bindingCount = std::uint32_t(list.size());
  set.pBindings = list.data();
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device.handle(), &set, nullptr, &set_layout), "vkCreateDescriptorSetLayout");
  set_layout_ = Owned<VkDescriptorSetLayout>(device, set_layout, name);
  const VkPushConstantRange range{push_stages_, 0, push_bytes_};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout;
  info.pushConstantRangeCount = push_bytes_ ? 1 : 0;
  info.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout), "vkCreatePipelineLayout");
  layout_ = Owned<VkPipelineLayout>(device, layout, name);
}

Pipeline make_compute_pipeline(Device& device, ShaderLibrary& shaders, const std::string& name,
                               const std::vector<SpecValue>& values) {
  Pipeline p;
  p.bind_point_ = VK_PIPELINE_BIND_POINT_COMPUTE;
  p.shaders_.push_back(shaders.load(name, values));
  p.modules_.push_back(make_module(device, *p.shaders_[0]));
  p.make_layout(device, name);
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = p.modules_[0].get();
  info.stage.pName = "main";
  info.layout = p.layout_.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines");
  p.pipeline_ = Owned<VkPipeline>(device, pipeline, name, 0, {nullptr, p.shaders_});
  return p;
}

class GraphicsBuilder {
 public:
  static Pipeline make(Device& device, ShaderLibrary& shaders, const RenderTarget& target, const GraphicsSpec& spec) {
    Pipeline p;
    for (const std::string& name : {spec.vertex, spec.fragment}) {
      p.shaders_.push_back(shaders.load(name, spec.values));
      p.modules_.push_back(make_module(device, *p.shaders_.back()));
    }
    p.make_layout(device, spec.vertex);
    VkPipelineShaderStageCreateInfo stages[2];
    for (int i = 0; i < 2; ++i) {
      stages[i] = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
      stages[i].stage = p.shaders_[std::size_t(i)]->stage;
      stages[i].module = p.modules_[std::size_t(i)].get();
      stages[i].pName = "main";
    }
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = std::uint32_t(spec.buffers.size());
    input.pVertexBindingDescriptions = spec.buffers.data();
    input.vertexAttributeDescriptionCount = std::uint32_t(spec.attributes.size());
    input.pVertexAttributeDescriptions = spec.attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = spec.topology;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.polygonMode = spec.wireframe ? VK_POLYGON_MODE_LINE : VK_POLYGON_MODE_FILL;
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = target.samples();
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = spec.depth_test && target.has_depth();
    depth.depthWriteEnable = spec.depth_write && target.has_depth();
    depth.depthCompareOp = spec.depth_compare;
    set_stencil(depth, spec.stencil);
    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = spec.colour ? 0xf : 0x0;
    attachment.blendEnable = spec.blend;
    attachment.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    attachment.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    attachment.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    attachment.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    const VkPipelineColorBlendAttachmentState attachments[] = {attachment, attachment};
    blend.attachmentCount = target.second() ? 2 : target.has_colour() ? 1 : 0;
    blend.pAttachments = attachments;
    const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamic_states;
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = p.layout_.get();
    info.renderPass = target.render_pass();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
    p.pipeline_ = Owned<VkPipeline>(device, pipeline, spec.vertex + "+" + spec.fragment, 0, {nullptr, p.shaders_});
    if (spec.facing) {
      raster.cullMode = VK_CULL_MODE_BACK_BIT;
      check(vkCreateGraphicsPipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr, &pipeline),
            "vkCreateGraphicsPipelines");
      p.facing_ =
          Owned<VkPipeline>(device, pipeline, spec.vertex + "+" + spec.fragment + ", facing", 0, {nullptr, p.shaders_});
    }
    return p;
  }
};

Pipeline make_graphics_pipeline(Device& device, ShaderLibrary& shaders, const RenderTarget& target,
                                const GraphicsSpec& spec) {
  return GraphicsBuilder::make(device, shaders, target, spec);
}

Bindings::Bindings(Device& device, const Pipeline& pipeline, const std::vector<Bound>& entries, std::string_view name) {
  if (pipeline.bindings().empty()) return;
  std::vector<VkDescriptorPoolSize> sizes;
  for (const ShaderBinding& b : pipeline.bindings()) sizes.push_back({b.type, 1});
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.maxSets = 1;
  pool.poolSizeCount = std::uint32_t(sizes.size());
  pool.pPoolSizes = sizes.data();
  VkDescriptorPool handle = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device.handle(), &pool, nullptr, &handle), "vkCreateDescriptorPool");
  pool_ = Owned<VkDescriptorPool>(device, handle, name);
  const VkDescriptorSetLayout layout = pipeline.set_layout();
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = handle;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  check(vkAllocateDescriptorSets(device.handle(), &info, &set_), "vkAllocateDescriptorSets");
  std::vector<VkDescriptorBufferInfo> buffers(pipeline.bindings().size());
  std::vector<VkDescriptorImageInfo> images(pipeline.bindings().size());
  std::vector<VkWriteDescriptorSet> writes;
  for (std::size_t i = 0; i < pipeline.bindings().size(); ++i) {
    const ShaderBinding& b = pipeline.bindings()[i];
    auto entry = std::find_if(entries.begin(), entries.end(), [&](const Bound& e) { return e.binding == b.binding; });
    if (entry == entries.end())
      throw Error(std::string(name), fmt::format("binding {} ({}) of a shader has nothing bound", b.binding, b.name),
                  "this is a fault of seascape");
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set_;
    write.dstBinding = b.binding;
    write.descriptorCount = 1;
    write.descriptorType = b.type;
    if (entry->buffer) {
      buffers[i] = {entry->buffer->get(), 0, entry->range};
      write.pBufferInfo = &buffers[i];
    } else {
      images[i] = {entry->sampler, entry->view,
                   b.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE ? VK_IMAGE_LAYOUT_GENERAL : entry->layout};
      write.pImageInfo = &images[i];
    }
    writes.push_back(write);
  }
  vkUpdateDescriptorSets(device.handle(), std::uint32_t(writes.size()), writes.data(), 0, nullptr);
}

}  // namespace seascape
