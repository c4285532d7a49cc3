// What a headset on the simulated runtime says that no eye can see. Controls are named beside each test; each was seen
// to fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/gpu/headset_rig.h"

namespace seascape {
namespace {

using test::became;
using test::HeadsetRig;
using test::simulated;

class HeadsetMaskTest : public test::GpuTest {};

SimulatedOptions with_lens(double lens, std::vector<InputEvent> events = {}) {
  SimulatedOptions options = simulated(std::move(events));
  options.script.eyes = {{{-52, 41, 44, -38}, {-40, 55, 40, -46}}};
  options.lens = lens;
  return options;
}

bool covers(const std::vector<glm::vec2>& corners, const glm::dvec2& at) {
  const auto side = [&](const glm::dvec2& a, const glm::dvec2& b) {
    return (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
  };
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const double ab = side(corners[i], corners[i + 1]), bc = side(corners[i + 1], corners[i + 2]),
                 ca = side(corners[i + 2], corners[i]);
    if ((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0)) return true;
  }
  return false;
}

// In each eye what lies outside its own ellipse, up to the picture's corners, and nothing within. Controls: one eye's
// mesh for both; indices taken as they count; y turned.
void expect_lenses(const HeadsetRig& rig, double lens) {
  const HiddenMesh* mesh = rig.headset.hidden();
  ASSERT_NE(mesh, nullptr);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const Fov& fov = rig.viewpoint.eyes[eye].fov;
    const glm::dvec2 half(0.5 * (fov.right - fov.left), 0.5 * (fov.up - fov.down)),
        middle(0.5 * (fov.left + fov.right) + (eye == 0 ? 0.05 : -0.05) * half.x, 0.5 * (fov.up + fov.down));
    int hidden = 0, seen = 0, wrong = 0;
    for (int i = 0; i < 10'000; ++i) {
      const glm::dvec2 at(fov.left + (i % 100 + 0.5) / 50.0 * half.x, fov.down + (i / 100 + 0.5) / 50.0 * half.y);
      const double out = glm::length((at - middle) / half) / lens;
      if (std::abs(out - 1.0) < 0.01) continue;  // its sides are straight
      (out > 1.0 ? hidden : seen)++;
      wrong += covers(mesh->corners[eye], at) != (out > 1.0);
    }
    EXPECT_EQ(wrong, 0) << eye;
    EXPECT_GT(hidden, 1000) << eye;
    EXPECT_GT(seen, 5000) << eye;
  }
}

TEST_F(HeadsetMaskTest, TellsWhatTheLensesHide) {
  HeadsetRig rig(with_lens(0.95));
  rig.steps(2);
  expect_lenses(rig, 0.95);
}

// Controls: the event passed over; that of another session taken; the version left as it was.
TEST_F(HeadsetMaskTest, ChangesWhenTheRuntimeSaysSo) {
  HeadsetRig rig(with_lens(0.0));
  rig.steps(2);
  ASSERT_NE(rig.headset.hidden(), nullptr);  // it may come to have something to say
  EXPECT_TRUE(rig.headset.hidden()->corners[0].empty());
  std::uint64_t version = rig.headset.hidden()->version;
  const std::uint64_t made = test::device().objects_made();
  for (const double lens : {0.9, 1.0, 0.9}) {
    rig.runtime.set_lens(lens);
    rig.step();
    expect_lenses(rig, lens);
    EXPECT_GT(rig.headset.hidden()->version, version);
    version = rig.headset.hidden()->version;
  }
  rig.runtime.set_lens(0.0);
  rig.step();
  EXPECT_TRUE(rig.headset.hidden()->corners[1].empty());
  EXPECT_EQ(test::device().objects_made(), made);
  version = rig.headset.hidden()->version;
  rig.calls.instead.PollEvent = [told = false](XrInstance, XrEventDataBuffer* event) mutable -> XrResult {
    if (std::exchange(told, true)) return XR_EVENT_UNAVAILABLE;
    event->type = XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR;
    reinterpret_cast<XrEventDataVisibilityMaskChangedKHR*>(event)->session =
        reinterpret_cast<XrSession>(std::uintptr_t(0x1234));
    return XR_SUCCESS;
  };
  rig.step();
  EXPECT_EQ(rig.headset.hidden()->version, version);
}

// Control: ask() left out of begin_session(), with the first session's mesh given up.
TEST_F(HeadsetMaskTest, IsAskedOfANewSession) {
  HeadsetRig rig(with_lens(0.9, {became(4, HeadsetState::lost)}));
  rig.steps(3);
  const std::uint64_t version = rig.headset.hidden()->version;
  rig.steps(6);
  EXPECT_GT(rig.headset.hidden()->version, version);
  expect_lenses(rig, 0.9);
}

// Control: offered() true.
TEST_F(HeadsetMaskTest, ARuntimeWithoutMasksHidesNothing) {
  HeadsetRig rig(with_lens(0.9), [](test::HostileRuntime& calls) { calls.lack("xrGetVisibilityMaskKHR"); });
  rig.steps(3);
  EXPECT_EQ(rig.headset.hidden(), nullptr);
  EXPECT_EQ(rig.runtime.frames_shown(), 3u);
}

}  // namespace
}  // namespace seascape
