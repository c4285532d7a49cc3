// What of models lies on the GPU: in blocks where the device has them, and kept while other objects are built anew.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/scene.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::ShotOptions;

class LoadedModelsOnGpu : public test::GpuTest {};

const std::vector<std::string> kept_names{"crate", "buoy_mooring"};

SceneObjects crate_and_buoy() {
  SceneObjects objects;
  glm::dvec3 at(-0.6, 0.3, -2.2);
  for (const std::string& name : kept_names) {
    const auto file = content_directory() / "models" / (name + ".glb");
    test::stand(objects, PlacedModel(std::make_shared<const SolidModel>(load_solid_model(file))), pose(at, 30.0, 0.0));
    at.x += 1.3;
  }
  return objects;
}

ShotOptions options_of(const test::FrameLook& look, const test::Set& set = {}) {
  ShotOptions options = test::solid_options(look, crate_and_buoy(), 200, 150, test::flat_water);
  options.set.insert(options.set.end(), set.begin(), set.end());
  return options;
}

const Pose head = pose({0.0, 1.1, 0.0}, 0.0, -18.0);

bool of_a_model(const ObjectRecord& object) {
  return std::find(kept_names.begin(), kept_names.end(), object.name) != kept_names.end();
}

struct Pictures {
  std::uint64_t bytes = 0;
  int in_blocks = 0, whole = 0;
};
Pictures pictures_of_models(Device& device) {
  Pictures all;
  for (const ObjectRecord& object : device.objects()) {
    if (object.type != VK_OBJECT_TYPE_IMAGE || !of_a_model(object)) continue;
    all.bytes += object.bytes;
    const VkFormat format = object.made_with.image->format;
    ++(format >= VK_FORMAT_BC1_RGB_UNORM_BLOCK && format <= VK_FORMAT_BC5_SNORM_BLOCK ? all.in_blocks : all.whole);
  }
  return all;
}

// The same picture of a crate and a buoy to a small part of its light, from a quarter of the memory; and a device
// without blocks, or one that is told to do without, has none. Controls seen: roughness and metalness taken for red and
// green (`channels` left out); a normal map's green turned round when it is encoded; block_textures not asked.
TEST_F(LoadedModelsOnGpu, BlocksShowThePictureInAQuarterOfTheMemory) {
  if (!test::device().facts().block_textures) GTEST_SKIP() << "the device has no blocks";
  double worst = 0.0;
  for (const test::FrameLook& look : test::sampled_looks()) {
    Pictures whole, blocks;
    Image8 as_is, in_blocks;
    {
      SeaShot shot(options_of(look, {{"models.block_textures", "false"}}));
      as_is = shot.picture(head, 1.0);
      whole = pictures_of_models(test::device());
    }
    test::device().wait_idle();
    {
      SeaShot shot(options_of(look));
      in_blocks = shot.picture(head, 1.0);
      blocks = pictures_of_models(test::device());
    }
    test::device().wait_idle();
    EXPECT_EQ(whole.in_blocks, 0);
    EXPECT_EQ(whole.whole, 6) << "three of each model: data serve occlusion too";
    EXPECT_EQ(blocks.whole, 0);
    EXPECT_EQ(blocks.in_blocks, 8);
    EXPECT_LT(double(blocks.bytes), 0.28 * double(whole.bytes));
    const test::PictureDifference off = test::difference(as_is, in_blocks);
    worst = std::max(worst, off.mean);
    EXPECT_GT(test::differing_pixels(as_is, in_blocks), 300) << look.name << ": or nothing is seen of them";
    EXPECT_LT(off.mean, 0.002) << look.name << test::leave(as_is, "whole") << test::leave(in_blocks, "blocks");
    EXPECT_LT(off.p99, 0.04) << look.name << test::leave(as_is, "whole") << test::leave(in_blocks, "blocks");
  }
  RecordProperty("mean_of_light", std::to_string(worst));
  DeviceOptions least;
  least.validation = least.core_only = true;
  Device floor(least);
  EXPECT_FALSE(floor.facts().block_textures);
  SeaShot shot(floor, options_of(test::frame_looks[0]));
  EXPECT_GT(test::statistics(shot.picture(head, 1.0)).deviation, 5.0);
  EXPECT_EQ(pictures_of_models(floor).in_blocks, 0);
}

// Other effects, samples and shapes of the frame build nearly all anew, but not what was loaded: each of its objects is
// older than a mark set before. Without `models` nothing of it is there, and with it again as much as at first.
// Controls seen: make_solids() that always loads; one that never lets go.
TEST_F(LoadedModelsOnGpu, AreKeptWhileOtherObjectsAreBuiltAnew) {
  SeaShot shot(options_of(test::frame_looks[0]));
  Experience& experience = shot.experience();
  const auto of_models = [&](const std::string& after) {
    test::device().wait_idle();
    std::size_t count = 0;
    bool past = after.empty();
    for (const ObjectRecord& object : test::device().objects()) {
      past = past || object.name == after;
      count += past && of_a_model(object);
    }
    return count;
  };
  const Image8 before = shot.picture(head, 1.0);
  const std::size_t all = of_models("");
  EXPECT_GT(all, 20u);
  {
    const Buffer mark(test::device(), "mark", 64, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    const std::uint64_t builds = experience.builds();
    experience.apply_effects({"waves", "models", "foam"});
    shot.draw(head, 1.1);
    experience.apply_effects({"waves", "models"});
    shot.draw(head, 1.2);
    shot.set("msaa", "1");
    shot.set("models.shadow_texels", "0");
    shot.draw(head, 1.3);
    experience.resize(120, 90);
    shot.draw(head, 1.4);
    EXPECT_GE(experience.builds(), builds + 4);
    EXPECT_EQ(of_models("mark"), 0u) << "loaded anew";
    EXPECT_EQ(of_models(""), all);
    experience.apply_effects({"waves"});
    shot.draw(head, 1.5);
    EXPECT_EQ(of_models(""), 0u) << "what no effect calls for";
    experience.apply_effects({"waves", "models"});
    shot.draw(head, 1.6);
    EXPECT_EQ(of_models("mark"), all) << "the control of the mark";
    EXPECT_EQ(of_models(""), all);
    shot.set("models.block_textures", "false");
    EXPECT_EQ(of_models(""), test::device().facts().block_textures ? all - 4 : all)
        << "occlusion lies with the other data";
    shot.set("models.block_textures", "true");
  }
  experience.resize(200, 150);
  shot.set("msaa", "4");
  shot.set("models.shadow_texels", "2048");
  EXPECT_EQ(test::differing_pixels(shot.picture(head, 1.0), before), 0);
}

}  // namespace
}  // namespace seascape
