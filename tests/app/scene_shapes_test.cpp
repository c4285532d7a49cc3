// Pockets of air and portals in a scene file: what is read, and that every fault names file, line, key, value and
// remedy.
#include "app/scene_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/scene.h"
#include "shaders/shared/water_line.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using testing::HasSubstr;

std::filesystem::path folder() {
  static const std::filesystem::path made = [] {
    const std::filesystem::path at = std::filesystem::path(testing::TempDir()) / "scene_shapes";
    std::filesystem::create_directories(at);
    const auto write = [&](const char* name, const test::SolidShape& shape) {
      const std::vector<std::uint8_t> bytes = test::solid_bytes(shape, "{}");
      std::ofstream(at / name, std::ios::binary)
          .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    };
    write("box.glb", test::solid_box({0.5f, 1.0f, 1.5f}));
    write("ball.glb", test::solid_sphere(1.0f));
    write("plate.glb", test::solid_plate(1.0f));
    test::SolidShape dented = test::solid_box({0.5f, 0.5f, 0.5f});
    dented.positions[0] *= 0.2f, dented.positions[1] *= 0.2f, dented.positions[2] *= 0.2f;
    write("dented.glb", dented);
    return at;
  }();
  return made;
}

Scene scene_of(const std::string& lists, const std::string& effects = R"("models", "portals")") {
  return parse_scene("{\"version\": 1, \"effects\": [" + effects + "],\n" +
                         R"("objects": [{"model": "box.glb", "name": "A", "at_m": [1, 2, 3]}],)" + "\n" + lists + "}",
                     (folder() / "s.json").string(), "low");
}
std::string fault_of(const std::string& lists, const std::string& effects = R"("models", "portals")") {
  try {
    scene_of(lists, effects);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SceneShapes, AreReadWithAllTheirKeys) {
  const Scene scene = scene_of(R"(
    "air": [{"shape": {"kind": "box", "size_m": [2, 4, 6]}, "at_m": [0, -5, 1], "yaw_deg": 90, "on": "A", "open_below": true},
            {"shape": {"kind": "sphere", "radius_m": 2}, "at_m": [0, -9, 0], "level_m": -0.5},
            {"shape": {"kind": "mesh", "file": "box.glb"}, "at_m": [0, -20, 0]}],
    "portals": [{"mode": "portal", "shape": {"kind": "disc", "radius_m": 0.5}, "at_m": [0, 0, 0]},
                {"mode": "portal", "shape": {"kind": "rectangle", "size_m": [2, 1]}, "at_m": [0, 0, 0]},
                {"mode": "volume", "shape": {"kind": "box", "size_m": [1, 1, 1]}, "at_m": [0, 0, 0]},
                {"mode": "fly_through", "shape": {"kind": "sphere", "radius_m": 1}, "at_m": [0, 0, 0]}])");
  ASSERT_EQ(scene.shapes.air.size(), 3u);
  const PlacedShape &room = scene.shapes.air[0], &bubble = scene.shapes.air[1], &mesh = scene.shapes.air[2];
  EXPECT_EQ(room.half_m, glm::dvec3(1, 2, 3));
  EXPECT_EQ(room.on, 0u);
  EXPECT_TRUE(room.open_below);
  EXPECT_EQ(bubble.level_m, -0.5);
  EXPECT_EQ(mesh.planes.size(), 6u);
  EXPECT_NEAR(mesh.radius_m, std::sqrt(0.25 + 1.0 + 2.25), 1e-6);
  ASSERT_EQ(scene.shapes.portals.size(), 4u);
  EXPECT_EQ(scene.shapes.portals[1].form, gpu::shape_rectangle);
  EXPECT_EQ(scene.shapes.portals[3].mode, gpu::portal_fly_through);
}

TEST(SceneShapes, FaultsNameTheirPlaceAndRemedy) {
  const auto air = [](const std::string& shape) {
    return "\"air\": [{\"shape\": " + shape + ", \"at_m\": [0, -5, 0]}]";
  };
  struct Row {
    std::string lists, says;
  };
  std::string nine = "\"air\": [";
  for (int i = 0; i < 9; ++i)
    nine += std::string(i > 0 ? "," : "") + R"({"shape": {"kind": "sphere", "radius_m": 1}, "at_m": [0, -5, 0]})";
  nine += "]";
  for (
      const Row& row :
      {Row{air(R"({"kind": "cube"})"), "s.json:3: air[0].shape.kind: 'cube' is not known"},
       Row{air(R"({"kind": "box"})"), "air[0].shape.size_m"},
       Row{air(R"({"kind": "box", "size_m": [0, 1, 1]})"), "air[0].shape.size_m"},
       Row{air(R"({"kind": "sphere", "radius_m": 2000})"), "air[0].shape.radius_m: 2000 is out of range"},
       Row{air(R"({"kind": "sphere", "radius_m": 2000})"), "give a number from 0.01 to 1000 m"},
       Row{air(R"({"kind": "disc", "radius_m": 1})"), "a disc holds no air"},
       Row{air(R"({"kind": "mesh", "file": "none.glb"})"), "air[0].shape.file: "},
       Row{air(R"({"kind": "mesh", "file": "ball.glb"})"), "'ball.glb' has more than 32 sides"},
       Row{air(R"({"kind": "mesh", "file": "plate.glb"})"), "'plate.glb' is not closed"},
       Row{air(R"({"kind": "mesh", "file": "dented.glb"})"), "'dented.glb' is not convex"},
       Row{R"("air": [{"shape": {"kind": "sphere", "radius_m": 1}, "at_m": [0, 0, 0], "on": "B"}])",
           "air[0].on: 'B' is no object of the scene"},
       Row{R"("air": [{"shape": {"kind": "sphere", "radius_m": 1}, "at_m": [0, 0, 0], "level_m": 0, "open_below": true}])",
           "give one of the two"},
       Row{R"("air": [{"shape": {"kind": "sphere", "radius_m": 1}, "at_m": [0, 0, 0], "mode": "portal"}])",
           "unknown key 'air[0].mode'"},
       Row{nine, "give at most 8"},
       Row{R"("portals": [{"shape": {"kind": "sphere", "radius_m": 1}, "at_m": [0, 0, 0]}])", "portals[0].mode"},
       Row{R"("portals": [{"mode": "hole", "shape": {"kind": "sphere", "radius_m": 1}, "at_m": [0, 0, 0]}])",
           "portals[0].mode: 'hole' is not known"},
       Row{R"("portals": [{"mode": "volume", "shape": {"kind": "disc", "radius_m": 1}, "at_m": [0, 0, 0]}])",
           "a disc has no inside for the mode 'volume'"},
       Row{R"("portals": {})", "portals: an object is not a list"}})
    EXPECT_THAT(fault_of(row.lists), HasSubstr(row.says)) << row.lists;
  EXPECT_THAT(fault_of(air(R"({"kind": "sphere", "radius_m": 1})"), "\"models\""),
              HasSubstr("the scene does not name the effect 'portals'"));
  EXPECT_EQ(fault_of(air(R"({"kind": "sphere", "radius_m": 1})")), "");  // the control
}

}  // namespace
}  // namespace seascape
