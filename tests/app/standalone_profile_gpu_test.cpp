// Low and medium ask nothing beyond what a standalone headset has, whose limits are data
// (tests/support/gpu/standalone_profile.h).
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "app/camera_path.h"
#include "app/scene.h"
#include "engine/error.h"
#include "engine/shader.h"
#include "shaders/shared/frame_data.h"
#include "shaders/shared/sky_push.h"
#include "shaders/shared/slots.h"
#include "tests/app/effects_under_proof.h"
#include "tests/support/gpu/asked_of_vulkan.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

using test::Asked;
using test::SeaShot;
using test::ShotOptions;
using test::StandaloneProfile;

class Standalone : public test::GpuTest {};

// As a headset's driver draws them: waves by the GPU, both eyes in one pass.
ShotOptions options_of(const std::string& scene, const std::string& preset) {
  return {.scene = scene, .preset = preset, .width = 60, .height = 66, .views = 2, .set = {{"waves.where", "gpu"}}};
}

// What the eyes of Quest 2 see: it is as wide as its fields of view, whatever the size that is drawn here.
Viewpoint headset_viewpoint(const Pose& head) {
  const auto fov = [](double left, double right, double up, double down) {
    return Fov{std::tan(glm::radians(left)), std::tan(glm::radians(right)), std::tan(glm::radians(up)),
               std::tan(glm::radians(down))};
  };
  Viewpoint viewpoint;
  viewpoint.viewer = head;
  viewpoint.eyes = stereo_views(head, Fov{}, 0.063);
  viewpoint.eyes[0].fov = fov(-50, 45, 48, -50);
  viewpoint.eyes[1].fov = fov(-45, 50, 48, -50);
  viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, test::standalone_height);
  return viewpoint;
}

// Triangles are those of both eyes, which one draw gives. Draws the scene from its start and along its path, then takes
// the headset's size, and tells what that took.
Asked asked_by_frames(Device& device, SeaShot& shot, const std::string& scene) {
  Asked asked;
  const auto draw = [&](const Pose& head, double time_s) {
    shot.draw(headset_viewpoint(head), time_s);
    asked.ask("draws", shot.counts().draws, scene);
    asked.ask("triangles", shot.counts().triangles * std::uint64_t(shot.experience().options().views), scene);
  };
  draw(shot.scene().start, 0.0);
  const CameraPath path = load_camera_path(scene);
  for (const double part : {0.25, 0.5, 0.75}) {
    const PathSample sample = path.at(part * path.duration_s());
    draw(sample.pose, sample.scene_time_s);
  }
  shot.experience().resize(test::standalone_width, test::standalone_height);
  device.wait_idle();
  asked.merge(test::asked_by(device.objects()));
  asked.ask("maxMemoryAllocationCount", device.memory().blocks(), scene);
  asked.ask("maxMultiviewViewCount", std::uint64_t(shot.experience().options().views), scene);
  return asked;
}

// A profile without `planted`, or with one less than it is asked for, is seen to lack that and nothing else.
void expect_every_limit_is_seen(const Asked& asked) {
  using testing::ElementsAre;
  using testing::HasSubstr;
  for (const test::ProfileLimit& row : test::standalone_limits) {
    ASSERT_TRUE(asked.numbers.contains(row.name)) << row.name << " is not looked at";
    ASSERT_GT(asked.numbers.find(row.name)->second.most, 0u) << row.name;
    std::vector<test::ProfileLimit> limits(std::begin(test::standalone_limits), std::end(test::standalone_limits));
    for (test::ProfileLimit& planted : limits)
      if (planted.name == row.name) planted.most = asked.numbers.find(row.name)->second.most - 1;
    StandaloneProfile profile;
    profile.limits = limits;
    EXPECT_THAT(test::beyond(profile, asked), ElementsAre(HasSubstr(std::string(row.name))));
  }
  for (const auto& [capability, by] : asked.capabilities) {
    std::vector<test::ProfileCapability> rows(std::begin(test::standalone_capabilities),
                                              std::end(test::standalone_capabilities));
    std::erase_if(rows, [what = capability](const auto& row) { return row.capability == what; });
    StandaloneProfile profile;
    profile.capabilities = rows;
    EXPECT_THAT(test::beyond(profile, asked), ElementsAre(HasSubstr("SPIR-V capability")));
  }
  for (const auto& [format, features] : asked.formats)
    for (const auto& [feature, by] : features) {
      std::vector<test::ProfileFormat> rows(std::begin(test::standalone_formats), std::end(test::standalone_formats));
      for (test::ProfileFormat& row : rows)
        if (row.format == format) row.features &= ~VkFormatFeatureFlags(feature);
      StandaloneProfile profile;
      profile.formats = rows;
      EXPECT_THAT(test::beyond(profile, asked), ElementsAre(HasSubstr("with feature")));
    }
  for (const auto& [samples, by] : asked.samples) {
    StandaloneProfile profile;
    profile.samples &= ~samples;
    EXPECT_THAT(test::beyond(profile, asked), ElementsAre(HasSubstr("samples")));
  }
  Asked planted = asked;
  planted.extensions["SPV_KHR_planted"] = "a shader";
  EXPECT_THAT(test::beyond({}, planted), ElementsAre(HasSubstr("SPV_KHR_planted")));
}

// What is read of shaders, against their sources. Controls, all seen: three numbers of shared memory taken for 12
// bytes, a binding of both stages counted twice in the set.
TEST_F(Standalone, ReadsWhatShadersDeclare) {
  ShaderLibrary& library = test::shaders();
  const auto asked_by_pipeline = [](std::vector<std::shared_ptr<const Shader>> shaders) {
    ObjectRecord record;
    record.type = VK_OBJECT_TYPE_PIPELINE;
    record.name = "pipeline";
    record.made_with.shaders = std::move(shaders);
    return test::asked_by({record});
  };
  const auto most = [](const Asked& asked, std::string_view limit) { return asked.numbers.find(limit)->second.most; };
  const Asked light = asked_by_pipeline({library.load("sky_light.comp", {})});
  EXPECT_EQ(most(light, "maxComputeSharedMemorySize"), 64u * 16);
  EXPECT_EQ(most(light, "maxComputeWorkGroupInvocations"), 64u);
  EXPECT_EQ(most(light, "maxPerStageDescriptorStorageBuffers"), 1u);
  EXPECT_EQ(most(light, "maxPerStageDescriptorStorageImages"), 1u);
  EXPECT_EQ(most(light, "maxPushConstantsSize"), sizeof(gpu::SkyPush));
  EXPECT_EQ(most(light, "maxComputeWorkGroupSize[1]"), 1u);
  const std::vector<SpecValue> values{{gpu::value_multiview, 1}, {gpu::value_tile_shape, 1}};
  const Asked sky = asked_by_pipeline({library.load("sky.vert", values), library.load("sky.frag", values)});
  EXPECT_EQ(most(sky, "maxUniformBufferRange"), sizeof(gpu::FrameData));
  EXPECT_EQ(most(sky, "maxDescriptorSetUniformBuffersDynamic"), 2u) << "the frame's data and the sky's light";
  EXPECT_EQ(most(sky, "maxPerStageDescriptorSampledImages"), 1u);
  EXPECT_EQ(most(sky, "maxFragmentOutputAttachments"), 1u);
  EXPECT_TRUE(sky.capabilities.contains(4439)) << "MultiView";
}

// On a device that uses nothing beyond Vulkan 1.1's floor: the validation layer sees each feature and extension that is
// used and was not asked for. Controls, in it: each row of the profile, planted one below what is used or left out, is
// seen. Seen besides: a device whose facts are not held to the floor, which has transforms of 17,408 shared bytes and
// filters whole floats.
// A sixth of the scenes, of low and medium others; all with SEASCAPE_LONG=1.
void expect_within_profile(const std::string& preset) {
  DeviceOptions options;
  options.validation = options.core_only = true;
  Device floor(options);
  Asked all;
  std::size_t number = preset == "low" ? 0 : 1;
  for (const std::string& scene : content_names("scenes")) {
    if (!test::sampled(number++, 6)) continue;
    SeaShot shot(floor, options_of(scene, preset));
    ASSERT_TRUE(shot.experience().in_tile());
    const Asked asked = asked_by_frames(floor, shot, scene);
    EXPECT_TRUE(shot.experience().frame().times().empty()) << "timestamps are each device's own";
    EXPECT_THAT(test::beyond({}, asked), testing::IsEmpty()) << scene << " at " << preset;
    all.merge(asked);
  }
  expect_every_limit_is_seen(all);
}

TEST_F(Standalone, LowAsksNothingBeyondItsLimits) { expect_within_profile("low"); }
TEST_F(Standalone, MediumAsksNothingBeyondItsLimits) { expect_within_profile("medium"); }

// As far apart as minUniformBufferOffsetAlignment may have them. Control, seen: offsets of multiples of 16.
TEST_F(Standalone, UniformsAreAsFarApartAsADeviceMayAsk) {
  DeviceOptions options;
  options.validation = options.core_only = true;
  Device floor(options);
  Frame frame(floor);
  for (int i = 0; i < 2; ++i) {  // both slots of the ring
    frame.begin();
    for (int uniform = 0; uniform < 3; ++uniform) EXPECT_EQ(frame.upload_uniform(1.0f) % 256, 0u);
    frame.submit();
  }
  frame.finish();
}

// What is there of a scene after two frames but for their timers, and the second one's passes.
std::vector<std::string> made(Device& device, SeaShot& shot) {
  shot.draw(headset_viewpoint(shot.scene().start), 0.0);
  shot.draw(headset_viewpoint(shot.scene().start), 0.1);
  device.wait_idle();
  std::vector<std::string> list;
  for (const ObjectRecord& object : device.objects())
    if (object.name != "frame times" && (object.type == VK_OBJECT_TYPE_PIPELINE ||
                                         object.type == VK_OBJECT_TYPE_IMAGE || object.type == VK_OBJECT_TYPE_BUFFER))
      list.push_back(object.effect + ": " + object.name);
  for (const PipelineWork& work : shot.experience().frame().work()) list.push_back(std::string("pass: ") + work.pass);
  std::sort(list.begin(), list.end());
  return list;
}

// A device that has more takes the same path to the picture, except that it cuts clipped water off sample by sample.
// What draws there is within the limits too. Controls, seen: without that exception the last row differs;
// "InterpolationFunction" left out of the profile is told.
TEST_F(Standalone, MoreThanItsLimitsChangesNothingButWhereWaterIsCut) {
  DeviceOptions options;
  options.validation = options.core_only = true;
  Device floor(options);
  ShotOptions cut = options_of("open_sea", "low");
  cut.effects = {"waves", "clip"};
  cut.inputs = {test::pool(InputTarget::clip, glm::vec4(1.0f))};
  for (const ShotOptions& shot : {options_of("storm", "low"), options_of("rain_pool", "low"),
                                  options_of("lagoon", "low"), options_of("rivers", "low"), cut}) {
    std::vector<std::string> least, whole;
    {
      SeaShot on_floor(floor, shot);
      least = made(floor, on_floor);
    }
    SeaShot on_whole(shot);
    whole = made(test::device(), on_whole);
    const bool by_samples = shot.effects && test::device().facts().sample_shading;
    if (by_samples) {
      EXPECT_NE(least, whole) << "or the exception is none";
      for (std::string& name : whole)
        if (const std::size_t at = name.find("surface_clip.frag"); at != std::string::npos)
          name.replace(at, std::string_view("surface_clip.frag").size(), "surface.frag");
    }
    EXPECT_EQ(least, whole) << shot.scene;
    std::vector<ObjectRecord> drawing = test::device().objects();
    std::erase_if(drawing, [](const ObjectRecord& object) {
      return object.made_with.shaders.empty() || object.made_with.shaders[0]->stage != VK_SHADER_STAGE_VERTEX_BIT;
    });
    EXPECT_THAT(test::beyond({}, test::asked_by(drawing)), testing::IsEmpty()) << shot.scene;
    StandaloneProfile planted;
    planted.capabilities = planted.capabilities.first(4);
    EXPECT_EQ(test::beyond(planted, test::asked_by(drawing)).size(), by_samples ? 1u : 0u);
  }
}

// All effects at once read 31 images in the fragment stage: a device of 16 says so. Control, seen: without
// expect_images_fit() the validation layer has its say instead.
TEST_F(Standalone, ASceneOfTooManyEffectsIsRefused) {
  DeviceOptions options;
  options.validation = options.core_only = true;
  Device floor(options);
  const std::string scene = std::string(SEASCAPE_TEST_DIR) + "/../docs/data/every_effect.json";
  try {
    SeaShot shot(floor, options_of(scene, "low"));
    ADD_FAILURE() << "built";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr(
                    "surface.frag reads 31 images for the scene's effects, and the device allows 16 in a stage"));
    EXPECT_THAT(error.what(), testing::HasSubstr("leave out some of the scene's effects"));
  }
  floor.wait_idle();
  EXPECT_TRUE(floor.objects().empty());
}

}  // namespace

}  // namespace seascape
