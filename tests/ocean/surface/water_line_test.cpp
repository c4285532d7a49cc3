// Where lines of sight are in water among pockets of air and portals, against sampling.
#include "ocean/surface/water_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace seascape {
namespace {

// One shape as plain geometry: a ball, a box or a prism of planes turned any way; or a sheet.
struct Plain {
  int form = 0, mode = 0;
  glm::dmat3 own{1.0};  // rows: its axes
  glm::dvec3 middle{0.0}, half{1.0};
  double level = -1e30;
  std::vector<glm::dvec4> planes;

  glm::dvec3 in_own(const glm::dvec3& at) const { return glm::transpose(own) * (at - middle); }
  // Convex along any line, below 0 within.
  double outside(const glm::dvec3& at) const {
    const glm::dvec3 o = in_own(at), q = glm::abs(o / half);
    if (form == gpu::shape_sphere) return glm::length(q) - 1.0;
    if (form == gpu::shape_box) return std::max({q.x, q.y, q.z}) - 1.0;
    double most = -1e9;
    for (const glm::dvec4& plane : planes) most = std::max(most, glm::dot(glm::dvec3(plane), o) - plane.w);
    return most;
  }
  bool holds(const glm::dvec3& at) const { return outside(at) < 0.0; }
  bool holds_air(const glm::dvec3& at) const { return at.y > level && holds(at); }
  // Whether the line from an eye to a place goes through a sheet from its front.
  bool sheet_before(const glm::dvec3& eye, const glm::dvec3& at) const {
    const glm::dvec3 a = in_own(eye), b = in_own(at);
    if (a.z <= 0.0 || b.z >= 0.0) return false;
    const glm::dvec3 on = (a + (a.z / (a.z - b.z)) * (b - a)) / half;
    return form == gpu::shape_disc ? std::hypot(on.x, on.y) < 1.0 : std::max(std::abs(on.x), std::abs(on.y)) < 1.0;
  }
  bool shows(const glm::dvec3& eye, const glm::dvec3& at) const {
    if (form >= gpu::shape_disc) return sheet_before(eye, at);
    if (mode == gpu::portal_fly_through) return holds(at);
    if (holds(eye)) return false;
    if (mode == gpu::portal_volume) return holds(at);
    double from = 0.0, to = 1.0;  // its deepest place on the way, behind its front
    for (int i = 0; i < 80; ++i) {
      const double third = (to - from) / 3.0;
      if (outside(eye + (from + third) * (at - eye)) < outside(eye + (to - third) * (at - eye)))
        to -= third;
      else
        from += third;
    }
    return holds(eye + from * (at - eye));
  }
  void describe(gpu::WaterShape& s, gpu::WaterShapes& all, int& number) const {
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 axis = own[i] / half[i];
      s.row[i] = glm::vec4(glm::dvec4(axis, -glm::dot(axis, middle)));
    }
    s.water = glm::vec4(float(level), 0.0f, 0.0f, 0.0f);
    s.middle = glm::vec4(glm::vec3(middle), 0.0f);
    s.form = {form, number, int(planes.size()), mode};
    for (const glm::dvec4& plane : planes) all.plane[number++] = glm::vec4(plane);
  }
};

class Chance {
 public:
  explicit Chance(std::uint32_t seed) : random_(seed) {}
  double from_to(double least, double most) { return least + (most - least) * (random_() / 4294967296.0); }
  int below(int count) { return int(from_to(0.0, count)); }
  glm::dvec3 within(double r) { return {from_to(-r, r), from_to(-r, r), from_to(-r, r)}; }
  glm::dvec3 direction() {
    glm::dvec3 d;
    do d = within(1.0);
    while (glm::length(d) > 1.0 || glm::length(d) < 0.1);
    return glm::normalize(d);
  }
  Plain shape(bool portal) {
    Plain s;
    const glm::dvec3 x = direction(), z = glm::normalize(glm::cross(x, direction()));
    s.own = glm::dmat3(x, glm::cross(z, x), z);
    s.middle = within(6.0);
    s.form = below(portal ? 5 : 3);
    s.mode = s.form >= gpu::shape_disc ? gpu::portal_front : below(3);
    s.half = s.form == gpu::shape_sphere ? glm::dvec3(from_to(0.5, 4.0))
             : s.form == gpu::shape_disc ? glm::dvec3(glm::dvec2(from_to(0.5, 4.0)), 1.0)
                                         : glm::dvec3(from_to(0.5, 4.0), from_to(0.5, 4.0), from_to(0.5, 4.0));
    if (s.form == gpu::shape_planes) {
      s.half = glm::dvec3(1.0);
      const int sides = 3 + below(4);
      for (int i = 0; i < sides; ++i) {
        const double a = 6.283185307 * i / sides;
        s.planes.push_back({std::cos(a), 0.0, std::sin(a), from_to(0.5, 3.0)});
      }
      s.planes.push_back({0.0, 1.0, 0.0, from_to(0.5, 3.0)});
      s.planes.push_back({0.0, -1.0, 0.0, from_to(0.5, 3.0)});
    }
    if (!portal && below(2) == 0) s.level = s.middle.y + from_to(-2.0, 2.0);
    return s;
  }

 private:
  std::mt19937 random_;
};

struct Scene {
  std::vector<Plain> air, portals;
  gpu::WaterShapes shapes{};
  Scene(Chance& chance, int most_air, int most_portals) {
    int planes = 0;
    for (int i = chance.below(most_air + 1); i > 0; --i) air.push_back(chance.shape(false));
    for (int i = chance.below(most_portals + 1); i > 0; --i) portals.push_back(chance.shape(true));
    for (std::size_t i = 0; i < air.size(); ++i) air[i].describe(shapes.air[i], shapes, planes);
    for (std::size_t i = 0; i < portals.size(); ++i) portals[i].describe(shapes.portal[i], shapes, planes);
  }
  WaterLines lines() const { return {shapes, int(air.size()), int(portals.size())}; }
  bool wet(const glm::dvec3& eye, const glm::dvec3& at) const {
    for (const Plain& pocket : air)
      if (pocket.holds_air(at)) return false;
    if (portals.empty()) return true;
    return std::any_of(portals.begin(), portals.end(), [&](const Plain& p) { return p.shows(eye, at); });
  }
};

bool in_parts(const std::vector<glm::dvec2>& parts, double t) {
  return std::any_of(parts.begin(), parts.end(), [&](const glm::dvec2& part) { return t >= part.x && t < part.y; });
}
double length_of(const std::vector<glm::dvec2>& parts) {
  double sum = 0.0;
  for (const glm::dvec2& part : parts) sum += part.y - part.x;
  return sum;
}

// 3,000 lines among up to eight pockets and three portals: each of 60 places of each is wet or dry as plain geometry
// has it, but within a centimetre of a side, where floats of the shapes decide. Controls seen: a pocket
// without its own level; a portal's volume for eyes within; one round of leaving spans.
TEST(WaterLine, IsWetWhereSamplesAre) {
  Chance chance(1);
  int wet = 0, dry = 0;
  for (int n = 0; n < 3000; ++n) {
    const Scene scene(chance, 8, n % 2 == 0 ? 0 : 3);
    const glm::dvec3 eye = chance.within(8.0), ray = chance.direction();
    const double way = chance.from_to(2.0, 30.0);
    const auto parts = scene.lines().wet_parts(eye, ray, way);
    for (std::size_t i = 1; i < parts.size(); ++i) ASSERT_GE(parts[i].x, parts[i - 1].y) << n;
    for (int i = 0; i < 60; ++i) {
      const double t = chance.from_to(0.0, way);
      if (std::any_of(parts.begin(), parts.end(),
                      [&](const glm::dvec2& p) { return std::abs(t - p.x) < 1e-2 || std::abs(t - p.y) < 1e-2; }))
        continue;
      const bool expected = scene.wet(eye, eye + t * ray);
      ASSERT_EQ(in_parts(parts, t), expected) << n << " at " << t;
      (expected ? wet : dry) += 1;
    }
  }
  EXPECT_GT(wet, 20000);
  EXPECT_GT(dry, 20000);
}

// The length in water is as many of 20,000 samples say, to the finest step. Control seen: gaps that begin
// before the line does taken for none.
TEST(WaterLine, SumsItsWetParts) {
  Chance chance(2);
  for (int n = 0; n < 40; ++n) {
    const Scene scene(chance, 8, 0);
    const glm::dvec3 eye = chance.within(8.0), ray = chance.direction();
    const double way = 30.0;
    constexpr int samples = 20000;
    int wet = 0;
    for (int i = 0; i < samples; ++i) wet += scene.wet(eye, eye + ((i + 0.5) * way / samples) * ray);
    const auto parts = scene.lines().wet_parts(eye, ray, way);
    EXPECT_NEAR(length_of(parts), wet * way / samples, 2.0 * (parts.size() + 1) * way / samples) << n;
  }
}

// What a line leaves of light is what its two halves leave, wherever it is split: T(a + b) = T(a) T(b), here by 1e-9,
// with pockets between and in volumes that are flown through. Control seen: a gap that begins before the line does
// taken for none.
TEST(WaterLine, SplitsAnywhere) {
  Chance chance(3);
  const double attenuation = 0.2;
  for (int n = 0; n < 2000; ++n) {
    Scene scene(chance, 8, 2);
    for (std::size_t i = 0; i < scene.portals.size(); ++i) {
      if (scene.portals[i].form >= gpu::shape_disc) scene.portals[i] = Plain{.half = glm::dvec3(5.0)};
      scene.portals[i].mode = gpu::portal_fly_through;
      int planes = gpu::most_shape_planes - 10;
      if (scene.portals[i].form != gpu::shape_planes)
        scene.portals[i].describe(scene.shapes.portal[i], scene.shapes, planes);
      scene.shapes.portal[i].form.w = gpu::portal_fly_through;
    }
    const glm::dvec3 eye = chance.within(8.0), ray = chance.direction();
    const double a = chance.from_to(0.0, 15.0), b = chance.from_to(0.0, 15.0);
    const auto left = [&](const glm::dvec3& from, double way) {
      return std::exp(-attenuation * length_of(scene.lines().wet_parts(from, ray, way)));
    };
    EXPECT_NEAR(left(eye, a + b), left(eye, a) * left(eye + a * ray, b), 1e-9) << n;
  }
}

// From 500 poses in a pocket: air all around as far as its side, in all directions, and water behind that.
// Control seen: a sphere of twice its radius.
TEST(WaterLine, PocketsAreDryFrom500Poses) {
  Chance chance(4);
  int poses = 0;
  while (poses < 500) {
    const Scene scene(chance, 1, 0);
    if (scene.air.empty()) continue;
    const Plain& pocket = scene.air.front();
    const glm::dvec3 eye = pocket.middle + chance.within(3.0);
    EXPECT_EQ(scene.lines().in_air(eye), pocket.holds_air(eye));
    if (!pocket.holds_air(eye)) continue;
    ++poses;
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 ray = chance.direction();
      double side = 0.0, beyond = 20.0;  // of the pocket, which is convex
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (side + beyond);
        (pocket.holds_air(eye + middle * ray) ? side : beyond) = middle;
      }
      const auto parts = scene.lines().wet_parts(eye, ray, 50.0);
      ASSERT_EQ(parts.size(), 1u);
      EXPECT_NEAR(parts.front().x, side, 1e-3);
      EXPECT_EQ(parts.front().y, 50.0);
    }
  }
}

// Hard case 37: a disc or a rectangle whose plane holds the eye, or passes before it by a hundredth of a millimetre or
// two, shows nothing along 10,000 lines across it. Control seen: its front from behind.
TEST(WaterLine, hard_37_a_portal_seen_edge_on_shows_nothing) {
  Chance chance(6);
  for (int n = 0; n < 10000; ++n) {
    gpu::WaterShapes shapes{};
    int planes = 0;
    Plain sheet = chance.shape(true);
    sheet.form = n % 2 == 0 ? gpu::shape_disc : gpu::shape_rectangle;
    sheet.mode = gpu::portal_front;
    sheet.planes.clear();
    sheet.half = {2.0, 2.0, 1.0};
    sheet.describe(shapes.portal[0], shapes, planes);
    const glm::dvec3 eye = sheet.middle + 5.0 * sheet.own[0] - 1e-5 * (n % 3) * sheet.own[2],
                     at = sheet.middle + chance.from_to(-2.0, 2.0) * sheet.own[1] + 1e-5 * sheet.own[2];
    EXPECT_TRUE((WaterLines{shapes, 0, 1}.wet_parts(eye, glm::normalize(at - eye), 100.0).empty())) << n;
  }
}

// Seen edge on, or from behind, a sheet shows nothing; from the front all that lies behind it. Two that overlap show
// what either does. Control seen: the sign of the front.
TEST(WaterLine, SheetsShowWaterFromTheirFront) {
  gpu::WaterShapes shapes{};
  int planes = 0;
  const Plain disc{.form = gpu::shape_disc, .half = {2.0, 2.0, 1.0}},
      rectangle{.form = gpu::shape_rectangle, .middle = {1.0, 0.0, -3.0}, .half = {2.0, 1.0, 1.0}};
  disc.describe(shapes.portal[0], shapes, planes);
  rectangle.describe(shapes.portal[1], shapes, planes);
  const WaterLines one{shapes, 0, 1}, both{shapes, 0, 2};
  using Parts = std::vector<glm::dvec2>;
  EXPECT_EQ(one.wet_parts({0, 0, 4}, {0, 0, -1}, 10), (Parts{{4, 10}}));
  EXPECT_EQ(one.wet_parts({0, 0, -4}, {0, 0, 1}, 10), Parts{});
  EXPECT_EQ(one.wet_parts({-5, 0, 0}, {1, 0, 0}, 10), Parts{});
  EXPECT_EQ(one.wet_parts({2.5, 0, 4}, {0, 0, -1}, 10), Parts{});
  EXPECT_EQ(both.wet_parts({2.5, 0, 4}, {0, 0, -1}, 10), (Parts{{7, 10}}));
  EXPECT_EQ(both.wet_parts({0, 0, 4}, {0, 0, -1}, 10), (Parts{{4, 10}}));
}

// In float, as shaders have it, a ball 400 radii off is met within a hundredth of its radius, and a box where it is in
// double. Control seen: the ball by the discriminant of the line's own beginning.
TEST(WaterLine, FloatsAreAsGood) {
  Chance chance(5);
  int met = 0;
  for (int n = 0; n < 5000; ++n) {
    const glm::dvec3 to = chance.within(0.5), d = chance.direction(), far = to - 400.0 * d, near = to - 3.0 * d;
    const glm::dvec2 ball = gpu::sphere_span(far, d), box = gpu::box_span(near, d);
    const glm::vec2 ball_f = gpu::sphere_span(glm::vec3(far), glm::vec3(d)),
                    box_f = gpu::box_span(glm::vec3(near), glm::vec3(d));
    EXPECT_LT(glm::length(glm::dvec2(ball_f) - ball), 1e-2) << n;
    EXPECT_LT(glm::length(glm::dvec2(box_f) - box), 1e-3) << n;
    met += ball.y > ball.x && box.y > box.x;
  }
  EXPECT_EQ(met, 5000);
}

}  // namespace
}  // namespace seascape
