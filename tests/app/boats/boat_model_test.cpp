// What models say of how they float: every model of ours, and files with faults.
#include "app/boats/boat_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/boats/scene_bodies.h"
#include "app/scene.h"
#include "app/sea_spec.h"
#include "engine/error.h"
#include "ocean/bodies/probes.h"
#include "ocean/sea/sea.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using testing::HasSubstr;

BoatModel ours(const std::string& name) {
  return boat_model(load_solid_model(content_directory() / "models" / (name + ".glb")), name);
}

Scene scene_of(const std::string& objects, const std::string& more = "") {
  return parse_scene(
      "{\"version\": 1, \"effects\": [\"waves\", \"models\", \"boats\"], \"waves\": {\"wind_speed_mps\": 0}" + more +
          ", \"objects\": [" + objects + "]}",
      "s.json", "low");
}

// Loaded as it says, each floats with its waterline at its file's y = 0 within 0.1 % of its draught or 1 mm, upright.
// Control seen: the mass of the file times 1.01.
TEST(BoatModel, FloatsAtItsWaterline) {
  for (const char* name : {"rowing_boat", "yacht", "fishing_boat", "rib", "crate", "barrel", "buoy_mooring",
                           "buoy_lateral_port", "buoy_lateral_starboard"}) {
    const BoatModel model = ours(name);
    const BodySpec spec = body_spec(model, {}, 1.0, name);
    HullMesh mesh = *spec.hull;
    double lowest = 0.0;
    for (glm::dvec3& v : mesh.vertices) lowest = std::min(lowest, v.y), v -= spec.mass_centre_m;
    const FloatingUpright upright = float_upright(mesh, spec.mass.mass_kg, {});
    ASSERT_TRUE(upright.floats) << name;
    EXPECT_NEAR(upright.waterline_m + spec.mass_centre_m.y, 0.0, std::max(1e-3 * -lowest, 1e-3)) << name;
    EXPECT_EQ(model.is_boat,
              !std::string(name).starts_with("buoy") && std::string(name) != "crate" && std::string(name) != "barrel")
        << name;
  }
}

// What drives our boats is in their files. Control seen: the sails' names not read.
TEST(BoatModel, HasWhatDrivesIt) {
  const BoatModel yacht = ours("yacht"), rowing = ours("rowing_boat"), rib = ours("rib");
  ASSERT_EQ(yacht.boat.sails.size(), 2u);
  EXPECT_FALSE(yacht.boat.sails[0].sail.jib);
  EXPECT_TRUE(yacht.boat.sails[1].sail.jib);
  EXPECT_NEAR(yacht.boat.sails[0].sail.area_m2 + yacht.boat.sails[1].sail.area_m2, 56.0, 1.0);
  ASSERT_TRUE(yacht.boat.engine && yacht.boat.rudder);
  EXPECT_EQ(yacht.boat.engine->most_turn_rad, 0.0);
  EXPECT_EQ(yacht.seats.front().role, SeatRole::helm);
  ASSERT_EQ(rowing.boat.oars.size(), 2u);
  EXPECT_TRUE(rowing.boat.oars[0].to_port);
  EXPECT_EQ(rowing.seats.front().role, SeatRole::rower);
  ASSERT_TRUE(rib.boat.engine);
  EXPECT_GT(rib.boat.engine->most_turn_rad, 0.5);
}

// Twice as large it is eight times as heavy and floats at twice the draught. Another mass keeps the inertia's shape.
// Control seen: inertia not scaled.
TEST(BoatModel, IsScaled) {
  const BoatModel model = ours("rowing_boat");
  const BodySpec once = body_spec(model, {}, 1.0, "x"), twice = body_spec(model, {}, 2.0, "x");
  EXPECT_NEAR(twice.mass.mass_kg, 8.0 * once.mass.mass_kg, 1e-9);
  EXPECT_NEAR(twice.mass.inertia_kg_m2[0][0], 32.0 * once.mass.inertia_kg_m2[0][0], 1e-9);
  FloatSpec laden;
  laden.mass_kg = 2.0 * once.mass.mass_kg;
  EXPECT_NEAR(body_spec(model, laden, 1.0, "x").mass.inertia_kg_m2[1][1], 2.0 * once.mass.inertia_kg_m2[1][1], 1e-9);
  const BoatSpec large = scaled(model.boat, 2.0);
  EXPECT_NEAR(large.oars[0].length_m, 2.66, 1e-9);
}

// A file of anybody's floats by what it draws, where that is closed, with a mass that the scene says; else the fault
// says what is missing. Control seen: the mass's check taken away.
TEST(BoatModel, TakesAnyClosedModel) {
  const auto bytes = test::solid_bytes(test::solid_box({0.5f, 0.5f, 0.5f}), "{}");
  const SolidModel box = load_solid_model_from_memory(bytes, "box.glb");
  const BoatModel model = boat_model(box, "box.glb");
  EXPECT_NEAR(volume_of(model.hull).volume_m3, 1.0, 1e-6);
  FloatSpec floats;
  floats.mass_kg = 400.0;
  const BodySpec spec = body_spec(model, floats, 1.0, "s.json:3");
  EXPECT_NEAR(spec.mass.inertia_kg_m2[0][0], 400.0 / 6.0, 1e-3);
  try {
    (void)body_spec(model, {}, 1.0, "s.json:3");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.json:3: nobody says how heavy it is"));
    EXPECT_THAT(error.remedy(), HasSubstr("mass_kg"));
  }
  SolidModel open = box;
  auto& indices = open.meshes[0].primitives[0].indices;
  indices.resize(indices.size() - 3);
  try {
    (void)boat_model(open, "open.glb");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("it cannot float"));
    EXPECT_THAT(error.remedy(), HasSubstr("collision"));
  }
}

// Extras that do not fit are named. Control seen: a mass below 0 taken.
TEST(BoatModel, NamesFaultsOfExtras) {
  SolidModel box =
      load_solid_model_from_memory(test::solid_bytes(test::solid_box({0.5f, 0.5f, 0.5f}), "{}"), "box.glb");
  const auto fault = [&](const std::string& extras) {
    box.nodes[std::size_t(box.drawn.front())].extras = "{\"seascape\": " + extras + "}";
    try {
      (void)boat_model(box, "m.glb");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(fault(R"({"mass_kg": -3})"), HasSubstr("extras.seascape.mass_kg: -3 is out of range"));
  EXPECT_THAT(fault(R"({"engine": {"at_m": [0, 0, 0]}})"), HasSubstr("engine: propeller_m is missing"));
  EXPECT_THAT(fault(R"({"engine": 3})"), HasSubstr("engine: is not an object"));
  EXPECT_THAT(fault(R"({"sails": [1]})"), HasSubstr("sails: is not an object"));
  EXPECT_THAT(fault(R"({"oars": [{"at_m": [0, 0]}]})"), HasSubstr("oars.at_m"));
  EXPECT_THAT(fault(R"({"inertia_kgm2": [1, 2, 3]})"), HasSubstr("inertia_kgm2"));
  EXPECT_THAT(fault("{\"seats\": 7}"), HasSubstr("seats: 7 is not a list"));
  EXPECT_EQ(fault(R"({"mass_kg": 3, "unknown": {}})"), "");
}

// In a scene: a boat under way keeps the water out of her hull where she is, not where she began, and her engine and
// helm have her where a helmsman would. Controls seen: clip bodies left out; hulls of floating things left where they
// began.
TEST(SceneBodies, KeepWaterOutWhereTheyAre) {
  const Scene scene = scene_of(
      R"({"model": "rowing_boat", "at_m": [0, 0, 0], "float": {"velocity_mps": [0, -2]}},
         {"model": "yacht", "at_m": [40, 0, 0], "float": {"throttle": 1}},
         {"model": "rowing_boat", "at_m": [20, 0, 0]})");
  Sea sea(sea_spec(scene));
  const auto bodies = scene_bodies(scene);
  ASSERT_NE(bodies, nullptr);
  ASSERT_EQ(bodies->size(), 2u);
  sea.add(bodies);
  for (int i = 0; i <= 600; ++i) sea.advance(i / 60.0, {});
  const auto clipped = [&](const glm::dvec3& at) {
    return sea.view_at(10.0, SeaDetail::felt).query({at.x, at.z}).clipped;
  };
  const glm::dvec3 boat = bodies->pose_at(0, 10.0).position_m, yacht = bodies->pose_at(1, 10.0).position_m;
  EXPECT_LT(boat.z, -3.0);
  EXPECT_TRUE(clipped(boat));
  EXPECT_FALSE(clipped({0.0, 0.0, 0.0}));
  EXPECT_TRUE(clipped({20.0, 0.0, 0.0})) << "the one that stands still";
  EXPECT_LT(yacht.z, -10.0);
  EXPECT_TRUE(clipped(yacht + glm::dvec3(0.0, 0.0, -1.0)));
  EXPECT_EQ(bodies->bodies().spec(1).name, "yacht");
}

// A RIB that lies as deep as the tops of her tubes is dry from her bow to her stern. Control seen: an inside hull that
// ends 0.7 m behind the bow, 10 cm below the tubes' tops.
TEST(SceneBodies, ARibIsDryUpToHerTubes) {
  const auto clipped = [](double up_m, double z) {
    const Scene scene = scene_of(R"({"model": "rib", "at_m": [0, )" + std::to_string(up_m) + R"(, 0]})");
    Sea sea(sea_spec(scene));
    sea.advance(0.0, {});
    return sea.view_at(0.0, SeaDetail::felt).query({0.0, z}).clipped;
  };
  EXPECT_TRUE(clipped(-0.7, -2.9)) << "in her bow";
  EXPECT_TRUE(clipped(-0.56, 0.5)) << "amidships";
  EXPECT_FALSE(clipped(-0.85, 0.5)) << "over her tubes";
}

// Steady speeds under full throttle within a fifth of what such boats do: facts/boats.md has the fishing boat at 9
// knots and a yacht's hull speed is 7. Control seen: the waves' drag left out (11 knots).
TEST(SceneBodies, GoAsFastAsTheirKind) {
  const Scene scene = scene_of(R"({"model": "yacht", "at_m": [0, 0, 0], "float": {"throttle": 1}},
      {"model": "fishing_boat", "at_m": [40, 0, 0], "float": {"throttle": 1}})");
  Sea sea(sea_spec(scene));
  const auto bodies = scene_bodies(scene);
  sea.add(bodies);
  for (int i = 0; i <= 60 * 40; ++i) sea.advance(i / 60.0, {});
  EXPECT_NEAR(-bodies->velocity_mps(0).z / 0.5144, 7.0, 1.4);
  EXPECT_NEAR(-bodies->velocity_mps(1).z / 0.5144, 9.0, 1.8);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_NEAR(bodies->pose_at(n, 40.0).position_m.x, n == 0 ? 0.0 : 40.0, 0.05) << "straight on";
    EXPECT_NEAR(bodies->velocity_mps(n).x, 0.0, 0.01);
  }
}

}  // namespace
}  // namespace seascape
