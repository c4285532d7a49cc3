// The plan against the device: all that is alive is in it once, and what it says of a frame is what the frame recorded.
#include "app/plan.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::SeaShot;
using test::ShotOptions;

class PlanOfADevice : public test::GpuTest {};

// What a list of objects comes to, by effect.
struct Holdings {
  std::uint64_t pipelines = 0, modules = 0, words = 0, resources = 0, bytes = 0, others = 0;
  bool operator==(const Holdings&) const = default;
};

void PrintTo(const Holdings& h, std::ostream* out) {
  *out << h.pipelines << " pipelines, " << h.modules << " modules of " << h.words << " words, " << h.resources
       << " resources of " << h.bytes << " bytes, " << h.others << " others";
}

std::map<std::string, Holdings> held_by(const Device& device) {
  std::map<std::string, Holdings> held;
  for (const ObjectRecord& object : device.objects()) {
    Holdings& h = held[object.effect];
    if (object.type == VK_OBJECT_TYPE_PIPELINE)
      ++h.pipelines;
    else if (object.type == VK_OBJECT_TYPE_SHADER_MODULE)
      ++h.modules, h.words += object.bytes / 4;
    else if (object.type == VK_OBJECT_TYPE_IMAGE || object.type == VK_OBJECT_TYPE_BUFFER)
      ++h.resources, h.bytes += object.bytes;
    else
      ++h.others;
  }
  return held;
}

// An effect that holds nothing is not in the device's list.
std::map<std::string, Holdings> held_by(const Plan& plan) {
  std::map<std::string, Holdings> held;
  for (const PlanEffect& effect : plan.effects) {
    const PlanTotals t = totals_of(effect);
    const Holdings h{t.pipelines, t.modules, t.words, t.resources, t.bytes, t.other_objects};
    if (h != Holdings{}) held[effect.name] = h;
  }
  return held;
}

const PlanEffect& named(const Plan& plan, const std::string& name) {
  const auto found =
      std::find_if(plan.effects.begin(), plan.effects.end(), [&](const PlanEffect& e) { return e.name == name; });
  if (found == plan.effects.end()) throw std::runtime_error("no " + name);
  return *found;
}

Plan plan_of(SeaShot& shot, const std::string& preset) {
  return make_plan(shot.device(), test::shaders(), shot.experience(), preset);
}

// The control is in it: with a buffer planted on the device, the plan made before is found wrong, and the plan made
// after names the planted one. Seen besides: a plan that does not count views, samplers and layouts.
TEST_F(PlanOfADevice, HasAllThatIsAlive) {
  Device& device = test::device();
  ASSERT_TRUE(device.objects().empty());
  for (const auto& [preset, place] : {std::pair("low", "cpu"), std::pair("high", "gpu"), std::pair("high", "cpu")}) {
    device.wait_idle();  // what is gone is given back
    const std::uint64_t used_before = device.memory().used_bytes();
    SeaShot shot(
        {.scene = "storm", .preset = preset, .width = 64, .height = 36, .views = 2, .set = {{"waves.where", place}}});
    const Plan plan = plan_of(shot, preset);
    EXPECT_EQ(held_by(plan), held_by(device));
    EXPECT_EQ(plan.preset, preset);

    // The memory that the device handed out, counted apart from the list: a resource takes what its driver rounds it up
    // to.
    const PlanTotals totals = totals_of(plan);
    device.wait_idle();  // uploads are done with their staging buffers
    const std::uint64_t used = device.memory().used_bytes() - used_before;
    EXPECT_GE(used, totals.bytes);
    EXPECT_LE(used, totals.bytes + totals.resources * 4096);

    {
      const EffectScope scope(device, "planted");
      const Buffer planted(device, "planted buffer", 12345, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
      EXPECT_NE(held_by(plan), held_by(device));
      const Plan after = plan_of(shot, preset);
      EXPECT_EQ(held_by(after), held_by(device));
      EXPECT_EQ(named(after, "planted").because, "built, though the scene does not name it");
      ASSERT_EQ(named(after, "planted").resources.size(), 1u);
      EXPECT_EQ(named(after, "planted").resources[0].name, "planted buffer");
      EXPECT_EQ(named(after, "planted").bytes, 12345u);
    }
  }
}

// Controls: triangles counted for the frame's first pass instead of the one that draws them; an upload that is not told
// apart from the frame's own passes.
void expect_what_a_frame_records(const std::string& place) {
  SCOPED_TRACE(place);
  SeaShot shot(
      {.scene = "open_sea", .preset = "high", .width = 64, .height = 36, .views = 2, .set = {{"waves.where", place}}});
  const Plan plan = plan_of(shot, "high");
  const FrameCounts& counts = shot.counts();  // of the plan's second frame
  const PlanTotals totals = totals_of(plan);
  EXPECT_EQ(totals.draws, counts.draws);
  EXPECT_EQ(totals.triangles, counts.triangles);
  EXPECT_EQ(totals.dispatches, counts.dispatches);
  EXPECT_EQ(totals.passes, counts.passes);
  EXPECT_EQ(totals.moved.loaded, counts.moved.loaded);
  EXPECT_EQ(totals.moved.stored, counts.moved.stored);
  EXPECT_EQ(totals.moved.copied, counts.moved.copied);

  std::set<std::string> timed, planned;
  for (const PassTime& pass : shot.experience().frame().times()) timed.insert(pass.name);
  for (const PlanEffect& effect : plan.effects)
    for (const PlanPass& pass : effect.passes)
      if (!pass.once) planned.insert(pass.name);
  EXPECT_EQ(planned, timed);

  ASSERT_EQ(named(plan, "surface").passes.size(), 1u);
  const PlanPass& surface = named(plan, "surface").passes[0];
  EXPECT_EQ(surface.draws, 1u) << "all patches and both eyes";
  EXPECT_EQ(surface.triangles,
            shot.experience().ocean().selection()->patches.size() * gpu::patch_quads * gpu::patch_quads * 2);
  const PlanEffect& waves = named(plan, "waves");
  if (place == "gpu") {
    EXPECT_EQ(waves.passes.size(), 3u);
    EXPECT_EQ(waves.pipelines.size(), 5u);
    for (const PlanPass& pass : waves.passes) EXPECT_GT(pass.dispatches, 0u) << pass.name;
  } else {
    if (shot.experience().ocean().waves().filled() == WaveImages::Filled::written) {
      EXPECT_TRUE(waves.passes.empty()) << "the processor writes the images";
    } else {
      ASSERT_EQ(waves.passes.size(), 1u);
      EXPECT_EQ(waves.passes[0].name, "wave upload");
      EXPECT_FALSE(waves.passes[0].once);
      EXPECT_EQ(waves.passes[0].copies, 6u);
    }
    EXPECT_TRUE(waves.pipelines.empty());
    for (const PlanModule& module : waves.modules) EXPECT_EQ(module.part_of, "surface") << module.name;
  }
  const std::vector<PlanPass>& sky = named(plan, "sky").passes;
  EXPECT_EQ(std::count_if(sky.begin(), sky.end(), [](const PlanPass& pass) { return pass.once; }), 3)
      << "its light is made once, while the sun stands";
}

TEST_F(PlanOfADevice, CountsWhatAFrameRecords) {
  for (const char* place : {"gpu", "cpu"}) expect_what_a_frame_records(place);
}

// Control, seen: a pass's copies left out of the plan.
TEST_F(PlanOfADevice, CountsWhatAPassMoves) {
  SeaShot shot({.scene = "storm", .preset = "low", .width = 64, .height = 36, .views = 2});
  const Plan plan = plan_of(shot, "low");
  const BytesMoved& moved = shot.counts().moved;
  ASSERT_GT(moved.copied, 0u);
  EXPECT_EQ(totals_of(plan).moved.copied, moved.copied);
  EXPECT_EQ(totals_of(named(plan, "foam")).moved.copied, moved.copied);
  EXPECT_EQ(totals_of(named(plan, "surface")).moved.stored, 4u * 64 * 36 * 2);
}

// A scene that does not call for foam has no word of it. Control: a Surface that is always built with foam gave
// both scenes as many words.
TEST_F(PlanOfADevice, FoamIsWordsOfTheSurfaceOnlyWhereAScenesNamesIt) {
  std::map<std::string, std::uint64_t> words;
  for (const char* scene : {"calm", "storm"}) {
    SeaShot shot({.scene = scene,
                  .preset = "low",
                  .width = 32,
                  .height = 32,
                  .set = {{"foam.simulated", "false"}, {"spray.amount", "0"}}});
    const Plan plan = plan_of(shot, "low");
    words[scene] = totals_of(named(plan, "surface")).words;
    std::vector<std::string> names;
    for (const PlanEffect& effect : plan.effects) names.push_back(effect.name);
    if (std::string(scene) == "calm") {
      EXPECT_THAT(names, testing::ElementsAre("waves", "underwater", "surface", "sky", "frame"));
    } else {
      EXPECT_THAT(names, testing::ElementsAre("waves", "foam", "spray", "underwater", "surface", "sky", "frame"));
      ASSERT_EQ(named(plan, "foam").modules.size(), 1u);
      EXPECT_EQ(named(plan, "foam").modules[0].words, words["storm"] - words["calm"]);
    }
  }
  EXPECT_GT(words["storm"], words["calm"]);
}

}  // namespace
}  // namespace seascape
