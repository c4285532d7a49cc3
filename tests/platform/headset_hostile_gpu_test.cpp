// Runtimes of OpenXR that tell a headset what cannot be: values, counts, times and events that are absurd. What comes
// of it is a picture or an Error with a clear line, never a crash, a hang, an object left or a message of the
// validation layer. Controls are named beside each test; each was seen to fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/support/gpu/headset_rig.h"

namespace seascape {
namespace {

using test::error_under;
using test::HeadsetRig;
using test::HostileRuntime;
using test::simulated;
using testing::HasSubstr;
using Harm = HeadsetRig::Harm;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class HostileRuntimeTest : public test::HarmTest {};

// Control: the first format taken, whatever it is.
TEST_F(HostileRuntimeTest, NoFormatOfOurs) {
  const auto formats = [](std::vector<std::int64_t> given) {
    return [given](HostileRuntime& calls) {
      calls.instead.EnumerateSwapchainFormats = [given](XrSession, std::uint32_t room, std::uint32_t* count,
                                                        std::int64_t* to) {
        *count = std::uint32_t(given.size());
        for (std::size_t i = 0; room > 0 && i < given.size(); ++i) to[i] = given[i];
        return XR_SUCCESS;
      };
    };
  };
  for (const auto& given :
       {std::vector<std::int64_t>{}, {VK_FORMAT_R16G16B16A16_SFLOAT}, {VK_FORMAT_D32_SFLOAT, 0, -1}})
    EXPECT_THAT(error_under(formats(given)), HasSubstr("takes no sRGB pictures of 8 bits"));
  // Without depths, and with what it likes best first.
  for (const VkFormat best : {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB}) {
    HeadsetRig rig(simulated(), formats({VK_FORMAT_R16G16B16A16_SFLOAT, best}));
    rig.steps(3);
    EXPECT_EQ(rig.headset.colour(), best);
    EXPECT_FALSE(rig.headset.shows_depth());
    EXPECT_EQ(rig.runtime.frames_shown(), 3u);
  }
}

// Control: the count of views not looked at.
TEST_F(HostileRuntimeTest, OneViewAndFourViews) {
  for (const std::uint32_t views : {0u, 1u, 3u, 4u}) {
    const std::string line = error_under([&](HostileRuntime& calls) {
      calls.instead.EnumerateViewConfigurationViews = [views](XrInstance, XrSystemId, XrViewConfigurationType,
                                                              std::uint32_t room, std::uint32_t* count,
                                                              XrViewConfigurationView* to) {
        *count = views;
        for (std::uint32_t i = 0; i < std::min(room, views); ++i)
          to[i] = {XR_TYPE_VIEW_CONFIGURATION_VIEW, nullptr, 16, 64, 12, 64, 1, 1};
        return XR_SUCCESS;
      };
    });
    EXPECT_THAT(line, HasSubstr("it has " + std::to_string(views) + " views, not two"));
  }
  // Or four when they are located: the last known ones are drawn.
  HeadsetRig rig(simulated(), [](HostileRuntime& calls) {
    calls.instead.LocateViews = [&calls](XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                                         std::uint32_t room, std::uint32_t* count, XrView* views) {
      const XrResult result = calls.real.LocateViews(session, info, state, room, count, views);
      *count = 4;
      return result;
    };
  });
  rig.steps(3);
  EXPECT_EQ(rig.runtime.frames_shown(), 3u);
}

// Controls: the zero let through, the largest not looked at.
TEST_F(HostileRuntimeTest, AbsurdSizes) {
  const auto sized = [](std::uint32_t width, std::uint32_t most_width, std::uint32_t height,
                        std::uint32_t most_height) {
    return [=](HostileRuntime& calls) {
      calls.instead.EnumerateViewConfigurationViews = [=](XrInstance, XrSystemId, XrViewConfigurationType,
                                                          std::uint32_t room, std::uint32_t* count,
                                                          XrViewConfigurationView* to) {
        *count = 2;
        for (std::uint32_t i = 0; i < std::min(room, 2u); ++i)
          to[i] = {XR_TYPE_VIEW_CONFIGURATION_VIEW, nullptr, width, most_width, height, most_height, 1, 1};
        return XR_SUCCESS;
      };
    };
  };
  EXPECT_THAT(error_under(sized(0, 100, 0, 100)), HasSubstr("pictures of 0x0 pixels"));
  EXPECT_THAT(error_under(sized(16, 0, 12, 0)), HasSubstr("at most 0x0"));
  EXPECT_THAT(error_under(sized(100000, 100000, 100000, 100000)), HasSubstr("pictures of 100000x100000 pixels"));
  EXPECT_THAT(error_under(sized(UINT32_MAX, UINT32_MAX, 12, 12)), HasSubstr("pictures of 4294967295x12"));
  HeadsetRig rig(simulated(), sized(40, 16, 20, UINT32_MAX));  // more than it takes
  const DisplayFrame shown = rig.step();
  EXPECT_EQ(shown.width, 16u);
  EXPECT_EQ(shown.height, 20u);
  EXPECT_EQ(rig.runtime.frames_shown(), 1u);
}

Harm located_as(std::function<void(XrView*)> change) {
  return [change](HostileRuntime& calls) {
    calls.instead.LocateViews = [&calls, change](XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                                                 std::uint32_t room, std::uint32_t* count, XrView* views) {
      const XrResult result = calls.real.LocateViews(session, info, state, room, count, views);
      if (room >= 2) change(views);
      return result;
    };
  };
}

void expect_usual(const Viewpoint& viewpoint) {
  for (const View& eye : viewpoint.eyes) {
    EXPECT_TRUE(std::isfinite(glm::length(eye.pose.position_m)));
    EXPECT_NEAR(glm::length(eye.pose.orientation), 1.0, 1e-9);
    for (const double tangent : {eye.fov.left, eye.fov.right, eye.fov.up, eye.fov.down})
      EXPECT_LT(std::abs(tangent), 60.0);
    EXPECT_GT(eye.fov.right - eye.fov.left, 0.01);
    EXPECT_GT(eye.fov.up - eye.fov.down, 0.01);
  }
}

// Absurd fields of view are not drawn: 90 degrees are. Control: fov_is_sound() true for all.
TEST_F(HostileRuntimeTest, AbsurdFieldsOfView) {
  for (const XrFovf fov :
       {XrFovf{nan, 0.7f, 0.7f, -0.7f}, XrFovf{0.5f, -0.5f, 0.7f, -0.7f}, XrFovf{-0.7f, 0.7f, -0.5f, 0.5f},
        XrFovf{-1.562f, 1.562f, 1.562f, -1.562f}, XrFovf{0, 0, 0, 0}, XrFovf{-9.0f, 9.0f, 9.0f, -9.0f},
        XrFovf{-INFINITY, INFINITY, 0.5f, -0.5f}, XrFovf{0.1f, 0.1001f, 0.5f, -0.5f}}) {
    HeadsetRig rig(simulated(), located_as([fov](XrView* views) { views[0].fov = views[1].fov = fov; }));
    rig.steps(3);
    EXPECT_EQ(rig.runtime.frames_shown(), 3u);
    expect_usual(rig.viewpoint);
    EXPECT_NEAR(rig.viewpoint.eyes[0].fov.right, 1.0, 1e-3);  // 90 degrees
  }
}

// Controls: pose_is_sound() true for all; its tolerance wider than OpenXR's.
TEST_F(HostileRuntimeTest, InvalidPoses) {
  for (const XrPosef pose : {XrPosef{{0, 0, 0, 1}, {nan, 0, 0}}, XrPosef{{nan, 0, 0, 1}, {0, 1, 0}},
                             XrPosef{{0, 0, 0, 0}, {0, 1, 0}}, XrPosef{{0, 0, 0, 1.05f}, {0, 1, 0}},
                             XrPosef{{0, 0, 0, 1}, {0, INFINITY, 0}}, XrPosef{{0, 0, 0, 1}, {1e30f, 0, 0}}}) {
    int frame = 0;
    const auto change = [&](XrView* views) {
      if (++frame > 1) views[0].pose = views[1].pose = pose;
    };
    HeadsetRig rig(simulated(), located_as(change));
    rig.steps(3);
    EXPECT_EQ(rig.runtime.frames_shown(), 3u);
    expect_usual(rig.viewpoint);
    EXPECT_NEAR(rig.seen().position_m.y, 1.7, 1e-6);  // as it was
    // And as those of hands.
    rig.calls.instead.LocateSpace = [&](XrSpace, XrSpace, XrTime, XrSpaceLocation* location) {
      location->locationFlags = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
      location->pose = pose;
      return XR_SUCCESS;
    };
    rig.calls.instead.GetActionStatePose = [](XrSession, const XrActionStateGetInfo*, XrActionStatePose* state) {
      state->isActive = XR_TRUE;
      return XR_SUCCESS;
    };
    rig.calls.instead.GetActionStateFloat = [](XrSession, const XrActionStateGetInfo*, XrActionStateFloat* state) {
      state->isActive = XR_TRUE;
      state->currentState = nan;
      return XR_SUCCESS;
    };
    rig.steps(2);
    EXPECT_FALSE(rig.headset.input().hands[0].has_value());
    for (const double value : rig.headset.input().values) EXPECT_EQ(value, 0.0);
  }
}

// Times as the runtime predicts them, and what our clock makes of them. Controls: the clock as the time less the first,
// which stands for 1000 s after a jump.
TEST_F(HostileRuntimeTest, TimesThatStandAndJump) {
  constexpr std::int64_t period = 15'625'000, far = 1'000'000'000'000, most = std::numeric_limits<std::int64_t>::max();
  struct Case {
    std::vector<std::int64_t> times;
    double passed_s;
  };
  for (const auto& [times, passed_s] :
       {Case{{far, far, far, far}, 0.0}, Case{{far, far - period, far - 2 * period, far - 3 * period}, 0.0},
        Case{{far, far + period, 2 * far, far + 2 * period, far + 3 * period}, 1000.0 + 0.015625},
        Case{{far, most, 1, most, 1, period}, 7200.0 + 0.015625 - 1e-9}, Case{{-5, far, 0, far + period}, 0.015625},
        Case{{std::numeric_limits<std::int64_t>::min(), most, far, far + period}, 0.015625}}) {
    std::size_t frame = 0;
    HeadsetRig rig(simulated(), [&](HostileRuntime& calls) {
      calls.instead.WaitFrame = [&](XrSession session, const XrFrameWaitInfo* info, XrFrameState* state) {
        const XrResult result = calls.real.WaitFrame(session, info, state);
        state->predictedDisplayTime = times[std::min(frame++, times.size() - 1)];
        state->predictedDisplayPeriod = -7;
        return result;
      };
      calls.instead.EndFrame = [&](XrSession session, const XrFrameEndInfo* info) {
        EXPECT_EQ(info->displayTime, times[std::min(frame - 1, times.size() - 1)]);
        XrFrameEndInfo as_its_own = *info;  // for its own clock goes as it should
        as_its_own.displayTime = 1'000'000'000 + std::int64_t(frame - 1) * period;
        return calls.real.EndFrame(session, &as_its_own);
      };
    });
    double last_s = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const DisplayFrame shown = rig.step();
      EXPECT_GE(shown.time_s, last_s);
      EXPECT_GE(shown.period_s, 0.0);
      last_s = shown.time_s;
    }
    EXPECT_NEAR(last_s, passed_s, 1e-6) << times[1];
    EXPECT_EQ(rig.runtime.frames_shown(), times.size());
  }
}

// Counts that are absurd, or of which less comes than was said. Controls: listed_by() without its bound; images of null
// let through.
TEST_F(HostileRuntimeTest, HugeCounts) {
  EXPECT_THAT(error_under([](HostileRuntime& calls) {
                calls.instead.EnumerateInstanceExtensionProperties = [](const char*, std::uint32_t,
                                                                        std::uint32_t* count, XrExtensionProperties*) {
                  *count = UINT32_MAX;
                  return XR_SUCCESS;
                };
              }),
              HasSubstr("counts 4294967295"));
  EXPECT_THAT(error_under([](HostileRuntime& calls) {
                calls.instead.EnumerateViewConfigurations = [](XrInstance, XrSystemId, std::uint32_t,
                                                               std::uint32_t* count, XrViewConfigurationType*) {
                  *count = 100'000;
                  return XR_SUCCESS;
                };
              }),
              HasSubstr("counts 100000"));
  for (const std::uint32_t images : {0u, 5u, 100'000u}) {
    const std::string line = error_under([&](HostileRuntime& calls) {
      calls.instead.EnumerateSwapchainImages = [&calls, images](XrSwapchain swapchain, std::uint32_t room,
                                                                std::uint32_t* count, XrSwapchainImageBaseHeader* to) {
        std::uint32_t ignored = 0;
        const XrResult result = calls.real.EnumerateSwapchainImages(swapchain, room, &ignored, to);
        *count = images;
        return result;
      };
    });
    EXPECT_THAT(line, HasSubstr("xrEnumerateSwapchainImages")) << images;
  }
  EXPECT_THAT(error_under([](HostileRuntime& calls) {
                calls.instead.AcquireSwapchainImage =
                    [&calls](XrSwapchain swapchain, const XrSwapchainImageAcquireInfo* info, std::uint32_t* index) {
                      const XrResult result = calls.real.AcquireSwapchainImage(swapchain, info, index);
                      *index = 1000;
                      return result;
                    };
              }),
              HasSubstr("gives an image that there is not"));
  EXPECT_THAT(error_under([](HostileRuntime& calls) {
                calls.instead.WaitSwapchainImage = [](XrSwapchain, const XrSwapchainImageWaitInfo*) {
                  return XR_TIMEOUT_EXPIRED;
                };
              }),
              HasSubstr("holds a picture for more than five seconds"));
}

// Formats and spaces by the million, of which there are none. Control: the limit of xr_list() taken away.
TEST_F(HostileRuntimeTest, ListsThatLie) {
  EXPECT_THAT(error_under([](HostileRuntime& calls) {
                calls.instead.EnumerateSwapchainFormats = [](XrSession, std::uint32_t, std::uint32_t* count,
                                                             std::int64_t*) {
                  *count = UINT32_MAX;
                  return XR_SUCCESS;
                };
              }),
              HasSubstr("xrEnumerateSwapchainFormats counts 4294967295"));
  EXPECT_THAT(error_under([](HostileRuntime& calls) {
                calls.instead.EnumerateReferenceSpaces = [](XrSession, std::uint32_t, std::uint32_t* count,
                                                            XrReferenceSpaceType*) {
                  *count = UINT32_MAX;
                  return XR_SUCCESS;
                };
              }),
              HasSubstr("xrEnumerateReferenceSpaces counts 4294967295"));
}

// Masks that make no sense are none, and the pictures are drawn whole. Controls: each of corners_of()'s checks left
// out; of the counts, its vectors then ask for 16 GB.
TEST_F(HostileRuntimeTest, AbsurdMasks) {
  struct Mask {
    std::uint32_t vertices, indices, filled_vertices;
    XrVector2f corner;
    std::uint32_t index;
  };
  const Mask sound{3, 3, 3, {2.0f, 0.5f}, 2};
  const auto hidden = [](const Mask& mask) {
    HeadsetRig rig(simulated(), [&](HostileRuntime& calls) {
      calls.instead.GetVisibilityMaskKHR = [mask](XrSession, XrViewConfigurationType, std::uint32_t,
                                                  XrVisibilityMaskTypeKHR, XrVisibilityMaskKHR* to) {
        const bool fills = to->vertices != nullptr;
        to->vertexCountOutput = fills ? mask.filled_vertices : mask.vertices;
        to->indexCountOutput = mask.indices;
        for (std::uint32_t i = 0; fills && i < std::min(mask.vertices, to->vertexCapacityInput); ++i)
          to->vertices[i] = i == 2 ? mask.corner : XrVector2f{1.0f + 0.1f * float(i), 0.5f + 0.5f * float(i)};
        for (std::uint32_t i = 0; fills && i < to->indexCapacityInput; ++i)
          to->indices[i] = i == 2 ? mask.index : i % 3;
        return XR_SUCCESS;
      };
    });
    rig.steps(2);
    EXPECT_EQ(rig.runtime.frames_shown(), 2u);
    const HiddenMesh* mesh = rig.headset.hidden();
    return mesh == nullptr ? std::size_t(99) : mesh->corners[0].size() + mesh->corners[1].size();
  };
  EXPECT_EQ(hidden(sound), 6u);
  for (const Mask& absurd :
       {Mask{UINT32_MAX, 3, UINT32_MAX, {}, 0}, Mask{3, UINT32_MAX, 3, {}, 0}, Mask{3, 4, 3, sound.corner, 2},
        Mask{0, 3, 0, {}, 0}, Mask{3, 3, 4, sound.corner, 2}, Mask{3, 3, 3, sound.corner, 3},
        Mask{3, 3, 3, sound.corner, UINT32_MAX}, Mask{3, 3, 3, {nan, 0.5f}, 2}, Mask{3, 3, 3, {0.5f, -INFINITY}, 2},
        Mask{3, 3, 3, {1e30f, 0.5f}, 2}, Mask{3, 3, 3, {-9.0f, -6.0f}, 2}})
    EXPECT_EQ(hidden(absurd), 0u) << absurd.vertices << " " << absurd.indices << " " << absurd.filled_vertices << " "
                                  << absurd.corner.x << " " << absurd.index;
  EXPECT_EQ(hidden({3, 0, 3, {}, 0}), 0u);  // corners, but of nothing
}

// A runtime without a floor: LOCAL, which lies 1.6 m up here, is taken as 1.7 m up. Control: LOCAL taken for the floor.
TEST_F(HostileRuntimeTest, NoSpaceKnowsTheFloor) {
  HeadsetRig rig(simulated(), [](HostileRuntime& calls) {
    calls.instead.EnumerateReferenceSpaces = [](XrSession, std::uint32_t, std::uint32_t* count, XrReferenceSpaceType*) {
      *count = 0;
      return XR_SUCCESS;
    };
  });
  rig.steps(2);
  EXPECT_EQ(rig.runtime.frames_shown(), 2u);
  EXPECT_NEAR(rig.seen().position_m.y, 1.7 - 1.6 + 1.7, 1e-6);
}

// Events that nobody knows, that tell of another session, that never end, that are lost. Controls: the session of an
// event not looked at; take_events() without its patience.
TEST_F(HostileRuntimeTest, StrangeEvents) {
  int polled = 0;
  HeadsetRig rig(simulated(), [&](HostileRuntime& calls) {
    calls.instead.PollEvent = [&calls, &polled](XrInstance instance, XrEventDataBuffer* event) -> XrResult {
      *event = {XR_TYPE_EVENT_DATA_BUFFER};
      XrEventDataSessionStateChanged of_another{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED};
      of_another.session = reinterpret_cast<XrSession>(std::uintptr_t(0x1234));
      of_another.state = polled % 2 == 0 ? XR_SESSION_STATE_EXITING : XR_SESSION_STATE_LOSS_PENDING;
      switch (polled++ % 5) {
        case 0:
          event->type = XrStructureType(0x7ffffffe);
          return XR_SUCCESS;
        case 1:
          std::memcpy(static_cast<void*>(event), &of_another, sizeof of_another);
          return XR_SUCCESS;
        case 2:
          event->type = XR_TYPE_EVENT_DATA_EVENTS_LOST;
          return XR_SUCCESS;
        case 3:
          event->type = XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED;
          return XR_SUCCESS;
        default:
          (void)calls.real.PollEvent(instance, event);
          return XR_SUCCESS;  // never an end
      }
    };
  });
  for (int frame = 0; frame < 4; ++frame) EXPECT_FALSE(rig.step().closed);
  EXPECT_EQ(rig.runtime.frames_shown(), 4u);
  EXPECT_LE(polled, 4 * 1000);
}

// States that make no sense, told before those that do. Control: pictures shown by the state instead of the runtime's
// word.
TEST_F(HostileRuntimeTest, StatesThatMakeNoSense) {
  std::vector<XrSessionState> told{XrSessionState(77), XR_SESSION_STATE_FOCUSED, XrSessionState(-3),
                                   XR_SESSION_STATE_IDLE};
  XrSession session = XR_NULL_HANDLE;
  HeadsetRig rig(simulated(), [&](HostileRuntime& calls) {
    calls.instead.CreateSession = [&](XrInstance instance, const XrSessionCreateInfo* info, XrSession* made) {
      const XrResult result = calls.real.CreateSession(instance, info, made);
      session = *made;
      return result;
    };
    calls.instead.PollEvent = [&](XrInstance instance, XrEventDataBuffer* event) -> XrResult {
      const XrResult result = calls.real.PollEvent(instance, event);
      if (result == XR_SUCCESS || told.empty()) return result;
      XrEventDataSessionStateChanged changed{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED};
      changed.session = session;
      changed.state = told.back();
      told.pop_back();
      std::memcpy(static_cast<void*>(event), &changed, sizeof changed);
      return XR_SUCCESS;
    };
  });
  rig.steps(4);
  EXPECT_TRUE(told.empty());
  EXPECT_EQ(rig.runtime.frames_shown(), 4u);
}

}  // namespace
}  // namespace seascape
