// Boats that are steered round a course, and the harbour's traffic.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/boats/crew.h"
#include "app/boats/scene_bodies.h"
#include "app/sea_spec.h"
#include "engine/error.h"
#include "ocean/sea/sea.h"

namespace seascape {
namespace {

glm::dvec2 flat(const glm::dvec3& at) { return {at.x, at.z}; }

double off_leg(const glm::dvec2& at, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 way = b - a;
  const double t = std::clamp(glm::dot(at - a, way) / glm::dot(way, way), 0.0, 1.0);
  return glm::distance(at, a + t * way);
}

Scene square(const std::string& model, double side_m, const std::string& more) {
  const std::string s = std::to_string(side_m);
  return parse_scene(
      R"({"version": 1, "effects": ["models", "boats"], "waves": {"wind_speed_mps": 0}, "objects": [
      {"model": ")" +
          model + R"(", "name": "B", "at_m": [0, 0, 10], "float": {)" + more + R"(, "course_m": [[0, -)" + s + "], [" +
          s + ", -" + s + "], [" + s + R"(, 0], [0, 0]]}}]})",
      "s.json", "low");
}

// Round a square a boat under engine, one with an outboard and one that is rowed keep within three lengths of
// its sides, and come to each corner in turn. Once somebody has boarded her she keeps to it no more, and put back she
// does again. Controls seen: the helm to the other side; the oars' sides changed; a helmsman who never lets
// go.
TEST(Course, IsKept) {
  const struct {
    const char* model;
    double side_m, length_m, seconds;
    const char* more;
  } boats[] = {{"fishing_boat", 60.0, 12.0, 105.0, R"("throttle": 0.6)"},
               {"rib", 36.0, 7.3, 70.0, R"("throttle": 0.33)"},
               {"rowing_boat", 14.0, 3.2, 70.0, R"("throttle": 0.8)"}};
  for (const auto& one : boats) {
    const Scene scene = square(one.model, one.side_m, one.more);
    Sea sea(sea_spec(scene));
    const auto bodies = scene_bodies(scene);
    sea.add(bodies);
    sea.advance(0.0, {});
    const double s = one.side_m;
    const glm::dvec2 corners[] = {{0.0, -s}, {s, -s}, {s, 0.0}, {0.0, 0.0}};
    std::size_t reached = 0;
    double most_off = 0.0, time = 0.0;
    for (int n = 0; n < int(one.seconds * 60.0); ++n) {
      sea.advance(time += 1.0 / 60.0, {});
      const glm::dvec2 at = flat(bodies->bodies().result()[0].at_m);
      if (reached < 4 && glm::distance(at, corners[reached]) < 2.5 * one.length_m) ++reached;
      double off = off_leg(at, {0.0, 10.0}, corners[0]);
      for (std::size_t c = 0; c < 4; ++c) off = std::min(off, off_leg(at, corners[c], corners[(c + 1) % 4]));
      most_off = std::max(most_off, off);
    }
    EXPECT_EQ(reached, 4u) << one.model << " after " << one.seconds << " s at " << bodies->bodies().result()[0].at_m.x
                           << " " << bodies->bodies().result()[0].at_m.z;
    EXPECT_LT(most_off, 3.0 * one.length_m) << one.model;

    bodies->ask(0, {});
    sea.advance(time += 0.1, {});
    EXPECT_EQ(bodies->boat(0).asked().throttle, 0.0);
    bodies->put_back(0);
    sea.advance(time += 0.1, {});
    EXPECT_NE(bodies->boat(0).asked().throttle + bodies->boat(0).asked().oar_left, 0.0) << one.model;
  }
}

// A course of one place is refused, with the key and what to write. Controls seen: the least number left
// out.
TEST(Course, FaultsAreNamed) {
  try {
    (void)parse_scene(
        R"({"version": 1, "effects": ["waves", "models", "boats"], "objects": [{"model": "rib", "at_m": [0, 0, 0], "float": {"course_m": [[1, 2]]}}]})",
        "s.json", "low");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("course_m"));
    EXPECT_THAT(error.what(), testing::HasSubstr("2 to 64"));
  }
}

// As long as the harbour's path its traffic is under way, makes waves, and runs into nothing: neither piers nor moored
// boats nor the ground. Control seen: a course across the yacht's, which runs into her.
TEST(Course, TheHarboursTrafficKeepsClear) {
  const Scene scene = load_scene("harbour", "low");
  Sea sea(sea_spec(scene));
  const auto bodies = scene_bodies(scene);
  sea.add(bodies);
  sea.advance(0.0, {});
  std::vector<std::size_t> under_way;
  for (std::size_t n = 0; n < bodies->size(); ++n)
    if (bodies->bodies().spec(n).name.ends_with("under way")) under_way.push_back(n);
  ASSERT_EQ(under_way.size(), 2u);
  std::vector<double> sailed(bodies->size(), 0.0);
  double time = 0.0;
  for (int n = 0; n < 60 * 34; ++n) {
    sea.advance(time += 1.0 / 60.0, {});
    for (const std::size_t body : under_way) sailed[body] += glm::length(flat(bodies->velocity_mps(body))) / 60.0;
    for (const BodyEvent& event : bodies->take_events())
      if (bodies->bodies().spec(event.body).name.ends_with("under way")) {
        EXPECT_TRUE(event.kind != BodyEventKind::hit && event.kind != BodyEventKind::ground)
            << bodies->bodies().spec(event.body).name << ": " << name_of(event.kind) << " at " << event.time_s << " s";
      }
  }
  ASSERT_NE(sea.wakes(), nullptr);
  for (const std::size_t body : under_way) {
    EXPECT_GT(sailed[body], 1.6 * 34.0) << bodies->bodies().spec(body).name;
    EXPECT_LT(sailed[body], 3.6 * 34.0) << bodies->bodies().spec(body).name;
    bool waves = false;
    for (int window = 0; window < WakeWindows::most; ++window) waves = waves || sea.wakes()->body(window) == body + 1;
    EXPECT_TRUE(waves) << bodies->bodies().spec(body).name;
  }
}

}  // namespace
}  // namespace seascape
