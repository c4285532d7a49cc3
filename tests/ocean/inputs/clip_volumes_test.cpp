// Volumes without water: their distances and hulls against formulas, which of several decides, and patches of which
// nothing is left.
#include "ocean/inputs/clip_volumes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/expect_error.h"
#include "tests/support/wigley.h"

namespace seascape {
namespace {

using Form = VolumeInput::Form;

InputSpec volume(VolumeInput body, float value = 1.0f) {
  InputSpec spec;
  spec.to = InputTarget::clip;
  spec.blend = InputBlend::replace;
  spec.value = {value, 0.0f, 0.0f, 0.0f};
  spec.where = "s.json:7: inputs[2]";
  spec.shape = body;
  return spec;
}
InputSpec sphere(glm::dvec3 at, double radius, float value = 1.0f) {
  return volume({.form = Form::sphere, .at_m = at, .radius_m = radius}, value);
}
InputSpec hull(const std::shared_ptr<Model>& model) {
  InputSpec spec = volume({});
  ShapeInput shape;
  shape.file = "boat.glb", shape.model = model, shape.from = ShapeInput::From::hull;
  spec.shape = shape;
  return spec;
}

// A ship's own directions as a navigator has them: where its bow points, what is to starboard and what is up.
struct Ship {
  glm::dvec3 starboard, up, bow;
  Ship(double turn_deg, double pitch_deg, double roll_deg) {
    const double t = glm::radians(turn_deg), p = glm::radians(pitch_deg), r = glm::radians(roll_deg);
    bow = {std::sin(t) * std::cos(p), std::sin(p), -std::cos(t) * std::cos(p)};
    const glm::dvec3 level(std::cos(t), 0.0, std::sin(t)),
        upright(-std::sin(t) * std::sin(p), std::cos(p), std::cos(t) * std::sin(p));
    starboard = std::cos(r) * level - std::sin(r) * upright;
    up = std::cos(r) * upright + std::sin(r) * level;
  }
  glm::dvec3 own(glm::dvec3 from_middle) const {
    return {glm::dot(starboard, from_middle), glm::dot(up, from_middle), -glm::dot(bow, from_middle)};
  }
};

// How far from the nearest of very many points of a body's surface: (x, y, z) in its own axes. The truth knows no
// formula of a distance.
double found_distance(const VolumeInput& body, glm::dvec3 p) {
  const auto within_rounded = [&](glm::dvec3 core, double edge) {  // nearest place of the core, and from there the edge
    const glm::dvec3 nearest = glm::clamp(p, -core, core);
    const double off = glm::length(p - nearest);
    if (off > 0.0) return off - edge;
    double depth = 1e9;
    for (int i = 0; i < 3; ++i) depth = std::min(depth, core[i] - std::abs(p[i]));
    return -depth - edge;
  };
  switch (body.form) {
    case Form::sphere:
      return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z) - body.radius_m;
    case Form::box:
      return within_rounded(0.5 * body.size_m - body.round_m, body.round_m);
    case Form::capsule: {
      double least = 1e9;
      const double straight = 0.5 * body.length_m - body.radius_m;
      for (int i = 0; i <= 20000; ++i)
        least = std::min(least, glm::distance(p, {0.0, straight * (i / 10000.0 - 1.0), 0.0}));
      return least - body.radius_m;
    }
    default: {
      const double r = std::hypot(p.x, p.z), low = std::abs(p.y) - 0.5 * body.length_m, out = r - body.radius_m;
      if (low <= 0.0 && out <= 0.0) return std::max(low, out);
      if (low <= 0.0) return out;
      if (out <= 0.0) return low;
      return std::hypot(low, out);
    }
  }
}

// Controls seen: roll the other way round; pitch after turn; a box's edge not taken from its sides.
TEST(ClipVolumes, DistancesAreThoseOfTheBodies) {
  const VolumeInput bodies[] = {
      {.form = Form::sphere, .at_m = {3.25, -1.5, -7.75}, .radius_m = 2.5},
      {.form = Form::box,
       .at_m = {-30.5, 0.75, 11.25},
       .size_m = {4.0, 2.0, 9.0},
       .turn_deg = 25.0,
       .pitch_deg = -12.0,
       .roll_deg = 33.0},
      {.form = Form::box,
       .at_m = {5.0, 2.0, -3.0},
       .size_m = {4.0, 2.0, 9.0},
       .round_m = 0.4,
       .turn_deg = -70.0,
       .pitch_deg = 8.0,
       .roll_deg = -5.0},
      {.form = Form::capsule,
       .at_m = {100.5, -2.0, 40.0},
       .radius_m = 1.5,
       .length_m = 11.0,
       .turn_deg = 130.0,
       .pitch_deg = 90.0},
      {.form = Form::capsule,
       .at_m = {100.5, -2.0, 40.0},
       .radius_m = 1.5,
       .length_m = 11.0,
       .turn_deg = 40.0,
       .pitch_deg = 30.0,
       .roll_deg = 20.0},
      {.form = Form::cylinder,
       .at_m = {-8.0, 1.0, 60.0},
       .radius_m = 3.0,
       .length_m = 5.0,
       .turn_deg = 10.0,
       .pitch_deg = 35.0,
       .roll_deg = -50.0},
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-9.0, 9.0);
  for (const VolumeInput& body : bodies) {
    const ClipVolumes volumes(std::vector{volume(body)});
    const Ship ship(body.turn_deg, body.pitch_deg, body.roll_deg);
    double worst = 0.0;
    int within = 0;
    for (int i = 0; i < 400; ++i) {
      const glm::dvec3 from = (i % 2 == 0 ? 0.4 : 1.0) * glm::dvec3(off(random), off(random), off(random));
      const double want = found_distance(body, ship.own(from));
      worst = std::max(worst, std::abs(volumes.distance_m(0, body.at_m + from) - want));
      within += want < 0.0;
      if (std::abs(want) < 1e-4) continue;
      EXPECT_EQ(volumes.clipped(body.at_m + from, false), want < 0.0);
    }
    EXPECT_LT(worst, 1e-5) << int(body.form);
    EXPECT_GT(within, 10);
  }
}

// A boat heeled, trimmed, turned and made larger, told from what its formula says to within 3 cm everywhere and, but
// along its edges, 1 cm; the deck is dry where the hull is, and water over the deck shows. Controls seen: the map read
// half a texel off (48 of 40,000 places wrong by more than 1 cm, 15 by 3 cm); heights beyond the outline left at 0 (6
// and 2).
TEST(ClipVolumes, HullsHoldWhatTheirModelEncloses) {
  const test::Wigley form;
  InputSpec spec = hull(test::wigley_model(form));
  ShapeInput& shape = std::get<ShapeInput>(spec.shape);
  shape.at_m = {410.5, -77.25}, shape.at_height_m = 0.3, shape.turn_deg = 50.0, shape.pitch_deg = 4.0,
  shape.roll_deg = -12.0, shape.scale = 1.5;
  const ClipVolumes volumes(std::vector{spec});
  const Ship ship(50.0, 4.0, -12.0);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> off(-10.0, 10.0), up(-3.0, 3.0);
  int wrong_1cm = 0, wrong_3cm = 0, within = 0;
  for (int i = 0; i < 40000; ++i) {
    const glm::dvec3 from(off(random), up(random), off(random)), p = ship.own(from) / 1.5;
    const bool holds = form.holds(p.x, p.y, p.z), says = volumes.clipped(glm::dvec3(410.5, 0.3, -77.25) + from, false);
    within += holds;
    if (says == holds) continue;
    // Near the surface: somewhere about the place it is the other way.
    const auto near = [&](double by) {
      by /= 1.5;
      for (const glm::dvec3 way : {glm::dvec3(by, 0, 0), glm::dvec3(-by, 0, 0), glm::dvec3(0, by, 0),
                                   glm::dvec3(0, -by, 0), glm::dvec3(0, 0, by), glm::dvec3(0, 0, -by)})
        if (form.holds(p.x + way.x, p.y + way.y, p.z + way.z) != holds) return true;
      return false;
    };
    wrong_1cm += !near(0.01);
    wrong_3cm += !near(0.03);
  }
  EXPECT_GT(within, 800);
  EXPECT_LE(wrong_1cm, 4);
  EXPECT_EQ(wrong_3cm, 0);
}

// Of those that hold a point the last decides, over flat inputs too, and where none does flat inputs say. Control seen:
// the first decides.
TEST(ClipVolumes, TheLastThatHoldsAPointDecides) {
  InputSpec first = sphere({0.0, 0.0, 0.0}, 10.0), bubble = sphere({2.0, 0.0, 0.0}, 3.0, 0.0f),
            core = sphere({2.0, 0.0, 0.0}, 1.0);
  first.order = -1, core.order = 5;
  const ClipVolumes volumes(std::vector{core, bubble, first});
  for (const bool flat : {false, true}) {
    EXPECT_TRUE(volumes.clipped({-5.0, 0.0, 0.0}, flat));
    EXPECT_FALSE(volumes.clipped({4.0, 0.0, 0.0}, flat));
    EXPECT_TRUE(volumes.clipped({2.0, 0.5, 0.0}, flat));
    EXPECT_EQ(volumes.clipped({0.0, 10.5, 0.0}, flat), flat) << "above them";
    EXPECT_EQ(volumes.clipped({30.0, 0.0, 0.0}, flat), flat);
  }
}

// Bodies placed beside a scene's volumes and decide after them, as all of them asked one by one say; others placed
// later take their places. A copy shares the maps of hulls, those of the scene and those of bodies. Controls seen:
// bodies' nodes made with numbers of the volumes; nodes of earlier bodies left behind.
TEST(ClipVolumes, BodiesStandBesideTheVolumes) {
  const auto model = test::wigley_model({}), other = test::wigley_model({.length_m = 9.0});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(-40.0, 40.0), size(1.0, 6.0);
  std::vector<InputSpec> specs{hull(model)};
  for (int i = 0; i < 20; ++i)
    specs.push_back(sphere({along(random), 0.0, along(random)}, size(random), i % 3 ? 1.0f : 0.0f));
  const ClipVolumes scene(specs, {most_clip_bodies, {other, model}});
  ASSERT_EQ(scene.hulls().size(), 2u);
  ClipVolumes now = scene;
  EXPECT_EQ(&now.hulls(), &scene.hulls());
  for (const int count : {most_clip_bodies, 5, 0, 40}) {
    std::vector<ClipBody> bodies;
    for (int i = 0; i < count; ++i) {
      ClipBody& body = bodies.emplace_back();
      body.form = Form(i % 4);
      body.radius_m = size(random), body.length_m = 2.0 * body.radius_m + size(random);
      body.size_m = {size(random), size(random), size(random)};
      body.hull = i % 5 == 0 ? i % 2 : ClipBody::no_hull;
      body.at_m = {along(random), 0.2 * along(random), along(random)};
      body.orientation = glm::normalize(glm::dquat(along(random), along(random), along(random), along(random)));
      ASSERT_TRUE(now.takes(body)) << i;
    }
    now.place(bodies);
    ASSERT_EQ(now.size(), scene.size() + std::size_t(count));
    int by_bodies = 0;
    for (int i = 0; i < 4000; ++i) {
      const glm::dvec3 at(along(random), 0.1 * along(random), along(random));
      bool want = false;
      for (std::size_t n = 0; n < now.size(); ++n)
        if (now.distance_m(n, at) < 0.0) want = now.volumes()[n].offset.w > 0.5f;
      EXPECT_EQ(now.clipped(at, false), want);
      by_bodies += want && !scene.clipped(at, false);
    }
    EXPECT_EQ(by_bodies > 10, count > 0) << by_bodies;
  }
}

// A patch that is said to be clipped has no place with water, however that stands; and most of those that have none
// are. Controls seen: the waves' height left out; volumes that let the water be forgotten.
TEST(ClipVolumes, PatchesWithWaterAreNeverLeftOut) {
  const std::vector<InputSpec> specs{
      volume({.form = Form::box, .at_m = {0.0, 0.0, 0.0}, .size_m = {60.0, 6.0, 40.0}, .turn_deg = 20.0}),
      volume({.form = Form::cylinder, .at_m = {50.0, 0.0, -20.0}, .radius_m = 20.0, .length_m = 8.0, .pitch_deg = 5.0}),
      sphere({-6.0, 0.0, 4.0}, 5.0, 0.0f), hull(test::wigley_model({}))};
  const ClipVolumes volumes(specs);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-60.0, 80.0), size(0.3, 15.0), part(0.0, 1.0);
  for (const bool flat : {false, true})
    for (const double height : {0.0, 1.0, 2.9, 4.0}) {
      int said = 0, are = 0;
      for (int i = 0; i < 1500; ++i) {
        const glm::dvec2 least(at(random), at(random)), most = least + glm::dvec2(size(random), size(random));
        bool dry = true;
        for (int k = 0; k < 200 && dry; ++k) {
          const glm::dvec2 p = glm::mix(least, most, glm::dvec2(part(random), part(random)));
          dry = volumes.clipped(
              {p.x, k % 2 == 0 ? height * (k % 4 == 0 ? 1.0 : -1.0) : glm::mix(-height, height, part(random)), p.y},
              flat);
        }
        const bool says = volumes.clipped(least, most, height, flat);
        said += says, are += dry;
        EXPECT_TRUE(dry || !says) << least.x << ' ' << least.y << ' ' << most.x << ' ' << most.y << ' ' << height << ' '
                                  << flat;
      }
      EXPECT_GE(said, are * 2 / 3) << height << ' ' << flat;
      EXPECT_GT(said, flat || height < 3.0 ? 50 : -1) << height;
    }
  EXPECT_FALSE(volumes.clipped({1.0, 1.0}, {1.0, 2.0}, 0.0, true)) << "no size";
}

// Control seen: a deck left off taken for closed.
TEST(ClipVolumes, OpenAndEmptyModelsAreRefusedByName) {
  const std::string open = test::error_of([] { ClipVolumes(std::vector{hull(test::wigley_model({}, false))}); });
  EXPECT_EQ(
      open.rfind("s.json:7: inputs[2]: file: 'boat.glb' is not closed: 128 sides of triangles have nothing beside them",
                 0),
      0u)
      << open;
  auto plate = test::wigley_model({.draught_m = 1e-9, .freeboard_m = 1e-9});
  EXPECT_NE(test::error_of([&] { ClipVolumes(std::vector{hull(plate)}); }).find("'boat.glb' encloses nothing"),
            std::string::npos);
  EXPECT_NE(test::error_of([] { ClipVolumes(std::vector{hull(std::make_shared<Model>())}); }).find("encloses nothing"),
            std::string::npos);
}

}  // namespace
}  // namespace seascape
