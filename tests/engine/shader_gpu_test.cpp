// What is left of a shader once it is specialised: nothing of a feature that is off, and valid SPIR-V always.
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <map>
#include <set>
#include <spirv-tools/libspirv.hpp>

#include "engine/files.h"
#include "engine/shader.h"
#include "shaders/shared/frame_data.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

// A few facts about a module, read straight from its words (SPIR-V 1.3 specification, 2.3 and 3.32). No part of the
// code under test.
struct Module {
  explicit Module(const std::vector<std::uint32_t>& w) {
    for (std::size_t at = 5; at < w.size(); at += w[at] >> 16) {
      const std::uint32_t op = w[at] & 0xffffu, *a = &w[at] + 1;
      const std::size_t count = (w[at] >> 16) - 1;
      ++instructions;
      if (op == 43 && count == 3) constants[a[1]] = a[2];                        // OpConstant
      if (op >= 48 && op <= 52) ++specialisable;                                 // OpSpecConstant...
      if (op == 71 && count >= 3 && a[1] == 1) specialisation_ids.insert(a[2]);  // OpDecorate SpecId
      if (op == 71 && count >= 3 && a[1] == 33) bindings.insert(a[2]);           // OpDecorate Binding
      if (op == 72 && count >= 4 && a[2] == 35) members[{a[0], a[3]}] = a[1];    // OpMemberDecorate Offset
      if (op == 48 || op == 49) flags.insert(a[1]);                              // OpSpecConstantTrue, False
      if (op == 71 && count >= 3 && a[1] == 1) ids[a[0]] = a[2];
      if (op == 65) chains.emplace_back(a + 3, a + count);  // OpAccessChain: indices
    }
  }
  // Whether anything of the frame's data at this offset is read: the block holds FrameData as its one member.
  bool reads_frame_data(std::size_t offset) const {
    std::set<std::uint32_t> numbers;
    for (const auto& [member, number] : members)
      if (member.second == offset && is_frame_data(member.first)) numbers.insert(number);
    return std::any_of(chains.begin(), chains.end(), [&](const auto& indices) {
      return indices.size() >= 2 && value(indices[0]) == 0 && numbers.contains(value(indices[1]));
    });
  }
  bool is_frame_data(std::uint32_t type) const {  // the one struct with members at all these offsets
    return members.contains({type, std::uint32_t(offsetof(gpu::FrameData, shown))}) &&
           members.contains({type, std::uint32_t(offsetof(gpu::FrameData, water_backscatter))}) &&
           members.contains({type, std::uint32_t(offsetof(gpu::FrameData, whitecap))});
  }
  std::uint32_t value(std::uint32_t id) const {
    const auto found = constants.find(id);
    return found == constants.end() ? ~0u : found->second;
  }
  int instructions = 0, specialisable = 0;
  std::map<std::uint32_t, std::uint32_t> constants, ids;  // ids: of specialisation constants
  std::set<std::uint32_t> bindings, specialisation_ids, flags;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> members;  // (type, offset) to number
  std::vector<std::vector<std::uint32_t>> chains;
};

std::vector<SpecValue> surface_values(bool probe, bool tile, bool foam, bool debug) {
  return {{gpu::value_multiview, true},  {gpu::value_probe, probe},
          {gpu::value_tile_shape, tile}, {gpu::value_foam, foam},
          {gpu::value_debug, debug},     {gpu::value_anisotropy, std::bit_cast<std::uint32_t>(4.0f)}};
}

std::vector<std::uint32_t> words(const std::string& name, std::vector<SpecValue> values) {
  const auto raw = read_spirv(ShaderLibrary::default_directory() / (name + ".spv"));
  const Module module(raw);
  std::erase_if(values, [&](const SpecValue& v) { return !module.specialisation_ids.contains(v.id); });
  return specialise(raw, values, name);
}

// The control: with foam left on, whitecap is read and the first expectation below fails.
TEST(Specialisation, LeavesNothingOfFoamWhereThereIsNone) {
  const Module with(words("surface.frag", surface_values(false, true, true, false)));
  const Module without(words("surface.frag", surface_values(false, true, false, false)));
  EXPECT_FALSE(without.reads_frame_data(offsetof(gpu::FrameData, whitecap)));
  EXPECT_TRUE(with.reads_frame_data(offsetof(gpu::FrameData, whitecap))) << "or this test could not fail";
  EXPECT_TRUE(without.reads_frame_data(offsetof(gpu::FrameData, water_backscatter)));
  EXPECT_LE(without.instructions + 20, with.instructions);
  EXPECT_EQ(without.specialisable, 0);
}

TEST(Specialisation, LeavesNothingOfDebugViewsWhereThereAreNone) {
  const Module with(words("surface.frag", surface_values(false, true, false, true)));
  const Module without(words("surface.frag", surface_values(false, true, false, false)));
  EXPECT_FALSE(without.reads_frame_data(offsetof(gpu::FrameData, shown)));
  EXPECT_TRUE(with.reads_frame_data(offsetof(gpu::FrameData, shown)));
}

TEST(Specialisation, TheProbeIsABindingOnlyWhereItIsAskedFor) {
  EXPECT_THAT(Module(words("surface.vert", surface_values(true, true, false, false))).bindings,
              ::testing::Contains(8u));
  EXPECT_THAT(Module(words("surface.vert", surface_values(false, true, false, false))).bindings,
              ::testing::Not(::testing::Contains(8u)));
}

// The library's reflection agrees with the words: a binding that is stripped is not asked for by a descriptor layout.
TEST(Specialisation, TheLibraryListsTheBindingsThatAreLeft) {
  ShaderLibrary library;
  for (const bool probe : {false, true}) {
    const auto values = surface_values(probe, true, false, false);
    const auto shader = library.load("surface.vert", values);
    std::set<std::uint32_t> listed;
    for (const ShaderBinding& b : shader->bindings) listed.insert(b.binding);
    EXPECT_EQ(listed, Module(shader->words).bindings) << "probe " << probe;
    EXPECT_EQ(library.load("surface.vert", values), shader) << "an equal request is answered from memory";
  }
}

// With every effect there is. A stage may have 16 samplers on many devices (the least of maxPerStageDescriptorSamplers,
// Vulkan 1.1, table 54). The control: an image of the sea bound with a sampler of its own again is seen.
TEST(Specialisation, AllEffectsTogetherShareFewSamplers) {
  std::vector<SpecValue> values = surface_values(false, true, true, true);
  for (const auto& [constant, value] : {std::pair{gpu::value_cascades, 5u},
                                        {gpu::value_particles, 3u},
                                        {gpu::value_deferred, 1u},
                                        {gpu::value_gerstner, 1u},
                                        {gpu::value_baked, 1u},
                                        {gpu::value_dynamic_levels, 8u},
                                        {gpu::value_level, 1u},
                                        {gpu::value_bed, 1u},
                                        {gpu::value_flow, 1u},
                                        {gpu::value_clip, 1u},
                                        {gpu::value_albedo, 3u},
                                        {gpu::value_shadow, 3u},
                                        {gpu::value_foam_kept, 1u},
                                        {gpu::value_clip_kinds, 15u},
                                        {gpu::value_shore_waves, 1u}})
    values.push_back({std::uint32_t(constant), value});
  ShaderLibrary library;
  std::size_t images = 0;
  for (const char* name :
       {"surface.vert", "surface.frag", "surface_clip.frag", "surface_points.frag", "surface_light.frag"}) {
    std::size_t samplers = 0;
    for (const ShaderBinding& b : library.load(name, values)->bindings) {
      const bool combined = b.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
      samplers += combined || b.type == VK_DESCRIPTOR_TYPE_SAMPLER;
      images += b.type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
      EXPECT_FALSE(combined &&
                   (b.name.starts_with("sea_") || b.name.ends_with("_windows") || b.name.ends_with("_hulls")))
          << name << ": " << b.name << " has a sampler of its own";
    }
    EXPECT_LE(samplers, 6u) << name;  // two of the sea, and of the sky's map and of stored points
  }
  EXPECT_GE(images, 40u) << "or no effect is in these modules";
}

// Every shader that ships, at every combination of its flags. The control: a module with a broken word is refused.
TEST(Specialisation, EveryCombinationOfFlagsIsValid) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  std::string fault;
  tools.SetMessageConsumer(
      [&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { fault = text; });
  int modules = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ShaderLibrary::default_directory())) {
    if (entry.path().extension() != ".spv") continue;
    const std::string name = entry.path().stem().string();
    const auto raw = read_spirv(entry.path());
    const Module module(raw);
    std::vector<std::uint32_t> flags;
    for (const std::uint32_t id : module.flags)
      if (module.ids.contains(id)) flags.push_back(module.ids.at(id));
    ASSERT_LE(flags.size(), 20u) << name << ": too many combinations for this test";
    const unsigned all = (1u << flags.size()) - 1u;
    for (unsigned chosen = 0; chosen <= all; ++chosen) {
      // Of many none, all, a sixth of the single ones and a twenty-fourth of the pairs (each with SEASCAPE_LONG=1).
      if (flags.size() > 4u && std::popcount(chosen) > 2 && chosen != all) continue;
      if (flags.size() > 4u && std::popcount(chosen) == 1 &&
          !test::sampled(std::size_t(std::countr_zero(chosen)) + std::size_t(modules), 6))
        continue;
      if (flags.size() > 4u && std::popcount(chosen) == 2 &&
          !test::sampled(std::size_t(std::countr_zero(chosen) + std::bit_width(chosen)), 24))
        continue;
      std::vector<SpecValue> values;
      for (std::size_t i = 0; i < flags.size(); ++i) values.push_back({flags[i], chosen >> i & 1u});
      const auto result = specialise(raw, values, name);
      EXPECT_TRUE(tools.Validate(result)) << name << " at flags " << chosen << ": " << fault;
      ++modules;
    }
  }
  EXPECT_GE(modules, 40) << "the folder of shaders is not what this test takes it for";
  auto broken = words("surface.vert", surface_values(false, true, false, false));
  broken.resize(broken.size() - 4);  // the end of its last function is missing
  EXPECT_FALSE(tools.Validate(broken));
}

}  // namespace

}  // namespace seascape
