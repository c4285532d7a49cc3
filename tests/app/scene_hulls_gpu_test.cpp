// Things that keep water out, as they are drawn: the floor of one is seen, and the sea up to its sides.
#include <gtest/gtest.h>

#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

class SceneHulls : public test::GpuTest {};

bool is_magenta(const std::uint8_t* p) { return p[0] > 110 && p[2] > 110 && p[1] < 70; }

// A magenta box, its top 0.5 m under water, and a hull half as wide that keeps the water out over the middle of it:
// only there the box is seen.
SceneObjects sunken_box(bool with_hull) {
  SceneObjects objects;
  const std::string inside = with_hull ? "inside_box" : "box";
  test::stand(objects,
              test::solid_model(
                  test::solid_box({2.0f, 2.0f, 2.0f}), test::unlit_magenta,
                  R"({"mesh":0},{"mesh":0,"name":")" + inside + R"(","translation":[0,2.2,0],"scale":[0.5,0.5,0.5]})"),
              pose({0.0, -2.5, 0.0}, 30.0, 0.0));
  return objects;
}

// From straight above, over deep water and over a bed, in each shape of the frame: magenta within the hole, sea
// outside. `clip.by_default` belongs to an effect that the scene does not name, and gives nothing. Without the hull
// there is no hole. Controls seen: hulls over which a bed lies dry; by_default without flat inputs.
TEST_F(SceneHulls, TheSeaIsCutOutOfThem) {
  constexpr std::uint32_t side = 96;
  std::size_t number = 0;
  for (const bool bed : {false, true})
    for (const test::FrameLook& look : test::sampled_looks())
      for (const bool with_hull : {true, false}) {
        if (!test::sampled(number++, 3)) continue;
        std::vector<std::pair<std::string, std::string>> set = look.set;
        set.insert(set.end(), {{"waves.resolution", "32"},
                               {"waves.wind_speed_mps", "1"},
                               {"waves.swell_height_m", "0"},
                               {"models.seen_in_water", "false"},
                               {"clip.by_default", "true"}});
        if (bed) set.emplace_back("waves.depth_m", "6");
        SeaShot shot({.scene = "calm",
                      .width = side,
                      .height = side,
                      .set = set,
                      .effects = bed ? std::vector<std::string>{"waves", "sea_depth", "models"}
                                     : std::vector<std::string>{"waves", "models"},
                      .objects = sunken_box(with_hull)});
        const Viewpoint viewpoint = shot.viewpoint(pose({0.0, 6.0, 0.0}, 30.0, -90.0));
        const Image8 picture = shot.picture(viewpoint, 2.0);
        const Fov& fov = viewpoint.eyes.front().fov;
        int within = 0, wrong = 0;
        for (std::uint32_t y = 0; y < side; ++y)
          for (std::uint32_t x = 0; x < side; ++x) {
            const glm::dvec2 at(fov.left + (fov.right - fov.left) * (x + 0.5) / side,
                                fov.up - (fov.up - fov.down) * (y + 0.5) / side);
            const double off = 6.0 * std::max(std::abs(at.x), std::abs(at.y));  // from the hole's middle, on the water
            if (std::abs(off - 1.0) < 0.12) continue;                           // its edge, and a wave's height
            const bool hole = with_hull && off < 1.0;
            within += hole;
            wrong += is_magenta(&picture.pixels[4 * (y * side + x)]) != hole;
          }
        EXPECT_EQ(within > 500, with_hull) << within;
        EXPECT_EQ(wrong, 0) << look.name << (bed ? " over a bed" : "") << (with_hull ? " " : ", no hull ")
                            << test::leave(picture, "hull_" + look.name + (bed ? "_bed" : ""));
      }
}

// A standalone headset's budget, along the scene's own path and for both eyes: at most 100 draws and 750,000 triangles.
// Control seen: every thing at its finest level of detail.
TEST_F(SceneHulls, HarbourKeepsToItsBudget) {
  for (const char* preset : {"low", "medium"}) {
    // Draws and triangles are those of 1440x1584 an eye; fewer pixels are lit.
    SeaShot shot({.scene = "harbour", .preset = preset, .width = 160, .height = 176, .views = 2});
    const CameraPath path = load_camera_path("harbour");
    std::uint64_t draws = 0, triangles = 0;  // of the sun's map once, of all else for each eye
    for (double time_s = 0.0; time_s <= path.duration_s(); time_s += test::long_run() ? 4.7 : 14.1) {
      Viewpoint viewpoint = shot.viewpoint(path.at(time_s).pose);
      viewpoint.pixels_per_radian *= 9.0;
      shot.draw(viewpoint, time_s);
      draws = std::max(draws, shot.counts().draws);
      std::uint64_t both = 0;
      for (const PipelineWork& work : shot.experience().frame().work())
        both += (std::string_view(work.pass) == "sun map" ? 1 : 2) * work.triangles;
      triangles = std::max(triangles, both);
    }
    std::printf("harbour at %s: up to %d draws, %d triangles for both eyes\n", preset, int(draws), int(triangles));
    EXPECT_LE(draws, 100u) << preset;
    EXPECT_LE(triangles, 750000u) << preset;
  }
}

}  // namespace
}  // namespace seascape
