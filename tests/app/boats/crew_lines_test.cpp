// What a crew does with lines and anchors: making fast to what is near, casting off, anchoring, coming back; and that
// recorded it happens again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "app/boats/boat_shape.h"
#include "app/boats/crew.h"
#include "app/boats/line_shape.h"
#include "app/boats/scene_bodies.h"
#include "app/path_recorder.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"
#include "tests/support/allocations.h"

namespace seascape {
namespace {

using testing::HasSubstr;

struct Afloat {
  explicit Afloat(const std::string& objects, const std::string& sea_keys = R"("wind_speed_mps": 0, "depth_m": 5)",
                  const std::string& effects = R"("models", "boats")")
      : scene(parse_scene(R"({"version": 1, "effects": [)" + effects + R"(], "waves": {)" + sea_keys +
                              R"(}, "objects": [)" + objects + "]}",
                          "s.json", "low")),
        sea(sea_spec(scene)),
        bodies(scene_bodies(scene)) {
    sea.add(bodies);
    sea.advance(0.0, {});
    run(0.1);
  }
  // A force on a body all the while, N.
  void run(double seconds, const glm::dvec3& force_n = {}, std::size_t body = 0) {
    for (int i = 0; i < int(seconds * 60.0 + 0.5); ++i) {
      if (force_n != glm::dvec3(0.0)) bodies->bodies().push(body, force_n, at(body));
      sea.advance(time += 1.0 / 60.0, {});
      for (const BodyEvent& event : bodies->take_events()) ++told[std::size_t(event.kind)];
    }
  }
  std::string press(Action action, const glm::dvec3& head = {}) {
    return crew.press(action, scene, *bodies, head, time).value_or("nothing");
  }
  int events(BodyEventKind kind) const { return told[std::size_t(kind)]; }
  glm::dvec3 at(std::size_t body) const { return bodies->bodies().result()[body].motion.centre_m; }
  Scene scene;
  Sea sea;
  std::shared_ptr<SeaBodies> bodies;
  Crew crew;
  double time = 0.0;
  std::array<int, 16> told{};
};

constexpr const char* rib = R"({"model": "rib", "name": "R", "at_m": [0, 0, 0], "float": {}})";

// A boat is made fast to a pier's cleats, a buoy's ring, another boat or a stone of the quay, whichever is near, and
// then pulls no farther than her lines; cast off she goes. Where nothing is near it says so. Controls seen:
// lines that are not handed to the bodies; the reach of lines left out; cast_off that leaves lines which begin at
// another.
TEST(CrewLines, MakeFastToWhatIsNear) {
  const struct {
    const char *what, *name;
  } cases[] = {
      {R"({"model": "pier", "name": "the pier", "at_m": [-4.5, 0, 0]})", "the pier"},
      {R"({"model": "buoy_mooring", "name": "buoy", "at_m": [1, 0, -7]})", "buoy"},
      {R"({"model": "yacht", "name": "Y", "at_m": [4, 0, 0], "float": {"moored_m": [[4, -20], [4, 20]]}})", "Y"},
      {R"({"model": "breakwater", "name": "quay", "at_m": [6, -1.2, 0]})", "quay"}};
  for (const auto& one : cases) {
    Afloat afloat(std::string(rib) + "," + one.what);
    EXPECT_EQ(afloat.press(Action::moor), "you are not aboard");
    ASSERT_EQ(afloat.press(Action::board, {0.0, 1.5, 1.0}), "aboard: R");
    ASSERT_EQ(afloat.press(Action::moor), std::string("moored: R to ") + one.name);
    const auto lines = afloat.bodies->moorings().lines();
    ASSERT_FALSE(lines.empty());
    double longest = 0.0;
    for (const Moorings::Line& line : lines) {
      if (line.is.body == 0) longest = std::max(longest, line.is.length_m);
    }
    EXPECT_LT(longest, 1.05 * Crew::line_m + 0.2);
    const double begun = afloat.at(0).z;
    afloat.run(14.0, {0.0, 0.0, 1500.0});
    const double held = afloat.at(0).z;
    EXPECT_LT(held - begun, 2.0 * longest + 8.0) << one.name;
    afloat.run(3.0, {0.0, 0.0, 1500.0});
    EXPECT_NEAR(afloat.at(0).z, held, 1.0) << one.name;
    EXPECT_EQ(afloat.press(Action::moor), "cast off: R");
    EXPECT_FALSE(afloat.bodies->moorings().made_fast(0));
    afloat.run(8.0, {0.0, 0.0, 1500.0});
    EXPECT_GT(afloat.at(0).z - held, 5.0) << one.name;
  }
  Afloat alone(std::string(rib) + R"(, {"model": "buoy_mooring", "at_m": [0, 0, -14]})");
  (void)alone.press(Action::board, {0.0, 1.5, 1.0});
  EXPECT_EQ(alone.press(Action::moor), "nothing to make fast to within 8 m");
}

// One boat tows another: both go, no farther apart than the line, and a boat is cast off by either. Control
// seen: the line's other end in the world.
TEST(CrewLines, OneBoatTowsAnother) {
  Afloat afloat(std::string(rib) + R"(, {"model": "rowing_boat", "name": "D", "at_m": [0, 0, 8], "float": {}})");
  ASSERT_EQ(afloat.press(Action::board, {0.0, 1.5, 1.0}), "aboard: R");
  ASSERT_EQ(afloat.press(Action::moor), "moored: R to D");
  afloat.run(15.0, {0.0, 0.0, -800.0});
  EXPECT_LT(afloat.at(1).z, 6.0);
  EXPECT_GT(afloat.bodies->velocity_mps(0).z, -8.0);
  EXPECT_LT(afloat.bodies->velocity_mps(1).z, -0.5);
  EXPECT_LT(glm::length(afloat.at(1) - afloat.at(0)), 16.0);
  EXPECT_TRUE(afloat.bodies->moorings().made_fast(1));
  afloat.bodies->cast_off(1);
  EXPECT_FALSE(afloat.bodies->moorings().made_fast(0));
}

// A line parts where it is pulled harder than it bears, and that is told. Controls seen: breaking left out.
TEST(CrewLines, PartWhereTheyArePulledTooHard) {
  Afloat afloat(std::string(rib) + R"(, {"model": "pier", "at_m": [-4.5, 0, 0]})");
  (void)afloat.press(Action::board, {0.0, 1.5, 1.0});
  (void)afloat.press(Action::moor);
  const double bears = rope_of(2000.0).breaking_n;
  EXPECT_NEAR(bears, 21e3, 500.0) << "a line of 10 mm";
  afloat.run(8.0, {0.0, 0.0, 0.3 * bears});
  EXPECT_EQ(afloat.events(BodyEventKind::parted), 0);
  afloat.run(6.0, {0.0, 0.0, 4.0 * bears});
  EXPECT_GT(afloat.events(BodyEventKind::parted), 0);
  EXPECT_FALSE(afloat.bodies->moorings().made_fast(0));
}

// In 5 m of water the chain is five times as long as the bow stands over the ground. Under half of what the anchor
// holds she lies where the chain lets her; under half as much again it drags, which is told, and not after that.
// Weighed she goes. Controls seen: an anchor that never drags; a chain without its weight (she stops with a
// jerk, and slack takes nothing).
TEST(CrewLines, AnchorsHoldAndDrag) {
  Afloat afloat(rib);
  (void)afloat.press(Action::board, {0.0, 1.5, 1.0});
  const std::string told = afloat.press(Action::anchor);
  EXPECT_THAT(told, HasSubstr("anchored: R, 5.0 m of water, "));
  ASSERT_EQ(afloat.bodies->moorings().lines().size(), 1u);
  const auto anchor = [&] { return afloat.bodies->moorings().lines()[0].is.to_m; };
  const MooringLine line = afloat.bodies->moorings().lines()[0].is;
  const glm::dvec3 dropped = anchor();
  EXPECT_NEAR(dropped.y, -5.0, 1e-6);
  const double bow_m = line.from_m.y;
  EXPECT_NEAR(line.length_m, 5.0 * (5.0 + bow_m), 0.3);
  const double holds = tackle_of(2000.0, 9.81).holds_n;
  EXPECT_NEAR(holds, 3.4e3, 200.0) << "7.9 kg";
  // Where the chain already pulls so hard: what drifts there has way on, and comes up with a jerk.
  BodyMotion motion = afloat.bodies->bodies().result()[0].motion;
  const Chain chain{line.weight_n_m, line.length_m, line.stiffness_n_m * line.length_m};
  motion.centre_m.z += chain_reach(chain, 0.1 * holds, 5.0 + bow_m);
  afloat.bodies->bodies().place(0, motion);
  afloat.run(8.0, {0.0, 0.0, 0.1 * holds});
  const double light = afloat.at(0).z;
  EXPECT_NEAR(light, motion.centre_m.z, 1.0) << "its weight holds her";
  for (int n = 0; n < 30; ++n) afloat.run(1.0, {0.0, 0.0, (0.1 + 0.4 * n / 30.0) * holds});  // without a jerk
  EXPECT_EQ(anchor(), dropped);
  EXPECT_GT(afloat.at(0).z, light + 0.1);
  EXPECT_LT(glm::length(afloat.bodies->velocity_mps(0)), 0.1);
  EXPECT_EQ(afloat.events(BodyEventKind::drags), 0);
  afloat.run(5.0, {0.0, 0.0, 1.5 * holds});
  EXPECT_GT(anchor().z, dropped.z + 1.0);
  EXPECT_NEAR(anchor().y, -5.0, 1e-6);
  EXPECT_EQ(afloat.events(BodyEventKind::drags), 1);
  afloat.run(6.0, {0.0, 0.0, 0.2 * holds});
  const glm::dvec3 there = anchor();
  afloat.run(5.0, {0.0, 0.0, 0.2 * holds});
  EXPECT_LT(anchor().z - there.z, 0.2) << "it holds again";
  EXPECT_EQ(afloat.press(Action::anchor), "anchor weighed: R");
  EXPECT_FALSE(afloat.bodies->moorings().anchored(0));
}

// Chain for three times the depth is the least: deeper it says how deep she could anchor, and lets nothing go. Control
// seen: a scope of one.
TEST(CrewLines, TooDeepToAnchorIsTold) {
  Afloat deep(rib, R"("wind_speed_mps": 0, "depth_m": 60)");
  (void)deep.press(Action::board, {0.0, 1.5, 1.0});
  EXPECT_THAT(deep.press(Action::anchor),
              HasSubstr("too deep to anchor: 60 m of water, and her chain is long enough for 1"));
  EXPECT_TRUE(deep.bodies->moorings().lines().empty());
  Afloat less(rib, R"("wind_speed_mps": 0, "depth_m": 10)");
  (void)less.press(Action::board, {0.0, 1.5, 1.0});
  EXPECT_THAT(less.press(Action::anchor), HasSubstr("anchored: R, 10.0 m of water, 38 m of chain")) << "all of it";
}

// Capsized, full, far off and anchored, a boat comes back to where the scene has her: upright, dry, at rest, with the
// scene's lines and no others. Controls seen: the water left in her; the scene's lines not made fast anew;
// the pose of the last step.
TEST(CrewLines, ABoatComesBack) {
  Afloat afloat(
      R"({"model": "rowing_boat", "name": "B", "at_m": [3, 0, -2], "yaw_deg": 70, "float": {"fills": true, "moored_m": [[3, 4]]}},
         {"model": "rib", "name": "far", "at_m": [300, 0, 0], "float": {}})");
  ASSERT_EQ(afloat.bodies->moorings().lines().size(), 1u);
  EXPECT_EQ(afloat.press(Action::respawn, {50.0, 0.0, 0.0}), "no boat within 8 m");
  ASSERT_EQ(afloat.press(Action::board, {3.0, 1.0, -2.0}), "aboard: B");
  EXPECT_EQ(afloat.press(Action::moor), "cast off: B");
  (void)afloat.press(Action::anchor);
  EXPECT_EQ(afloat.press(Action::board), "stepped off: B");
  BodyMotion motion = afloat.bodies->bodies().result()[0].motion;
  motion.centre_m += glm::dvec3(40.0, 0.0, 0.0);
  motion.orientation = glm::dquat(0.0, 0.0, 0.0, 1.0);
  motion.velocity.linear = {3.0, 0.0, 0.0};
  afloat.bodies->bodies().place(0, motion);
  afloat.bodies->bodies().fill(0, 0.3);
  afloat.run(1.0);
  EXPECT_EQ(afloat.press(Action::respawn, {900.0, 0.0, 0.0}), "back where she began: B") << "that was boarded last";
  const BodyState& state = afloat.bodies->bodies().result()[0];
  EXPECT_LT(glm::length(state.at_m - glm::dvec3(3.0, 0.0, -2.0)), 1e-9);
  EXPECT_GT((state.motion.orientation * glm::dvec3(0.0, 1.0, 0.0)).y, 0.999999);
  EXPECT_NEAR((state.motion.orientation * glm::dvec3(0.0, 0.0, -1.0)).x, std::sin(glm::radians(70.0)), 1e-6);
  EXPECT_EQ(glm::length(state.motion.velocity.linear), 0.0);
  EXPECT_EQ(state.filled_m3, 0.0);
  afloat.run(5.0);
  ASSERT_EQ(afloat.bodies->moorings().lines().size(), 1u);
  EXPECT_EQ(afloat.bodies->moorings().lines()[0].kind, Moorings::Kind::scene);
  EXPECT_LT(glm::length(afloat.at(0) - glm::dvec3(3.0, 0.1, -2.0)), 0.5);
}

// A session of boarding, mooring, throttle, casting off, anchoring and coming back, recorded frame by frame and played
// again: the sea's state has the same bits at the end, and without the presses of `moor` and `anchor` others. Control
// seen: presses left out of the recording.
TEST(CrewLines, RecordedTheyHappenAgain) {
  const std::string objects = std::string(rib) + R"(, {"model": "pier", "at_m": [-4.5, 0, 0]})";
  constexpr double rate = 30.0;
  constexpr int frames = 600;
  const auto live = [&](const auto& acted) {
    Afloat afloat(objects);
    for (int n = 0; n < frames; ++n) {
      const auto [values, presses] = acted(n);
      for (const ActionPress& press : presses) (void)afloat.press(press.action, {0.0, 1.5, 1.0});
      afloat.crew.drive(*afloat.bodies, values);
      afloat.sea.advance(afloat.time += 1.0 / rate, {});
    }
    return afloat.sea.hash();
  };
  struct Done {
    ActionValues values{};
    std::vector<ActionPress> presses;
  };
  const std::map<int, Action> pressed{{5, Action::board},    {20, Action::moor},     {200, Action::moor},
                                      {230, Action::anchor}, {400, Action::respawn}, {420, Action::anchor}};
  PathRecorder recorder;
  recorder.start(0.0, {}, 0.0, {rate});
  const auto by_hand = [&](int n) {
    Done done;
    if (const auto at = pressed.find(n); at != pressed.end()) done.presses.push_back({0.0, at->second, 1.0});
    done.values[std::size_t(Action::throttle)] = n > 30 ? 0.5 + 0.3 * std::sin(0.1 * n) : 0.0;
    done.values[std::size_t(Action::helm)] = n > 100 ? 0.4 : 0.0;
    recorder.sample(n / rate, {{0.01 * n, 0.0, 0.0}}, n / rate, {done.values, done.presses, {}});
    return done;
  };
  const std::uint64_t lived = live(by_hand);
  const CameraPath path = recorder.stop(frames / rate, {}, frames / rate, "lines");
  ASSERT_TRUE(path.actions);
  const CameraPath read = parse_camera_path(camera_path_text(path), "p.json");
  const InputTimeline timeline(*read.actions);
  const auto again = [&](bool all) {
    return live([&](int n) {
      Done done;
      done.values = timeline.values(n / rate);
      for (const ActionPress& press : timeline.presses(n == 0 ? -1.0 : (n - 1) / rate, n / rate))
        if (all || (press.action != Action::moor && press.action != Action::anchor)) done.presses.push_back(press);
      return done;
    });
  };
  EXPECT_EQ(again(true), lived);
  EXPECT_NE(again(false), lived);
}

// Lines are seen from the boat's bow to where they are made fast, piece by piece without gaps, and an anchor's chain to
// the ground; when cast off nothing of them is drawn. Placing them takes no memory. Controls seen: pieces
// turned the other way; the count of things left as it was.
TEST(CrewLines, AreSeen) {
  Afloat afloat(std::string(rib) + R"(, {"model": "pier", "at_m": [-4.5, 0, 0]})");
  SceneObjects& objects = afloat.scene.objects;
  const std::size_t things = objects.things.size();
  ASSERT_TRUE(add_line_things(objects, *afloat.bodies));
  EXPECT_FALSE(add_line_things(objects, *afloat.bodies)) << "once";
  ASSERT_TRUE(objects.lines);
  EXPECT_EQ(objects.lines->drawn, things);
  (void)afloat.press(Action::board, {0.0, 1.5, 1.0});
  ASSERT_EQ(afloat.press(Action::moor), "moored: R to pier");
  ASSERT_THAT(afloat.press(Action::anchor), HasSubstr("anchored"));
  afloat.run(2.0);
  place_lines(objects, *afloat.bodies, afloat.time);
  {
    const test::AllocationCounter counter;
    place_lines(objects, *afloat.bodies, afloat.time);
    EXPECT_EQ(counter.ours(), 0u);
  }
  const std::size_t lines = afloat.bodies->moorings().lines().size();
  ASSERT_EQ(objects.lines->drawn, things + lines * pieces_a_line);
  const Pose boat = afloat.bodies->pose_at(0, afloat.time);
  for (std::size_t n = 0; n < lines; ++n) {
    const Moorings::Line& line = afloat.bodies->moorings().lines()[n];
    const bool chain = line.kind == Moorings::Kind::anchor;
    glm::dvec3 end(0.0);
    const glm::dvec3 bow = boat.position_m + boat.orientation * line.is.from_m;
    for (std::size_t i = 0; i < pieces_a_line; ++i) {
      const SolidThing& thing = objects.things[things + n * pieces_a_line + i];
      EXPECT_EQ(thing.model, chain ? objects.lines->chain : objects.lines->rope);
      if (i == 0) {
        EXPECT_LT(glm::length(thing.pose.position_m - (chain ? line.is.to_m : bow)), 1e-6);
      } else {
        EXPECT_LT(glm::length(thing.pose.position_m - end), 1e-6) << i;
      }
      end = thing.pose.position_m + thing.scale * (thing.pose.orientation * glm::dvec3(0.0, 1.0, 0.0));
    }
    EXPECT_LT(glm::length(end - (chain ? bow : line.is.to_m)), 1e-6);
  }
  (void)afloat.press(Action::moor);
  (void)afloat.press(Action::anchor);
  place_lines(objects, *afloat.bodies, afloat.time);
  EXPECT_EQ(objects.lines->drawn, things);
}

}  // namespace
}  // namespace seascape
