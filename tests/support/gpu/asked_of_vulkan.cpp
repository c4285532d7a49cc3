#include "tests/support/gpu/asked_of_vulkan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <spirv/unified1/spirv.hpp>

#include "engine/resources.h"
#include "engine/shader.h"

namespace seascape::test {

namespace {

// A module's declarations: types, constants, variables and how they are decorated.
class Module {
 public:
  explicit Module(const std::vector<std::uint32_t>& words) {
    for (std::size_t at = 5; at < words.size(); at += std::max(1u, words[at] >> 16)) {
      const std::uint32_t* w = &words[at];
      const std::uint32_t count = w[0] >> 16;
      switch (w[0] & 0xffffu) {
        case spv::OpCapability:
          capabilities.push_back(w[1]);
          break;
        case spv::OpExtension:
          extensions.emplace_back(reinterpret_cast<const char*>(w + 1));
          break;
        case spv::OpExecutionMode:
          if (w[2] == spv::ExecutionModeLocalSize) workgroup = {w[3], w[4], w[5]};
          break;
        case spv::OpConstant:
          constants_[w[2]] = w[3];
          break;
        case spv::OpVariable:
          variables.push_back({w[2], w[1], w[3]});
          break;
        case spv::OpDecorate:
          decorations_[{w[1], w[2]}] = count > 3 ? w[3] : 0;
          break;
        case spv::OpMemberDecorate:
          members_[{w[1], w[2], w[3]}] = count > 4 ? w[4] : 0;
          break;
        case spv::OpTypeInt:
        case spv::OpTypeFloat:
        case spv::OpTypeVector:
        case spv::OpTypeMatrix:
        case spv::OpTypeArray:
        case spv::OpTypeStruct:
        case spv::OpTypePointer:
          types_[w[1]] = {w, w + count};
          break;
        default:
          break;
      }
    }
  }

  struct Variable {
    std::uint32_t id, type, storage;
  };
  std::vector<std::uint32_t> capabilities;
  std::vector<std::string> extensions;
  std::array<std::uint32_t, 3> workgroup{1, 1, 1};
  std::vector<Variable> variables;

  bool decorated(std::uint32_t id, spv::Decoration what) const { return decorations_.contains({id, what}); }
  std::uint32_t decoration(std::uint32_t id, spv::Decoration what) const { return decorations_.at({id, what}); }
  // What a variable's pointer points to.
  std::uint32_t pointed(const Variable& variable) const { return types_.at(variable.type)[3]; }
  // Bytes, where three numbers take the room of four.
  std::uint64_t bytes(std::uint32_t type) const {
    const std::vector<std::uint32_t>& t = types_.at(type);
    switch (t[0] & 0xffffu) {
      case spv::OpTypeVector:
      case spv::OpTypeMatrix:
        return bytes(t[2]) * (t[3] == 3 ? 4 : t[3]);
      case spv::OpTypeArray: {
        const auto stride = decorations_.find({type, spv::DecorationArrayStride});
        return constants_.at(t[3]) * (stride == decorations_.end() ? bytes(t[2]) : stride->second);
      }
      case spv::OpTypeStruct: {
        std::uint64_t end = 0;
        for (std::uint32_t member = 0; member + 2 < t.size(); ++member) {
          const auto offset = members_.find({type, member, spv::DecorationOffset});
          end = (offset == members_.end() ? end : offset->second) + bytes(t[2 + member]);
        }
        return end;
      }
      default:
        return t[2] / 8;  // a number
    }
  }
  // How many locations of four numbers inputs or outputs take.
  std::uint64_t locations(spv::StorageClass storage) const {
    std::uint64_t count = 0;
    for (const Variable& variable : variables)
      if (variable.storage == std::uint32_t(storage) && decorated(variable.id, spv::DecorationLocation)) {
        const std::vector<std::uint32_t>& t = types_.at(pointed(variable));
        const bool several = (t[0] & 0xffffu) == spv::OpTypeArray;
        count += several ? constants_.at(t[3]) : (t[0] & 0xffffu) == spv::OpTypeMatrix ? t[3] : 1;
      }
    return count;
  }

 private:
  std::map<std::uint32_t, std::vector<std::uint32_t>> types_;
  std::map<std::uint32_t, std::uint32_t> constants_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> decorations_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> members_;
};

struct Descriptors {
  std::uint64_t samplers = 0, uniforms = 0, stores = 0, sampled = 0, images = 0;
  std::uint64_t all() const { return uniforms + stores + sampled + images; }  // as maxPerStageResources counts
  void add(VkDescriptorType type) {
    samplers += type == VK_DESCRIPTOR_TYPE_SAMPLER || type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    sampled += type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE || type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    uniforms += type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    stores += type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    images += type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  }
};

void add_compute(Asked& asked, const Module& module, const std::string& by) {
  std::uint64_t shared = 0;
  for (const Module::Variable& variable : module.variables)
    if (variable.storage == spv::StorageClassWorkgroup) shared += module.bytes(module.pointed(variable));
  asked.ask("maxComputeSharedMemorySize", shared, by);
  std::uint64_t invocations = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    asked.ask(fmt::format("maxComputeWorkGroupSize[{}]", axis), module.workgroup[axis], by);
    invocations *= module.workgroup[axis];
  }
  asked.ask("maxComputeWorkGroupInvocations", invocations, by);
}

void add_shader(Asked& asked, const Shader& shader) {
  const Module module(shader.words);
  const std::string& by = shader.name;
  for (const std::uint32_t capability : module.capabilities) asked.capabilities.emplace(capability, by);
  for (const std::string& extension : module.extensions) asked.extensions.emplace(extension, by);
  for (const Module::Variable& variable : module.variables) {
    if (module.decorated(variable.id, spv::DecorationDescriptorSet))
      asked.ask("maxBoundDescriptorSets", 1 + module.decoration(variable.id, spv::DecorationDescriptorSet), by);
    if (variable.storage == spv::StorageClassUniform)
      asked.ask("maxUniformBufferRange", module.bytes(module.pointed(variable)), by);
  }
  asked.ask("maxPushConstantsSize", shader.push_bytes, by);
  Descriptors stage;
  for (const ShaderBinding& binding : shader.bindings) stage.add(binding.type);
  asked.ask("maxPerStageDescriptorSamplers", stage.samplers, by);
  asked.ask("maxPerStageDescriptorUniformBuffers", stage.uniforms, by);
  asked.ask("maxPerStageDescriptorStorageBuffers", stage.stores, by);
  asked.ask("maxPerStageDescriptorSampledImages", stage.sampled, by);
  asked.ask("maxPerStageDescriptorStorageImages", stage.images, by);
  const std::uint64_t out = module.locations(spv::StorageClassOutput), in = module.locations(spv::StorageClassInput);
  const bool fragment = shader.stage == VK_SHADER_STAGE_FRAGMENT_BIT;
  asked.ask("maxPerStageResources", stage.all() + (fragment ? out : 0), by);
  if (shader.stage == VK_SHADER_STAGE_VERTEX_BIT) {
    asked.ask("maxVertexInputAttributes", in, by);
    asked.ask("maxVertexOutputComponents", 4 * (out + 1), by);  // and the position
  }
  if (fragment) {
    asked.ask("maxFragmentInputComponents", 4 * in, by);
    asked.ask("maxFragmentOutputAttachments", out, by);
    asked.ask("maxFragmentCombinedOutputResources", out + stage.stores + stage.images, by);
  }
  if (shader.stage == VK_SHADER_STAGE_COMPUTE_BIT) add_compute(asked, module, by);
}

void add_set(Asked& asked, const ObjectRecord& pipeline) {
  Descriptors set;
  std::set<std::uint32_t> seen;
  for (const auto& shader : pipeline.made_with.shaders)
    for (const ShaderBinding& binding : shader->bindings)
      if (seen.insert(binding.binding).second) set.add(binding.type);
  asked.ask("maxDescriptorSetSamplers", set.samplers, pipeline.name);
  asked.ask("maxDescriptorSetUniformBuffersDynamic", set.uniforms, pipeline.name);
  asked.ask("maxDescriptorSetStorageBuffers", set.stores, pipeline.name);
  asked.ask("maxDescriptorSetSampledImages", set.sampled, pipeline.name);
  asked.ask("maxDescriptorSetStorageImages", set.images, pipeline.name);
  asked.ask("maxPerSetDescriptors", seen.size(), pipeline.name);
}

void add_image(Asked& asked, const ImageSpec& spec, const std::string& by) {
  asked.ask("maxImageDimension2D", std::max(spec.width, spec.height), by);
  asked.ask("maxImageArrayLayers", spec.layers, by);
  asked.samples.emplace(std::uint32_t(spec.samples), by);
  const auto use = [&](VkImageUsageFlags usage, std::initializer_list<VkFormatFeatureFlagBits> features) {
    if (!(spec.usage & usage)) return;
    for (const VkFormatFeatureFlagBits feature : features) {
      asked.formats[spec.format].emplace(feature, by);
      if (spec.mutable_as != VK_FORMAT_UNDEFINED) asked.formats[spec.mutable_as].emplace(feature, by);
    }
  };
  const bool depth = spec.usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  use(VK_IMAGE_USAGE_SAMPLED_BIT, {VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT});
  if (!depth) use(VK_IMAGE_USAGE_SAMPLED_BIT, {VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT});
  use(VK_IMAGE_USAGE_STORAGE_BIT, {VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT});
  use(VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
      {VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT});
  use(VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, {VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT});
}

}  // namespace

void Asked::ask(std::string_view limit, std::uint64_t number, const std::string& by) {
  Number& most = numbers[std::string(limit)];
  if (number > most.most) most = {number, by};
}

void Asked::merge(const Asked& other) {
  for (const auto& [limit, number] : other.numbers) ask(limit, number.most, number.by);
  capabilities.insert(other.capabilities.begin(), other.capabilities.end());
  extensions.insert(other.extensions.begin(), other.extensions.end());
  for (const auto& [format, features] : other.formats) formats[format].insert(features.begin(), features.end());
  samples.insert(other.samples.begin(), other.samples.end());
}

Asked asked_by(const std::vector<ObjectRecord>& objects) {
  Asked asked;
  std::uint64_t samplers = 0, bytes = 0;
  for (const ObjectRecord& object : objects) {
    if (object.made_with.image) add_image(asked, *object.made_with.image, object.name);
    for (const auto& shader : object.made_with.shaders) add_shader(asked, *shader);
    if (object.type == VK_OBJECT_TYPE_PIPELINE) add_set(asked, object);
    if (object.type == VK_OBJECT_TYPE_BUFFER) asked.ask("maxStorageBufferRange", object.bytes, object.name);
    if (object.type == VK_OBJECT_TYPE_BUFFER || object.type == VK_OBJECT_TYPE_IMAGE) bytes += object.bytes;
    samplers += object.type == VK_OBJECT_TYPE_SAMPLER;
  }
  asked.ask("maxSamplerAllocationCount", samplers, "all");
  asked.ask("bytes of buffers and images", bytes, "all");
  return asked;
}

std::vector<std::string> beyond(const StandaloneProfile& profile, const Asked& asked) {
  std::vector<std::string> list;
  for (const auto& [name, number] : asked.numbers) {
    const auto row = std::find_if(profile.limits.begin(), profile.limits.end(),
                                  [&name = name](const ProfileLimit& limit) { return limit.name == name; });
    if (row == profile.limits.end())
      list.push_back(fmt::format("{}: no row", name));
    else if (number.most > row->most)
      list.push_back(fmt::format("{}: {} of {} ({}), by {}", name, number.most, row->most, row->from, number.by));
  }
  for (const auto& [capability, by] : asked.capabilities)
    if (std::none_of(profile.capabilities.begin(), profile.capabilities.end(),
                     [what = capability](const ProfileCapability& row) { return row.capability == what; }))
      list.push_back(fmt::format("SPIR-V capability {}, by {}", capability, by));
  for (const auto& [extension, by] : asked.extensions)
    list.push_back(fmt::format("SPIR-V extension {}, by {}", extension, by));
  for (const auto& [format, features] : asked.formats) {
    const auto row = std::find_if(profile.formats.begin(), profile.formats.end(),
                                  [what = format](const ProfileFormat& f) { return f.format == what; });
    for (const auto& [feature, by] : features)
      if (row == profile.formats.end() || !(row->features & feature))
        list.push_back(fmt::format("format {} with feature {:#x}, by {}", int(format), int(feature), by));
  }
  for (const auto& [samples, by] : asked.samples)
    if (!(profile.samples & samples)) list.push_back(fmt::format("{} samples, by {}", samples, by));
  return list;
}

}  // namespace seascape::test
