#include "engine/shader.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <spirv_cross/spirv_cross_c.h>

#include <spirv-tools/libspirv.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <spirv-tools/optimizer.hpp>
#include <unordered_map>

#include "engine/error.h"
#include "engine/files.h"

namespace seascape {

namespace {

using SpecBits = std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>;

VkShaderStageFlagBits stage_of(const std::string& name) {
  if (name.ends_with(".vert")) return VK_SHADER_STAGE_VERTEX_BIT;
  if (name.ends_with(".frag")) return VK_SHADER_STAGE_FRAGMENT_BIT;
  return VK_SHADER_STAGE_COMPUTE_BIT;
}

// Reads the bindings that are used and the size of the push constants.
void reflect(Shader& shader) {
  spvc_context context = nullptr;
  spvc_parsed_ir ir = nullptr;
  spvc_compiler compiler = nullptr;
  spvc_resources resources = nullptr;
  spvc_context_create(&context);
  struct Release {
    spvc_context context;
    ~Release() { spvc_context_destroy(context); }
  } release{context};
  if (spvc_context_parse_spirv(context, shader.words.data(), shader.words.size(), &ir) != SPVC_SUCCESS ||
      spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler) !=
          SPVC_SUCCESS)
    throw Error(shader.name, "cannot be read as SPIR-V", "build again: cmake --build --preset release");
  spvc_set active = nullptr;
  spvc_compiler_get_active_interface_variables(compiler, &active);
  spvc_compiler_create_shader_resources_for_active_variables(compiler, &resources, active);
  const std::pair<spvc_resource_type, VkDescriptorType> kinds[] = {
      {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC},
      {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
      {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
      {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
      {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
      {SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, VK_DESCRIPTOR_TYPE_SAMPLER},
  };
  for (const auto& [kind, type] : kinds) {
    const spvc_reflected_resource* list = nullptr;
    std::size_t count = 0;
    spvc_resources_get_resource_list_for_type(resources, kind, &list, &count);
    for (std::size_t i = 0; i < count; ++i)
      shader.bindings.push_back(
          {spvc_compiler_get_decoration(compiler, list[i].id, SpvDecorationBinding), type, list[i].name});
  }
  std::sort(shader.bindings.begin(), shader.bindings.end(),
            [](const ShaderBinding& a, const ShaderBinding& b) { return a.binding < b.binding; });
  const spvc_reflected_resource* push = nullptr;
  std::size_t pushes = 0;
  spvc_resources_get_resource_list_for_type(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT, &push, &pushes);
  if (pushes) {
    std::size_t bytes = 0;
    spvc_compiler_get_declared_struct_size(compiler, spvc_compiler_get_type_handle(compiler, push[0].base_type_id),
                                           &bytes);
    shader.push_bytes = std::uint32_t(bytes);
  }
}

// The size of a workgroup given by specialisation constants (local_size_x_id) is a built-in constant, which the passes
// below take for dead; its values go where a literal size stands instead.
void settle_workgroup(std::vector<std::uint32_t>& words,
                      const std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>& bits) {
  constexpr std::uint32_t execution_mode = 16, constant = 43, spec_constant = 50, spec_composite = 51,
                          decorate = 71;  // SPIR-V 1.3, section 3.32
  constexpr std::uint32_t local_size = 17, decoration_spec_id = 1, decoration_built_in = 11, workgroup_size = 25;
  std::unordered_map<std::uint32_t, std::uint32_t> spec_ids, values;  // of a result's id
  std::uint32_t size_id = 0, size_at = 0, mode_at = 0;
  for (std::size_t at = 5; at < words.size(); at += std::max(1u, words[at] >> 16)) {
    const std::uint32_t* w = &words[at];
    const std::uint32_t what = w[0] & 0xffffu;
    if (what == execution_mode && w[2] == local_size)
      mode_at = std::uint32_t(at);
    else if (what == decorate && w[2] == decoration_spec_id)
      spec_ids[w[1]] = w[3];
    else if (what == decorate && w[2] == decoration_built_in && w[3] == workgroup_size)
      size_id = w[1];
    else if (what == constant || what == spec_constant)
      values[w[2]] = w[3];
    else if (what == spec_composite && w[2] == size_id)
      size_at = std::uint32_t(at);
  }
  if (size_at == 0 || mode_at == 0) return;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t id = words[size_at + 3 + axis];
    const auto spec = spec_ids.find(id);
    const auto given = spec == spec_ids.end() ? bits.end() : bits.find(spec->second);
    words[mode_at + 3 + axis] = given == bits.end() ? values.at(id) : given->second.front();
  }
}

// The interface variables that are left come out in the order of a hash set; in that of their declaration the same code
// has the same words.
void sort_interface(std::vector<std::uint32_t>& words) {
  constexpr std::uint32_t entry_point = 15;  // [model, function, name, interface ids]
  for (std::size_t at = 5; at < words.size(); at += std::max(1u, words[at] >> 16)) {
    if ((words[at] & 0xffffu) != entry_point) continue;
    std::size_t first = at + 3;
    while ((words[first] >> 24) != 0) ++first;  // the name ends with the word whose last byte is 0
    std::sort(words.begin() + std::ptrdiff_t(first) + 1, words.begin() + std::ptrdiff_t(at + (words[at] >> 16)));
  }
}

void register_passes(spvtools::Optimizer& optimizer, const SpecBits& bits) {
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(bits))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateUnifyConstantPass())
      // What a flag leaves out is most of a shader. It goes before calls are inlined: all of it takes three times as
      // long.
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateInlineExhaustivePass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
      .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
      .RegisterPass(spvtools::CreateCCPPass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      // What dead branches might have changed is now seen to be what it was before them: their variables go too.
      .RegisterPass(spvtools::CreateBlockMergePass())
      .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
      .RegisterPass(spvtools::CreateSSARewritePass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass(false))
      .RegisterPass(spvtools::CreateRemoveUnusedInterfaceVariablesPass())
      .RegisterPass(spvtools::CreateDeadVariableEliminationPass())
      .RegisterPass(spvtools::CreateEliminateDeadConstantPass())
      .RegisterPass(spvtools::CreateBlockMergePass());
}

// Of all that what specialise() gives follows from, besides its arguments. `form`: raised where it changes otherwise
// than by its passes.
std::uint64_t hash_of_specialise() {
  constexpr std::uint32_t form = 1;
  static const std::uint64_t hash = [] {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    register_passes(optimizer, {});
    std::string says = spvSoftwareVersionDetailsString();
    for (const char* pass : optimizer.GetPassNames()) says += std::string(" ") + pass;
    return hash_bytes({reinterpret_cast<const std::uint8_t*>(says.data()), says.size()}, hash_start ^ form);
  }();
  return hash;
}

}  // namespace

std::vector<std::uint32_t> specialise(const std::vector<std::uint32_t>& words, std::span<const SpecValue> values,
                                      const std::string& name) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
  std::string fault;
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
    if (level <= SPV_MSG_ERROR) fault = message;
  });
  SpecBits bits;
  for (const SpecValue& v : values) bits[v.id] = {v.value};
  std::vector<std::uint32_t> sized = words;
  settle_workgroup(sized, bits);
  register_passes(optimizer, bits);
  std::vector<std::uint32_t> result;
  spvtools::OptimizerOptions options;
  // A file that is read while it is written may end anywhere, which the passes do not bear.
  options.set_run_validator(true);
  if (!optimizer.Run(sized.data(), sized.size(), &result, options))
    throw Error(name, fmt::format("cannot be specialised ({})", fault), "build again: cmake --build --preset release");
  sort_interface(result);
  spvtools::Optimizer compact(SPV_ENV_VULKAN_1_1);
  compact.RegisterPass(spvtools::CreateCompactIdsPass());
  const std::vector<std::uint32_t> sorted = result;
  options.set_run_validator(false);  // the tests validate what comes out
  if (!compact.Run(sorted.data(), sorted.size(), &result, options))
    throw Error(name, "cannot be specialised", "build again: cmake --build --preset release");
  return result;
}

ShaderLibrary::ShaderLibrary(std::filesystem::path directory, DiskCache cache)
    : directory_(std::move(directory)), cache_(std::move(cache)) {}

std::filesystem::path ShaderLibrary::default_directory() { return executable_directory() / "shaders"; }

std::shared_ptr<const Shader> ShaderLibrary::load(const std::string& name, std::span<const SpecValue> values) {
  std::string key = name;
  for (const SpecValue& v : values) key += fmt::format(" {}={}", v.id, v.value);
  const std::lock_guard lock(*mutex_);
  if (auto found = loaded_.find(key); found != loaded_.end()) return found->second;
  return loaded_[key] = read(name, values);
}

std::shared_ptr<const Shader> ShaderLibrary::read(const std::string& name, std::span<const SpecValue> values) {
  const std::filesystem::path file = directory_ / (name + ".spv");
  std::error_code ignored;
  times_[name] = std::filesystem::last_write_time(file, ignored);
  auto shader = std::make_shared<Shader>();
  shader->name = name;
  shader->stage = stage_of(name);
  shader->words = specialised_words(file, values, name);
  shader->values.assign(values.begin(), values.end());
  shader->hash = hash_words(shader->words);
  reflect(*shader);
  return shader;
}

std::vector<std::uint32_t> ShaderLibrary::specialised_words(const std::filesystem::path& file,
                                                            std::span<const SpecValue> values,
                                                            const std::string& name) {
  const std::vector<std::uint32_t> whole = read_spirv(file);
  std::uint64_t hash = hash_words(whole, hash_of_specialise());
  for (const SpecValue& v : values) hash = hash_words(std::array{v.id, v.value}, hash);
  const std::string kept_name = fmt::format("{}-{:016x}.spv", name, hash);
  if (const auto kept = cache_.read(kept_name); kept && kept->size() % 4 == 0) {
    std::vector<std::uint32_t> words(kept->size() / 4);
    std::memcpy(words.data(), kept->data(), kept->size());
    return words;
  }
  ++specialised_;
  const std::vector<std::uint32_t> words = specialise(whole, values, name);
  cache_.write(kept_name, {reinterpret_cast<const std::uint8_t*>(words.data()), 4 * words.size()});
  return words;
}

bool ShaderLibrary::reload() {
  const std::lock_guard lock(*mutex_);
  bool changed = false;
  for (auto& [name, time] : times_) {
    std::error_code failed;
    const auto now = std::filesystem::last_write_time(directory_ / (name + ".spv"), failed);
    changed |= !failed && now != time;
    if (!failed) time = now;
  }
  if (!changed) return false;
  auto anew = loaded_;
  for (auto& [key, shader] : anew) shader = read(shader->name, shader->values);
  loaded_ = std::move(anew);
  return true;
}

}  // namespace seascape
