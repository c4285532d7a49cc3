// Only what the scene calls for, proved for every effect of the table below (truths.md, section 5): absent is as if it
// had never been built. What an effect adds is its row in
// effects_under_proof.h; what it adds to tests/CMakeLists.txt, a line of
// the shaders that never had it.
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <map>
#include <memory>
#include <set>

#include "app/frame.h"
#include "app/plan.h"
#include "app/program.h"
#include "ocean/effects.h"
#include "tests/app/effects_under_proof.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/gpu_transform.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/gpu/spirv_text.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

using test::effects_under_proof;
using test::EffectUnderProof;
using test::pose;
using test::SeaShot;

Pose head_of(const EffectUnderProof& effect) { return pose({0.0, effect.head_m, 0.0}, 20.0, -12.0); }
Pose moved_of(const EffectUnderProof& effect) { return pose({1.0, effect.head_m, 0.5}, 20.0, -12.0); }

enum class Leak { none, buffer, dispatch, branch, code };

// What is compared between a scene that never had the effect and one that no longer names it.
struct Evidence {
  std::size_t tagged = 0;  // objects of the effect
  std::uint64_t tagged_bytes = 0;
  std::uint64_t memory = 0;  // bytes in use on the device
  std::size_t objects = 0;   // of all effects
  FrameCounts counts;
  std::set<std::string> passes;
  std::vector<std::vector<std::uint32_t>> modules;  // words of the surface's shaders, and of those that draw beside it
  std::set<std::uint32_t> bindings;
  std::uint64_t pipelines = 0, pipelines_after_loading = 0;
  Image8 picture;
};

struct Proofs {
  bool allocation, commands, spirv, pipelines, picture;
};

class EffectProof : public test::GpuTest {
 protected:
  static test::ShotOptions options(const EffectUnderProof& effect, const std::vector<std::string>& effects) {
    test::ShotOptions result{.scene = "open_sea",
                             .preset = "medium",
                             .width = 80,
                             .height = 48,
                             .views = 2,
                             .set = {{"waves.where", "gpu"},
                                     {"waves.resolution", "32"},
                                     {"waves.cascades", "3"},
                                     {"lod.patch_quads", "16"},
                                     {"msaa", "1"}},
                             .effects = effects,
                             .inputs = effect.inputs,
                             .objects = effect.things,
                             .shapes = effect.shapes,
                             .actor = effect.actor};
    for (const auto& pair : effect.set) result.set.push_back(pair);
    return result;
  }
  // A pass by its name, or what an effect draws in the pass of another by the effect's.
  static std::string part_of(const PipelineWork& work) {
    for (const ObjectRecord& object : test::device().objects())
      if (work.pipeline && object.type == VK_OBJECT_TYPE_PIPELINE && object.handle == std::uint64_t(work.pipeline) &&
          (object.effect == "spray" || object.effect == "models" || object.effect == "underwater"))
        return object.effect;
    return work.pass;
  }
  // `effects` are the scene's after a beginning with `first`.
  static Evidence collect(const EffectUnderProof& effect, const std::vector<std::string>& first,
                          const std::vector<std::string>& effects, Leak leak = Leak::none) {
    Device& device = test::device();
    device.wait_idle();
    Evidence e;
    SeaShot shot(options(effect, first));
    shot.draw(head_of(effect), 1.0);
    shot.experience().apply_effects(effects);
    Buffer planted;
    if (leak == Leak::buffer) {
      const EffectScope scope(device, effect.name);
      planted = Buffer(device, "planted", 256, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    }
    shot.draw(head_of(effect), 1.0);
    shot.draw(head_of(effect), 1.1);
    device.wait_idle();
    for (const ObjectRecord& object : device.objects()) {
      ++e.objects;
      if (object.effect == effect.name) ++e.tagged, e.tagged_bytes += object.bytes;
      if (object.type == VK_OBJECT_TYPE_PIPELINE) ++e.pipelines;
    }
    e.memory = device.memory().used_bytes();
    const std::uint64_t made = device.pipelines_made();
    Frame& frame = shot.experience().frame();
    {
      const Viewpoint viewpoint = shot.viewpoint(moved_of(effect));
      std::unique_ptr<test::GpuTransform> planted_work;
      if (leak == Leak::dispatch)
        planted_work = std::make_unique<test::GpuTransform>(device, test::shaders(), 64, 64, 8, 8,
                                                            std::vector<std::complex<float>>(64 * 64));
      frame.begin();
      draw_frame(shot.experience(), frame, viewpoint, 1.2);
      if (planted_work) planted_work->record(frame);
      frame.submit();
      frame.finish();
    }
    e.counts = frame.counts();
    for (const PipelineWork& work : frame.work()) e.passes.insert(part_of(work));
    if (leak == Leak::none) e.pipelines_after_loading = device.pipelines_made() - made;
    const Surface& surface = shot.experience().surface();
    std::vector<std::shared_ptr<const Shader>> shaders = surface.pipeline().shaders();
    if (&surface.lighting() != &surface.pipeline())
      shaders.insert(shaders.end(), surface.lighting().shaders().begin(), surface.lighting().shaders().end());
    if (const DrawnSpray* spray = shot.experience().spray())
      shaders.insert(shaders.end(), spray->pipeline().shaders().begin(), spray->pipeline().shaders().end());
    for (const auto& shader : shaders) {
      e.modules.push_back(shader->words);
      for (const ShaderBinding& binding : shader->bindings) e.bindings.insert(binding.binding);
      if (leak != Leak::branch && leak != Leak::code) continue;
      ShaderLibrary other(
          std::filesystem::path(SEASCAPE_BUILD_DIR) / ((leak == Leak::branch ? "leaking_" : "without_") + effect.part),
          test::kept_shaders());
      e.modules.back() = other.load(shader->name, shader->values)->words;
    }
    e.picture = picture_of(device, shot.experience(), 0);
    return e;
  }
  static Proofs compare(const EffectUnderProof& effect, const Evidence& never, const Evidence& absent) {
    const auto own = [&](const Evidence& e) {
      return std::any_of(effect.bindings.begin(), effect.bindings.end(),
                         [&](std::uint32_t b) { return e.bindings.contains(b); });
    };
    Proofs p{};
    p.allocation = absent.tagged == 0 && absent.tagged_bytes == 0 && absent.objects == never.objects &&
                   absent.memory == never.memory;
    p.commands = absent.counts.hash == never.counts.hash && absent.counts.commands == never.counts.commands &&
                 absent.counts.dispatches == never.counts.dispatches && absent.counts.draws == never.counts.draws &&
                 absent.counts.barriers == never.counts.barriers && absent.passes == never.passes;
    p.spirv = absent.modules == never.modules && !own(absent);
    p.pipelines = absent.pipelines == never.pipelines && absent.pipelines_after_loading == 0;
    p.picture = test::differing_pixels(absent.picture, never.picture) == 0;
    return p;
  }
};

// An effect that was there and was switched off is as if it had never been: allocations, commands, SPIR-V, pipelines,
// picture. That the effect itself fails the same comparisons shows that they see something. (A third of the effects,
// all with SEASCAPE_LONG=1.)
TEST_F(EffectProof, AbsentIsAsIfItHadNeverBeen) {
  std::size_t number = 0;
  for (const EffectUnderProof& effect : effects_under_proof) {
    if (!test::sampled(number++, 3)) continue;
    SCOPED_TRACE(effect.part);
    const Evidence never = collect(effect, effect.without, effect.without);
    const Proofs absent = compare(effect, never, collect(effect, effect.with, effect.without));
    EXPECT_TRUE(absent.allocation && absent.commands && absent.spirv && absent.pipelines && absent.picture)
        << absent.allocation << absent.commands << absent.spirv << absent.pipelines << absent.picture;
    const Evidence present = collect(effect, effect.without, effect.with);
    const Proofs there = compare(effect, never, present);
    EXPECT_EQ(there.allocation, !effect.objects);
    EXPECT_FALSE(there.commands);  // a pipeline's hash is that of its code
    EXPECT_EQ(there.spirv, effect.apart);
    EXPECT_FALSE(there.picture);
    EXPECT_EQ(present.tagged > 0, effect.objects);
    EXPECT_EQ(present.passes.contains(effect.pass), effect.objects);
    for (const std::uint32_t binding : effect.bindings) EXPECT_TRUE(present.bindings.contains(binding)) << binding;
  }
}

std::vector<std::string> texts(const Evidence& e) {
  std::vector<std::string> result;
  for (const auto& words : e.modules) result.push_back(test::spirv_text(words));
  return result;
}

// The first line that two texts do not share.
std::string first_difference(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const auto [x, y] = std::mismatch(a[i].begin(), a[i].end(), b[i].begin(), b[i].end());
    if (x == a[i].end() && y == b[i].end()) continue;
    const auto line = [](const std::string& text, std::string::const_iterator at) {
      const auto from = std::size_t(at - text.begin()), begin = text.rfind('\n', from == 0 ? 0 : from - 1) + 1;
      return text.substr(begin, text.find('\n', from) - begin);
    };
    return "shader " + std::to_string(i) + ": " + line(a[i], x) + "\nagainst " + line(b[i], y);
  }
  return "";
}

// What is loaded without an effect is what shaders are that never had a line of it, to the last instruction (compilers
// number what they name as they come by it, and drop what nobody calls). (Half of the effects, all with
// SEASCAPE_LONG=1.)
TEST_F(EffectProof, TheLoadedCodeIsThatOfShadersThatNeverHadIt) {
  std::size_t number = 0;
  for (const EffectUnderProof& effect : effects_under_proof) {
    if (!effect.variants || !test::sampled(number++, 2)) continue;
    SCOPED_TRACE(effect.part);
    const Evidence never = collect(effect, effect.without, effect.without, Leak::code),
                   absent = collect(effect, effect.without, effect.without);
    ASSERT_GE(never.modules.size(), 2u);  // the first places the surface, the last lights it
    EXPECT_FALSE(texts(never).front().empty());
    EXPECT_TRUE(texts(never) == texts(absent)) << first_difference(texts(never), texts(absent));
    // The control: called for, those shaders still have none of it, and the shipped ones do. (A sixth of them, all with
    // SEASCAPE_LONG=1.)
    if (!test::sampled(number - 1, 6)) continue;
    const Evidence asked = collect(effect, effect.with, effect.with, Leak::code),
                   present = collect(effect, effect.with, effect.with);
    EXPECT_TRUE(texts(asked) == texts(never));
    EXPECT_TRUE(texts(present) != texts(never));
  }
}

// The negative controls that truths.md asks for: one buffer, one dispatch, one branch, each seen by its proof and by no
// other. (A quarter of the effects, all with SEASCAPE_LONG=1.)
TEST_F(EffectProof, OneLeakedBufferDispatchOrBranchIsSeen) {
  std::size_t number = 0;
  for (const EffectUnderProof& effect : effects_under_proof) {
    if (!test::sampled(number++, 4)) continue;
    SCOPED_TRACE(effect.part);
    const Evidence never = collect(effect, effect.without, effect.without);
    const Proofs buffer = compare(effect, never, collect(effect, effect.with, effect.without, Leak::buffer));
    EXPECT_FALSE(buffer.allocation);
    EXPECT_TRUE(buffer.commands && buffer.spirv && buffer.picture);
    const Proofs dispatch = compare(effect, never, collect(effect, effect.with, effect.without, Leak::dispatch));
    EXPECT_FALSE(dispatch.commands);
    EXPECT_TRUE(dispatch.allocation && dispatch.spirv && dispatch.picture);
    if (!effect.variants) continue;
    const Proofs branch = compare(effect, never, collect(effect, effect.with, effect.without, Leak::branch));
    EXPECT_FALSE(branch.spirv);
    EXPECT_TRUE(branch.allocation && branch.commands && branch.picture);
  }
}

// On and off again and again: the device's objects and memory are what they were, to the byte, and pictures too. (A
// toggle builds the scene anew: 12 of them, and 1,000 with SEASCAPE_LONG=1.)
class EffectToggled : public EffectProof, public testing::WithParamInterface<EffectUnderProof> {};
INSTANTIATE_TEST_SUITE_P(Effects, EffectToggled, testing::ValuesIn(effects_under_proof),
                         [](const auto& effect) { return effect.param.part; });

TEST_P(EffectToggled, LeavesNothingBehind) {
  const EffectUnderProof& effect = GetParam();
  SeaShot shot(options(effect, effect.without));
  const auto held = [&] {
    test::device().wait_idle();
    return std::pair(test::device().objects().size(), test::device().memory().used_bytes());
  };
  // What acts on a sea takes steps until it is seen.
  const auto seen = [&] {
    if (effect.actor) shot.draw(head_of(effect), 1.0);
    return shot.picture(head_of(effect), 2.0);
  };
  shot.draw(head_of(effect), 0.0);
  const auto before = held();
  const Image8 without = seen();
  shot.experience().apply_effects(effect.with);
  const Image8 with = seen();
  const auto then = held();
  EXPECT_EQ(then != before, effect.objects);
  EXPECT_GT(test::differing_pixels(with, without), 0);
  const int times = test::long_run() ? 500 : 6;
  for (int i = 0; i < times; ++i) {
    shot.experience().apply_effects(effect.without);
    if (i % 13 == 0) {
      EXPECT_EQ(test::differing_pixels(seen(), without), 0);
      EXPECT_EQ(held(), before);
    }
    shot.experience().apply_effects(effect.with);
    if (i % 11 == 0) {
      EXPECT_EQ(test::differing_pixels(seen(), with), 0);
    }
  }
  EXPECT_EQ(held(), then);
  shot.experience().apply_effects(effect.without);
  EXPECT_EQ(held(), before);
}

// Declared but not needed: while the clock stands an effect's pass is not recorded from the second frame on, and back
// in the first frame that it runs in; where a setting makes nothing of it, nothing is built.
TEST_F(EffectProof, IdleCostsNothing) {
  for (const EffectUnderProof& effect : effects_under_proof) {
    if (!effect.objects) continue;
    SCOPED_TRACE(effect.part);
    SeaShot shot(options(effect, effect.with));
    const auto passes = [&] {
      std::size_t count = 0;
      for (const PipelineWork& work : shot.experience().frame().work()) count += part_of(work) == effect.pass;
      return count > 0 ? 1u : 0u;  // it may take several pipelines
    };
    if (effect.actor) shot.draw(head_of(effect), 4.9);
    shot.draw(head_of(effect), 5.0);
    EXPECT_EQ(passes(), 1u);
    shot.draw(head_of(effect), 5.0);
    EXPECT_EQ(passes(), effect.shown ? 1u : 0u) << "the sea stands still";
    shot.draw(moved_of(effect), 5.1);
    EXPECT_EQ(passes(), 1u);
    if (effect.idle.first.empty()) continue;
    shot.set(effect.idle.first, effect.idle.second);
    shot.draw(head_of(effect), 6.0);
    EXPECT_EQ(passes(), 0u);
    for (const ObjectRecord& object : test::device().objects()) EXPECT_NE(object.effect, effect.name) << object.name;
    shot.set(effect.idle.first, "0.3");
    shot.draw(head_of(effect), 6.1);
    EXPECT_EQ(passes(), 1u);
  }
}

// None of the effects, each alone, every pair, and all of them are drawn without a word of the validation layer, and
// the plan names each and why. (A sixth of those alone and an eightieth of the pairs; all with SEASCAPE_LONG=1.)
TEST_F(EffectProof, EverySetOfEffectsIsDrawnAndPlanned) {
  const std::size_t count = std::size(effects_under_proof), all = (std::size_t{1} << count) - 1;
  for (std::size_t set = 0; set <= all; ++set) {
    if (std::popcount(set) > 2 && set != all) continue;
    if (std::popcount(set) == 1 && !test::sampled(std::size_t(std::countr_zero(set)), 6)) continue;
    if (std::popcount(set) == 2 && !test::sampled(std::size_t(std::countr_zero(set) + std::bit_width(set)), 80))
      continue;
    std::vector<std::string> effects;
    std::vector<InputSpec> inputs;
    SceneObjects things;
    SceneShapes shapes;
    std::vector<std::pair<std::string, std::string>> settings{
        {"waves.where", "gpu"}, {"waves.resolution", "32"}, {"lod.patch_quads", "16"}};
    for (std::size_t i = 0; i < count; ++i)
      if (set >> i & 1) {
        effects.push_back(effects_under_proof[i].name);
        settings.insert(settings.end(), effects_under_proof[i].set.begin(), effects_under_proof[i].set.end());
        inputs.insert(inputs.end(), effects_under_proof[i].inputs.begin(), effects_under_proof[i].inputs.end());
        if (!effects_under_proof[i].things.empty()) things = effects_under_proof[i].things;
        if (!effects_under_proof[i].shapes.empty()) shapes = effects_under_proof[i].shapes;
      }
    SeaShot shot({.scene = "open_sea",
                  .preset = "medium",
                  .width = 48,
                  .height = 32,
                  .set = settings,
                  .effects = effects,
                  .inputs = inputs,
                  .objects = things,
                  .shapes = shapes});
    const Plan plan = make_plan(test::device(), test::shaders(), shot.experience(), "medium");
    for (std::size_t i = 0; i < count; ++i) {
      const auto found = std::find_if(plan.effects.begin(), plan.effects.end(),
                                      [&](const PlanEffect& e) { return e.name == effects_under_proof[i].name; });
      ASSERT_EQ(found != plan.effects.end(), calls_for(effects, effects_under_proof[i].name))
          << effects_under_proof[i].name;
      if (found == plan.effects.end()) continue;
      EXPECT_EQ(found->because == "the scene names it",
                std::find(effects.begin(), effects.end(), effects_under_proof[i].name) != effects.end())
          << found->because;
      EXPECT_TRUE(effects_under_proof[i].apart || !found->modules.empty()) << "its code in the surface's shaders";
      // Nobody acts on a plan's sea: what comes of that alone rests, and has no pass. Whether its eyes are near the
      // water depends on its waves.
      if (!effects_under_proof[i].apart) {
        EXPECT_EQ(!found->passes.empty(), effects_under_proof[i].objects && !effects_under_proof[i].actor);
      }
      EXPECT_EQ(found->bytes > 0, effects_under_proof[i].objects);
    }
  }
}

}  // namespace
}  // namespace seascape
