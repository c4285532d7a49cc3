// Models seen from above: their areas, heights and colours, and edges that lie where the outline does.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "engine/gltf.h"
#include "ocean/inputs/inputs.h"
#include "tests/support/input_truth.h"

namespace seascape {
namespace {

using test::Flat;

// Two triangles for each quadrilateral, every corner a vertex of its own, as flat normals make them.
void quad(MeshPart& part, std::array<glm::vec3, 4> p) {
  for (const int i : {0, 1, 2, 0, 2, 3}) {
    part.indices.push_back(std::uint32_t(part.positions.size()));
    part.positions.push_back(p[std::size_t(i)]);
    part.normals.push_back({0.0f, 1.0f, 0.0f});
  }
}
InputSpec shape(InputTarget to, Model model) {
  InputSpec spec;
  spec.to = to;
  spec.where = "here";
  spec.value = {1.0f, 0.0f, 0.0f, 0.0f};
  ShapeInput input;
  input.file = "model.glb";
  input.model = std::make_shared<Model>(std::move(model));
  spec.shape = input;
  return spec;
}
// A fan about the origin, of which every triangle has its own vertices.
Model star(std::vector<Flat>* outline, bool down = false) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> radius(4.0f, 9.0f);
  std::vector<glm::vec3> rim;
  for (int i = 0; i < 30; ++i) {
    const float angle = float(i) * 2.0f * std::numbers::pi_v<float> / 30.0f, r = radius(random);
    rim.push_back({r * std::cos(angle), 2.0f + 0.1f * r, r * std::sin(angle)});
    if (outline != nullptr) outline->push_back({rim.back().x, rim.back().z});
  }
  MeshPart part;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const glm::vec3 corners[] = {{0.0f, 2.0f, 0.0f}, rim[i], rim[(i + 1) % rim.size()]};
    for (int k = 0; k < 3; ++k) {
      part.indices.push_back(std::uint32_t(part.positions.size()));
      part.positions.push_back(corners[down ? 2 - k : k]);
      part.normals.push_back({0.0f, 1.0f, 0.0f});
    }
  }
  Model model;
  model.parts.push_back(part);
  return model;
}
glm::vec4 at(const Inputs& inputs, double x, double z, double footprint = 0.0) {
  return inputs.value({x, z}, footprint, 0.0, glm::vec4(0.0f));
}

// Control: u + v <= 0.9 for 1 leaves 262 of 4,000 places out.
TEST(InputShapes, CoverWhatTheirOutlineHolds) {
  for (const bool down : {false, true}) {
    std::vector<Flat> outline;
    const Inputs inputs(InputTarget::level, std::vector{shape(InputTarget::level, star(&outline, down))});
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-10.0, 10.0);
    int wrong = 0;
    for (int i = 0; i < 4000; ++i) {
      const Flat p{place(random), place(random)};
      wrong += (at(inputs, p.x, p.z).x == 1.0f) != test::polygon_holds(outline, p);
    }
    EXPECT_EQ(wrong, 0);
  }
}

// The soft edge follows the outline, not the sides that triangles share. Control: without the welding of vertices that
// lie at one place the star falls to pieces, each with soft sides: the middle is 0.
TEST(InputShapes, AreSoftAtTheirOutlineAlone) {
  std::vector<Flat> outline;
  InputSpec spec = shape(InputTarget::level, star(&outline));
  spec.feather_m = 1.5;
  const Inputs inputs(InputTarget::level, std::vector{spec});
  double worst = 0.0;
  for (double x = -10.0; x < 10.0; x += 0.13)
    for (double z = -10.0; z < 10.0; z += 0.17) {
      double distance = 1e9;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Flat a = outline[i], b = outline[(i + 1) % outline.size()];
        const double u = std::clamp(((x - a.x) * (b.x - a.x) + (z - a.z) * (b.z - a.z)) /
                                        ((b.x - a.x) * (b.x - a.x) + (b.z - a.z) * (b.z - a.z)),
                                    0.0, 1.0);
        distance = std::min(distance, std::hypot(a.x + u * (b.x - a.x) - x, a.z + u * (b.z - a.z) - z));
      }
      worst = std::max(worst, std::abs(at(inputs, x, z).x -
                                       (test::polygon_holds(outline, {x, z}) ? test::smooth(distance / 1.5) : 0.0)));
    }
  EXPECT_LT(worst, 1e-5);
}

// What is summed over the plane is the area, at any footprint. Control: without disc_factor() several times as much
// with a footprint of 60 m.
TEST(InputShapes, CoverTheirAreaAtAnyFootprint) {
  std::vector<Flat> outline;
  const Inputs inputs(InputTarget::level, std::vector{shape(InputTarget::level, star(&outline))});
  for (const double footprint : {0.0, 0.5, 20.0, 60.0}) {
    const double step = footprint > 5.0 ? 0.5 : 0.05, reach = 10.0 + 0.5 * footprint;
    double sum = 0.0;
    for (double x = -reach + 0.5 * step; x < reach; x += step)
      for (double z = -reach + 0.5 * step; z < reach; z += step) sum += step * step * at(inputs, x, z, footprint).x;
    EXPECT_NEAR(sum / test::polygon_area(outline), 1.0, footprint > 5.0 ? 0.2 : 0.005) << footprint;
  }
}

// A slope is the plane through its corners, and of what lies one above the other the highest counts. Control: the
// lowest instead is 4 m below.
TEST(InputShapes, TheHighestPointCounts) {
  Model model;
  MeshPart part;
  quad(part, {{{-20.0f, 1.0f, -20.0f}, {20.0f, 1.0f, -20.0f}, {20.0f, 1.0f, 20.0f}, {-20.0f, 1.0f, 20.0f}}});
  quad(part, {{{-5.0f, 3.0f, -5.0f}, {5.0f, 4.0f, -5.0f}, {5.0f, 6.0f, 5.0f}, {-5.0f, 5.0f, 5.0f}}});
  model.parts.push_back(part);
  InputSpec spec = shape(InputTarget::sea_depth, model);
  spec.value = {-100.0f, 0.0f, 0.0f, 0.0f};
  std::get<ShapeInput>(spec.shape).from = ShapeInput::From::height;
  std::get<ShapeInput>(spec.shape).at_m = {1000.0, 500.0};
  std::get<ShapeInput>(spec.shape).scale = 2.0;
  const Inputs inputs(InputTarget::sea_depth, std::vector{spec});
  for (double x = -9.5; x < 10.0; x += 1.0)
    for (double z = -9.5; z < 10.0; z += 1.0)
      EXPECT_NEAR(at(inputs, 1000.0 + x, 500.0 + z).x, -100.0 + 2.0 * (4.5 + 0.05 * x + 0.1 * z), 1e-4);
  EXPECT_NEAR(at(inputs, 1030.0, 500.0).x, -98.0, 1e-5);
  EXPECT_EQ(at(inputs, 1041.0, 500.0).x, 0.0f);
}

// A closed hull is what it covers, once, with a soft edge at its sides and nowhere else. Control: sides shared by
// triangles of any facing give it no outline where they meet, and so no soft edge.
TEST(InputShapes, AHullIsItsSilhouette) {
  Model model;
  MeshPart part;
  // Widest at half its height: its sides slope up above, and down below.
  const auto ring = [](float x, float y, float z) {
    return std::array<glm::vec3, 4>{{{-x, y, -z}, {-x, y, z}, {x, y, z}, {x, y, -z}}};
  };
  const std::array<glm::vec3, 4> rings[] = {ring(2.0f, 1.0f, 1.0f), ring(3.0f, 0.0f, 2.0f), ring(1.5f, -1.0f, 1.2f)};
  quad(part, rings[0]);
  quad(part, {{rings[2][3], rings[2][2], rings[2][1], rings[2][0]}});
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      quad(part, {{rings[i][k], rings[i + 1][k], rings[i + 1][(k + 1) % 4], rings[i][(k + 1) % 4]}});
  model.parts.push_back(part);
  InputSpec spec = shape(InputTarget::clip, model);
  spec.feather_m = 1.0;
  const Inputs inputs(InputTarget::clip, std::vector{spec});
  for (double x = -4.05; x < 4.1; x += 0.1)
    for (double z = -3.05; z < 3.1; z += 0.1)
      EXPECT_NEAR(at(inputs, x, z).x, test::smooth(std::min(3.0 - std::abs(x), 2.0 - std::abs(z))), 1e-5)
          << x << " " << z;
}

TEST(InputShapes, AMaterialsColourLiesOverWhatIsThere) {
  Model model;
  MeshPart part;
  quad(part, {{{-1.0f, 0.0f, -1.0f}, {1.0f, 0.0f, -1.0f}, {1.0f, 0.0f, 1.0f}, {-1.0f, 0.0f, 1.0f}}});
  part.material = 0;
  model.parts.push_back(part);
  model.materials.push_back({.base_colour = {0.8f, 0.4f, 0.2f, 0.5f}});
  InputSpec spec = shape(InputTarget::albedo, model);
  spec.value = glm::vec4(0.0f);
  spec.blend = InputBlend::replace;
  std::get<ShapeInput>(spec.shape).from = ShapeInput::From::material;
  const Inputs inputs(InputTarget::albedo, std::vector{spec});
  const glm::vec4 over = inputs.value({0.0, 0.0}, 0.0, 0.0, {0.0f, 0.0f, 1.0f, 1.0f});
  EXPECT_NEAR(over.x, 0.4f, 1e-6f);
  EXPECT_NEAR(over.y, 0.2f, 1e-6f);
  EXPECT_NEAR(over.z, 0.6f, 1e-6f);
  EXPECT_NEAR(over.w, 1.0f, 1e-6f);
}

}  // namespace
}  // namespace seascape
