// Going aboard, driving, looking and stepping off; how a boat's parts stand in her model.
#include "app/boats/crew.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/boats/boat_shape.h"
#include "app/boats/scene_bodies.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"

namespace seascape {
namespace {

struct Afloat {
  explicit Afloat(const std::string& objects)
      : scene(parse_scene(R"({"version": 1, "effects": ["waves", "models", "boats"], "waves": {"wind_speed_mps": 0},
                              "objects": [)" +
                              objects + "]}",
                          "s.json", "low")),
        sea(sea_spec(scene)),
        bodies(scene_bodies(scene)) {
    sea.add(bodies);
    sea.advance(0.0, {});
  }
  void run(double seconds, const ActionValues& values, Crew& crew) {
    for (int i = 0; i < int(seconds * 60.0 + 0.5); ++i) {
      crew.drive(*bodies, values);
      sea.advance(time += 1.0 / 60.0, {});
    }
  }
  std::string board(Crew& crew, const glm::dvec3& head) { return crew.board(scene, *bodies, head, time); }
  Scene scene;
  Sea sea;
  std::shared_ptr<SeaBodies> bodies;
  double time = 0.0;
};

ActionValues held(Action action, double value) {
  ActionValues values{};
  values[std::size_t(action)] = value;
  return values;
}

// The boat whose seat is nearest is boarded, by her helm; what is held drives her and nobody else; stepping off lets
// her be. Nothing to sit on, or too far away, is not boarded. Controls seen: the farthest seat taken; controls kept
// after stepping off.
TEST(Crew, BoardsDrivesAndStepsOff) {
  Afloat afloat(R"({"model": "yacht", "name": "Y", "at_m": [0, 0, 0], "float": {}},
                   {"model": "rib", "name": "R", "at_m": [9, 0, 0], "float": {}},
                   {"model": "crate", "at_m": [30, 0, 0], "float": {}})");
  Crew crew;
  EXPECT_EQ(afloat.board(crew, {30.0, 1.0, 0.0}), "no boat within 8 m");
  EXPECT_EQ(afloat.board(crew, {0.0, 200.0, 0.0}), "no boat within 8 m");
  EXPECT_EQ(afloat.board(crew, {8.0, 1.0, 1.0}), "aboard: R");
  ASSERT_EQ(crew.body(), 1u);
  const Pose eyes = crew.eyes(*afloat.bodies, afloat.time);
  EXPECT_NEAR(eyes.position_m.x, 9.0 - 0.32, 0.02) << "at her helm";
  EXPECT_NEAR(eyes.position_m.y, 0.894 + Crew::eyes_m, 0.02);
  afloat.run(4.0, held(Action::throttle, 1.0), crew);
  EXPECT_LT(afloat.bodies->velocity_mps(1).z, -1.0);
  EXPECT_GT(afloat.bodies->velocity_mps(0).z, -0.2);
  EXPECT_EQ(afloat.board(crew, {}), "stepped off: R");
  EXPECT_FALSE(crew.body());
  EXPECT_EQ(afloat.bodies->boat(1).asked().throttle, 0.0);
}

// A capsized boat is righted before she is boarded. Control seen: not righted.
TEST(Crew, RightsACapsizedBoat) {
  Afloat afloat(R"({"model": "rowing_boat", "name": "B", "at_m": [0, 0, 0], "roll_deg": 178, "float": {}})");
  Crew crew;
  EXPECT_EQ(afloat.board(crew, {1.0, 1.0, 0.0}), "righted: B");
  EXPECT_FALSE(crew.body());
  EXPECT_GT((afloat.bodies->pose_at(0, afloat.time).orientation * glm::dvec3(0.0, 1.0, 0.0)).y, 0.99);
  EXPECT_EQ(afloat.board(crew, {1.0, 1.0, 0.0}), "aboard: B");
}

// A rower looks astern. From behind one follows her heading, level; from where one stood one looks at her. Controls
// seen: the seat's yaw left out; the chase ahead of her.
TEST(Crew, LooksFromDeckFromBehindAndFromWhereOneWas) {
  Afloat afloat(R"({"model": "rowing_boat", "name": "B", "at_m": [0, 0, 0], "yaw_deg": 90, "float": {}})");
  Crew crew;
  (void)afloat.board(crew, {1.0, 1.0, 0.0});
  const glm::dvec3 ahead(0.0, 0.0, -1.0);
  EXPECT_NEAR((crew.eyes(*afloat.bodies, 0.0).orientation * ahead).x, -1.0, 1e-3);
  crew.set_view(BoatView::chase, {});
  const Pose chase = crew.outside(*afloat.bodies, 0.0, 0.02);
  EXPECT_LT(chase.position_m.x, -4.0);
  EXPECT_GT(chase.position_m.y, 1.0);
  EXPECT_GT((chase.orientation * ahead).x, 0.8);
  EXPECT_NEAR((chase.orientation * glm::dvec3(1.0, 0.0, 0.0)).y, 0.0, 1e-9) << "level";
  crew.set_view(BoatView::fixed, {0.0, 3.0, 20.0});
  const Pose fixed = crew.outside(*afloat.bodies, 0.0, 0.02);
  EXPECT_EQ(fixed.position_m, glm::dvec3(0.0, 3.0, 20.0));
  EXPECT_LT((fixed.orientation * ahead).z, -0.95);
}

// Wheel, rudder, boom, sails and oars turn about their pivots by what the boat does, and nothing else moves. Controls
// seen: the boom to the other side; a part's children left where they were.
TEST(BoatShape, PartsStandAsTheBoatIsDriven) {
  const auto model = std::make_shared<const SolidModel>(load_solid_model(content_directory() / "models" / "yacht.glb"));
  const BoatShape shape(model);
  ASSERT_TRUE(shape.moves());
  const auto node = [&](const char* name) {
    for (std::size_t i = 0; i < model->nodes.size(); ++i)
      if (model->nodes[i].name == name) return i;
    ADD_FAILURE() << name;
    return std::size_t(0);
  };
  const std::vector<glm::dmat4> still = placed_nodes(*model);
  std::vector<glm::dmat4> nodes;
  BoatParts parts;
  parts.helm = 1.0;
  parts.boom_rad = {0.8, 0.5};
  shape.place(parts, {}, 0.0, nodes);
  EXPECT_EQ(nodes[node("hull")], still[node("hull")]);
  const auto aft = [&](const char* name) { return glm::dvec3(nodes[node(name)] * glm::dvec4(0.0, 0.0, 1.0, 0.0)); };
  EXPECT_NEAR(aft("boom").x, std::sin(0.8), 1e-9) << "to starboard";
  EXPECT_GT(aft("rudder").x, 0.5);
  EXPECT_NEAR(aft("mainsail").x, aft("boom").x, 1e-9) << "with its boom";
  EXPECT_GT(glm::determinant(glm::dmat3(nodes[node("mainsail")])), 0.9);
  parts.boom_rad = {-0.8, -0.5};
  shape.place(parts, {}, 0.0, nodes);
  EXPECT_NEAR(aft("boom").x, -std::sin(0.8), 1e-9);
  EXPECT_LT(glm::determinant(glm::dmat3(nodes[node("mainsail")])), -0.9) << "it bellies to the other side";
  const glm::dvec3 pivot(nodes[node("boom")][3]);
  EXPECT_EQ(pivot, glm::dvec3(still[node("boom")][3]));
}

}  // namespace
}  // namespace seascape
