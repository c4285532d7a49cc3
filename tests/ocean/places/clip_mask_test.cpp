// Patches that are wholly clipped, against every place within them.
#include "ocean/places/clip_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace seascape {
namespace {

std::vector<InputSpec> basin(float value) {
  InputSpec spec;
  spec.to = InputTarget::clip;
  spec.value = {value, 0.0f, 0.0f, 0.0f};
  spec.blend = InputBlend::replace;
  spec.shape = AreaInput{.round = true, .at_m = {6.0, -9.0}, .size_m = {70.0, 40.0}, .turn_deg = 20.0};
  return {spec};
}

// What the mask says is clipped has no place that reads as water, while the viewer moves and rises; and it says so of
// most of what is. Controls seen: texels between which a place lies left out at a rectangle's edge; the finest slice
// alone asked; the outside never let in.
TEST(ClipMask, SaysSoOfPlacesWithoutWaterAlone) {
  for (const bool by_default : {false, true}) {
    PlaceSettings settings;
    settings.windows = {.resolution = 144, .slices = 3, .texel_m = 0.25};
    settings.clip_by_default = by_default;
    const auto inputs = std::make_shared<const Inputs>(InputTarget::clip, basin(by_default ? 0.0f : 1.0f));
    const auto placed = [&](int i) {
      return lod_placement(settings.windows, {2.3 * i, -1.1 * i}, lod_scale(settings.windows, 2.0 + 1.5 * i));
    };
    PlaceField<glm::vec4> field(place_values(inputs, settings), settings, placed(0), 0.0);
    ClipMask mask;
    mask.follow(field, 0xfu);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> at(-150.0, 150.0), size(0.3, 25.0), part(0.0, 1.0);
    int said = 0, are = 0;
    for (int i = 0; i < 12; ++i) {
      if (i > 0) mask.follow(field, changed_slices(field.follow(placed(i), 0.0)));
      for (int n = 0; n < 400; ++n) {
        const glm::dvec2 least(at(random), at(random)), most = least + glm::dvec2(size(random), size(random));
        bool dry = true;
        for (int k = 0; k < 60 && dry; ++k)
          dry = field.field().sample(glm::mix(least, most, glm::dvec2(part(random), part(random))), 0.0).x > 0.5f;
        const bool says = mask.clipped(least, most);
        said += says, are += dry;
        EXPECT_TRUE(dry || !says) << least.x << ' ' << least.y << ' ' << most.x << ' ' << most.y << ' ' << by_default;
      }
    }
    EXPECT_GT(are, 50);
    EXPECT_GT(said, are / 5) << are;
  }
}

TEST(ClipMask, NothingIsNotClipped) {
  ClipMask mask;
  EXPECT_FALSE(mask.clipped({0.0, 0.0}, {1.0, 1.0})) << "before the first field";
  PlaceSettings settings;
  settings.windows = {.resolution = 64, .slices = 2, .texel_m = 0.5};
  settings.clip_by_default = true;
  const auto inputs = std::make_shared<const Inputs>(InputTarget::clip, std::vector<InputSpec>{});
  const PlaceField<glm::vec4> field(place_values(inputs, settings), settings,
                                    lod_placement(settings.windows, {0.0, 0.0}, {}), 0.0);
  mask.follow(field, 0x3u);
  EXPECT_TRUE(mask.clipped({-5.0, 3.0}, {5.0, 4.0}));
  EXPECT_TRUE(mask.clipped({1e5, 3.0}, {2e5, 4.0}));
  EXPECT_FALSE(mask.clipped({1.0, 3.0}, {1.0, 4.0})) << "no size";
  EXPECT_FALSE(mask.clipped({std::nan(""), 3.0}, {1.0, 4.0}));
}

}  // namespace
}  // namespace seascape
