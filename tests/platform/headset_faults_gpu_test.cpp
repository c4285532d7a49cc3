// Runtimes of OpenXR whose calls fail: one of them once, all from then on, or a session's. What comes of it is a
// picture or an Error with a clear line, never a crash, a hang, an object left or a message of the validation layer.
// Controls are named beside each test; each was seen to fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/expect_error.h"
#include "tests/support/gpu/headset_rig.h"

namespace seascape {
namespace {

using test::error_under;
using test::HeadsetRig;
using test::HostileRuntime;
using test::simulated;
using testing::HasSubstr;
using Harm = HeadsetRig::Harm;

class HeadsetFaultsTest : public test::HarmTest {};

// All that may happen in a headset's life, so that each call is made: states, hands, a second session, an end.
std::vector<InputEvent> whole_life() {
  return {test::tracked(0, Tracker::left, Pose{{-0.2, 1.0, -0.4}}),
          test::tracked(0, Tracker::right, Pose{{0.2, 1.0, -0.4}}),
          test::became(4, HeadsetState::off),
          test::became(5, HeadsetState::focused),
          test::became(6, HeadsetState::recentred),
          test::became(7, HeadsetState::lost),
          test::became(14, HeadsetState::closed)};
}

// Returns what was thrown, or "" where it went on to its end.
std::string live(const Harm& harm, bool& has_failed) {
  SimulatedOptions options = simulated(whole_life());
  options.bare_hands[1] = true;
  HeadsetOptions how;
  how.rate_hz = test::rig_hz;
  try {
    HeadsetRig rig(options, how, harm, &has_failed);
    for (int frame = 0; frame < 40; ++frame) {
      if (frame == 3) {
        rig.headset.recentre();
        rig.headset.buzz(0, 1.0, 0.1);
      }
      if (frame == 24) rig.headset.leave();
      if (rig.step().closed) return "";
    }
    ADD_FAILURE() << "it did not come to its end";
  } catch (const Error& fault) {
    EXPECT_FALSE(fault.remedy().empty());
    return fault.what();
  }
  return "";
}

// Calls that are not made of a device that was made already, or not at all by us.
bool is_made(const std::string& name) {
  return name.find("Vulkan") == std::string::npos && name != "xrEnumerateEnvironmentBlendModes" &&
         name != "xrEnumerateDisplayRefreshRatesFB" && name != "xrGetDisplayRefreshRateFB" &&
         name != "xrPerfSettingsSetPerformanceLevelEXT" && name != "xrRequestExitSession" && name != "xrPathToString" &&
         name != "xrGetCurrentInteractionProfile";
}

// Every call fails, the first or the third time that it is made. What cannot be gone on without is named in the Error.
// Controls: xrLocateSpace checked under another name; the session left as it is where the constructor fails, of which
// the device's end tells.
TEST_F(HeadsetFaultsTest, EveryCallFailsOnce) {
  int failed = 0, went_on = 0;
  for (const std::string& name : HostileRuntime::names())
    for (const XrResult result : {XR_ERROR_RUNTIME_FAILURE, XR_ERROR_SESSION_LOST, XR_ERROR_INSTANCE_LOST})
      for (const int nth : {1, 3}) {
        bool has_failed = false;
        const std::string fault = live([&](HostileRuntime& calls) { calls.fail(name, nth, result); }, has_failed);
        const std::string what = name + " " + std::to_string(nth) + " " + xr_result_name(result);
        expect_nothing_left(what);
        if (nth == 1 && is_made(name)) {
          EXPECT_TRUE(has_failed) << what;
        }
        failed += has_failed;
        went_on += has_failed && fault.empty();
        if (fault.empty()) continue;
        const bool no_runtime = fault.find("no headset runtime answers") != std::string::npos ||
                                fault.find("runtime does not answer") != std::string::npos;
        EXPECT_TRUE(no_runtime || fault.find(name) != std::string::npos) << what << ": " << fault;
      }
  EXPECT_GT(failed, 200);
  EXPECT_GT(went_on, 60);
}

// A session that is lost in any call of a frame is begun anew. Controls: SessionLost not caught in begin(); in end();
// xrEndFrame unchecked; and for what is left, a picture's target that is never given up.
TEST_F(HeadsetFaultsTest, ASessionLostInAnyCallOfAFrameIsBegunAnew) {
  for (const char* name : {"xrWaitFrame", "xrSyncActions", "xrGetActionStateFloat", "xrGetActionStatePose",
                           "xrLocateSpace", "xrBeginFrame", "xrAcquireSwapchainImage", "xrWaitSwapchainImage",
                           "xrReleaseSwapchainImage", "xrEndFrame", "xrBeginSession", "xrLocateHandJointsEXT"}) {
    SimulatedOptions options =
        simulated({test::tracked(0, Tracker::left, Pose{}), test::tracked(0, Tracker::right, Pose{})});
    options.bare_hands[1] = true;
    HeadsetRig rig(options, [&](HostileRuntime& calls) { calls.fail(name, 1, XR_ERROR_SESSION_LOST); });
    rig.steps(8);
    EXPECT_TRUE(rig.calls.has_failed()) << name;
    EXPECT_GE(rig.runtime.frames_shown(), 3u) << name;
    EXPECT_EQ(std::count(rig.calls.calls().begin(), rig.calls.calls().end(), "xrCreateSession"), 2) << name;
  }
}

// The runtime dies: from then on every call says so. One line, whichever call it is seen in. Control: HeadsetLost taken
// for a session that may come again.
TEST_F(HeadsetFaultsTest, ARuntimeThatDiesIsToldOf) {
  for (const char* name : {"xrPollEvent", "xrWaitFrame", "xrSyncActions", "xrBeginFrame", "xrAcquireSwapchainImage",
                           "xrLocateViews", "xrReleaseSwapchainImage", "xrEndFrame"}) {
    const std::string line =
        error_under([&](HostileRuntime& calls) { calls.fail_from(name, 4, XR_ERROR_INSTANCE_LOST); });
    EXPECT_THAT(line, HasSubstr("the headset's runtime is gone")) << name;
    EXPECT_THAT(line, HasSubstr(name));
  }
  EXPECT_THAT(error_under([](HostileRuntime& calls) {
                calls.instead.PollEvent = [](XrInstance, XrEventDataBuffer* event) {
                  *event = {XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING};
                  return XR_SUCCESS;
                };
              }),
              HasSubstr("the headset's runtime is gone"));
}

// Functions that the runtime does not have, core ones and those of an extension. Control: need() as find().
TEST_F(HeadsetFaultsTest, MissingFunctions) {
  for (const std::string& name : HostileRuntime::names()) {
    const bool may_lack = name.ends_with("KHR") || name.ends_with("FB") || name.ends_with("EXT");
    try {
      HeadsetRig rig(simulated(), [&](HostileRuntime& calls) { calls.lack(name); });
      rig.steps(2);
      EXPECT_TRUE(may_lack) << name;
    } catch (const Error& fault) {
      EXPECT_FALSE(may_lack) << name;
      EXPECT_THAT(fault.what(), HasSubstr("the runtime has no " + name));
    }
  }
}

// Making the device: each of the four calls fails, or names no GPU. Control: the answer of null not looked at.
TEST_F(HeadsetFaultsTest, TheDeviceCannotBeMade) {
  const auto make = [](const Harm& harm) {
    return test::error_of([&] {
      SimulatedRuntime runtime(simulated());
      HostileRuntime calls(runtime);
      harm(calls);
      HeadsetSystem system(calls.get(), runtime.next());
      DeviceOptions options;
      system.make_device(options);
      const Device device(options);
    });
  };
  for (const char* name : {"xrGetVulkanGraphicsRequirements2KHR", "xrCreateVulkanInstanceKHR",
                           "xrGetVulkanGraphicsDevice2KHR", "xrCreateVulkanDeviceKHR"}) {
    for (const XrResult result : {XR_ERROR_RUNTIME_FAILURE, XR_ERROR_INSTANCE_LOST})
      EXPECT_THAT(make([&](HostileRuntime& calls) { calls.fail(name, 1, result); }), HasSubstr(name));
    EXPECT_THAT(make([&](HostileRuntime& calls) { calls.lack(name); }), HasSubstr("lacks functions"));
  }
  EXPECT_THAT(make([](HostileRuntime& calls) {
                calls.instead.GetVulkanGraphicsDevice2KHR = [](XrInstance, const XrVulkanGraphicsDeviceGetInfoKHR*,
                                                               VkPhysicalDevice* physical) {
                  *physical = VK_NULL_HANDLE;
                  return XR_SUCCESS;
                };
              }),
              HasSubstr("it names no GPU"));
  EXPECT_THAT(make([](HostileRuntime& calls) {
                calls.instead.GetVulkanGraphicsRequirements2KHR = [](XrInstance, XrSystemId,
                                                                     XrGraphicsRequirementsVulkanKHR* needs) {
                  needs->minApiVersionSupported = XR_MAKE_VERSION(1, 3, 0);
                  needs->maxApiVersionSupported = XR_MAKE_VERSION(9, 0, 0);
                  return XR_SUCCESS;
                };
              }),
              HasSubstr("Vulkan 1.3 to 9.0"));
  EXPECT_THAT(make([](HostileRuntime& calls) {
                calls.instead.CreateVulkanDeviceKHR = [](XrInstance, const XrVulkanDeviceCreateInfoKHR*, VkDevice*,
                                                         VkResult* result) {
                  *result = VK_ERROR_DEVICE_LOST;
                  return XR_SUCCESS;
                };
              }),
              HasSubstr("vkCreateDevice failed: device lost"));
}

}  // namespace
}  // namespace seascape
