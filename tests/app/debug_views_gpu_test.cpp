// The debug views show what they say: wires on vertices, tints by level, normals of the mesh, slices of the tiles;
// freezing; counters.
#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/gpu/drawn_mesh.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"

namespace seascape {

namespace {

using test::DrawnMesh;
using test::light_at;
using test::pose;
using test::SeaShot;

class DebugViews : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  }
};

constexpr int width = 160, height = 120;
constexpr double time_s = 9.0;

SeaShot shot_of(const std::string& scene, const char* preset, const char* view) {
  return SeaShot({.scene = scene,
                  .preset = preset,
                  .width = width,
                  .height = height,
                  .probe = true,
                  .set = {{"debug.view", view}, {"waves.resolution", "64"}, {"water.glitter", "0"}, {"msaa", "1"}}});
}

Viewpoint looking(const Pose& p) { return {p, {{p, symmetric_fov(70.0, double(width) / height)}}}; }

// A pixel's linear light.
bool is_wire(const Image8& picture, int x, int y) {
  const glm::dvec3 c = light_at(picture, std::size_t(y) * width + std::size_t(x));
  return glm::length(c - glm::dvec3(0.9)) < 0.01;
}

// Where the picture shows a vertex, there is a wire; in the middle of large triangles there is none. Both frame shapes.
// Control seen: a pipeline that fills (every middle is painted).
TEST_F(DebugViews, WireframeDrawsTheMeshsEdges) {
  if (!test::device().facts().wireframe) GTEST_SKIP() << "this device draws no lines of polygons";
  for (const char* preset : {"low", "high"}) {
    SeaShot shot = shot_of("calm", preset, "wireframe");
    shot.set("lod.pixel_error", "8");  // triangles that have a middle
    const Viewpoint view = looking(pose({3.0, std::string(preset) == "low" ? 6.0 : 1.2, 5.0}, 20.0, -60.0));
    const Image8 picture = shot.picture(view, time_s);
    const DrawnMesh mesh(shot, view);
    const Fov& fov = view.eyes[0].fov;
    const auto place = [&](const glm::dvec3& at) {
      const glm::dvec3 s = mesh.seen(at);
      return s.z > 0.1 ? glm::dvec2((s.x - fov.left) / (fov.right - fov.left) * width,
                                    (fov.up - s.y) / (fov.up - fov.down) * height)
                       : glm::dvec2(-1e9);
    };
    const auto inside = [](const glm::dvec2& p) {
      return p.x > 3.0 && p.y > 3.0 && p.x < width - 3.0 && p.y < height - 3.0;
    };
    int vertices = 0, wired = 0, middles = 0, bare = 0;
    constexpr std::size_t side = gpu::patch_quads + 1;
    for (std::size_t v = 0; v + side + 1 < mesh.vertices().size(); ++v) {
      const glm::dvec2 p = place(mesh.vertices()[v].at);
      if (!inside(p)) continue;
      ++vertices;
      bool found = false;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) found = found || is_wire(picture, int(p.x) + dx, int(p.y) + dy);
      wired += found;
      if (v % side == side - 1 || v % (side * side) >= side * (side - 1)) continue;  // of a patch's last column or row
      const glm::dvec2 b = place(mesh.vertices()[v + 1].at), c = place(mesh.vertices()[v + side].at),
                       middle = (p + b + c) / 3.0;
      const double area = std::abs((b - p).x * (c - p).y - (b - p).y * (c - p).x);
      if (!inside(b) || !inside(c) || area < 60.0) continue;
      ++middles;
      bare += !is_wire(picture, int(middle.x), int(middle.y));
    }
    EXPECT_GT(vertices, 30) << preset;
    EXPECT_GE(wired, vertices * 97 / 100)
        << preset << " of " << vertices << ' ' << test::leave(picture, "debug_wireframe");
    EXPECT_GT(middles, 10) << preset;
    EXPECT_GE(bare, middles * 95 / 100) << preset << " of " << middles;
  }
}

// Each level has a tint of its own, neighbouring levels clearly different ones, the skirt none. Control seen: levels
// shifted by a bit too many (all in one tint).
TEST_F(DebugViews, LodTintsByLevel) {
  for (const char* preset : {"low", "high"}) {
    SeaShot shot = shot_of("open_sea", preset, "lod");
    shot.set("lod.ocean_size_m", "256");
    const Viewpoint view = looking(pose({3.0, 30.0, 5.0}, 20.0, -25.0));
    const Image8 picture = shot.picture(view, time_s);
    const DrawnMesh mesh(shot, view);
    const SurfaceSelection& s = *shot.experience().ocean().selection();
    struct Sum {
      glm::dvec2 mean{0.0}, square{0.0};
      int count = 0;
    };
    std::map<int, Sum> of_level;  // -1: the skirt
    const auto shown = mesh.shown(width, height);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (!shown[i].any || shown[i].depth > 2000.0) continue;  // farther haze is the picture
      const gpu::PatchInstance& p = s.patches[shown[i].patch];
      const glm::dvec3 light = light_at(picture, i);
      const double sum = light.x + light.y + light.z;
      if (sum < 0.05 || sum > 2.0) continue;  // sparks
      const glm::dvec2 tint(light.x / sum, light.y / sum);
      Sum& level = of_level[(p.flags & gpu::patch_skirt) != 0u ? -1 : int(gpu::patch_level(p.flags))];
      level.mean += tint;
      level.square += tint * tint;
      ++level.count;
    }
    for (auto& [level, sum] : of_level) {
      sum.mean /= sum.count;
      sum.square = sum.square / double(sum.count) - sum.mean * sum.mean;
    }
    ASSERT_TRUE(of_level.contains(-1));
    EXPECT_LT(glm::length(of_level[-1].mean - glm::dvec2(1.0 / 3.0)), 0.05) << preset << ": the skirt is grey";
    int levels = 0;
    for (const auto& [level, sum] : of_level) {
      if (level < 0 || sum.count < 100) continue;
      ++levels;
      EXPECT_LT(std::sqrt(sum.square.x + sum.square.y), 0.05)
          << preset << ", level " << level << ' ' << test::leave(picture, "debug_lod");
      if (of_level.contains(level + 1) && of_level[level + 1].count >= 100) {
        EXPECT_GT(glm::length(of_level[level + 1].mean - sum.mean), 0.1)
            << preset << ", levels " << level << " and one more";
      }
    }
    EXPECT_GE(levels, 2) << preset;
  }
}

// The colour is (normal + 1) / 2: exactly upwards over still water; and over waves as the mesh leans, by the points
// that neighbouring pixels show. Control seen: x and z changed about (no longer like the mesh).
TEST_F(DebugViews, NormalsAreTheSurfaces) {
  for (const char* preset : {"low", "high"}) {
    SeaShot shot = shot_of("storm", preset, "normals");
    const Viewpoint view = looking(pose({3.0, 25.0, 5.0}, 20.0, -50.0));
    const Image8 picture = shot.picture(view, time_s);
    const auto shown = DrawnMesh(shot, view).shown(width, height);
    double xx = 0.0, yy = 0.0, xy = 0.0;
    for (std::size_t i = 0; i + width * 2 < shown.size(); ++i) {
      if (i % width >= width - 2 || !shown[i].any || !shown[i + 2].any || !shown[i + width * 2].any) continue;
      const glm::dvec3 normal = glm::normalize(
          glm::cross(shown[i + width * 2].point.at - shown[i].point.at, shown[i + 2].point.at - shown[i].point.at));
      const glm::dvec3 painted = 2.0 * light_at(picture, i) - 1.0;
      EXPECT_NEAR(glm::length(painted), 1.0, 0.05);
      for (const int axis : {0, 2}) {
        xx += normal[axis] * normal[axis];
        yy += painted[axis] * painted[axis];
        xy += normal[axis] * painted[axis];
      }
    }
    EXPECT_GT(xy / std::sqrt(xx * yy), 0.5) << preset << ' ' << test::leave(picture, "debug_normals");
    shot.set("waves.change_s", "0");
    shot.set("waves.wind_speed_mps", "0");
    shot.set("waves.swell_height_m", "0");
    const Image8 still = shot.picture(view, time_s);
    EXPECT_EQ(test::count_colour(still, 187, 255, 187, 1), width * height) << preset;
  }
}

// The still water's level and the bed above it lean as their inputs do, along x and along z. Controls seen: either's
// slopes with x and z changed about, and with another sign.
TEST_F(DebugViews, NormalsLeanWithTheLevelAndTheLand) {
  for (const InputTarget kind : {InputTarget::level, InputTarget::sea_depth})
    for (const glm::dvec2 middle : {glm::dvec2(40.0, 0.0), glm::dvec2(0.0, 40.0), glm::dvec2(-25.0, 25.0)}) {
      InputSpec hill;
      hill.to = kind;
      hill.blend = InputBlend::replace;
      hill.value.x = kind == InputTarget::level ? -6.0f : 30.0f;
      hill.feather_m = 75.0;
      hill.shape = AreaInput{.round = true, .at_m = middle, .size_m = glm::dvec2(150.0)};
      const std::string effect = kind == InputTarget::level ? "level" : "sea_depth";
      SeaShot shot({.scene = "calm",
                    .preset = "high",
                    .width = 64,
                    .height = 48,
                    .set = {{"waves.wind_speed_mps", "0"}, {"waves.depth_m", "2"}, {"debug.view", "normals"}},
                    .effects = {{"waves", effect}},
                    .inputs = {hill}});
      const Image8 picture = shot.picture(pose({0.0, 60.0, 0.0}, 0.0, -90.0), time_s);
      const Inputs inputs(kind, std::span(&hill, 1));
      const glm::vec4 none(kind == InputTarget::level ? 0.0f : -2.0f, 0.0f, 0.0f, 0.0f);
      const auto rise = [&](glm::dvec2 way) {
        return double(inputs.value(way, 0.0, 0.0, none).x - inputs.value(-way, 0.0, 0.0, none).x);
      };
      const glm::dvec3 normal = glm::normalize(glm::dvec3(-rise({0.5, 0.0}), 1.0, -rise({0.0, 0.5}))),
                       painted = 2.0 * light_at(picture, 24 * 64 + 32) - 1.0;
      EXPECT_GT(glm::length(glm::dvec2(normal.x, normal.z)), 0.1);
      EXPECT_LT(glm::distance(painted, normal), 0.03) << effect << " at " << middle.x << ", " << middle.y;
    }
}

// Squares of 16 m, in stripes along z one of each cascade's tile: what lies 16 m to the north is the same, what lies 16
// m to the east, another cascade's, is not; on still water all is middle grey. Control seen: squares of 15 m.
TEST_F(DebugViews, SlicesRepeatEverySixteenMetres) {
  SeaShot shot = shot_of("storm", "low", "slices");
  const Viewpoint view = looking(pose({40.0, 60.0, 40.0}, 0.0, -90.0));
  const Image8 picture = shot.picture(view, time_s);
  const auto shown = DrawnMesh(shot, view).shown(width, height);
  // By rest position, to a quarter of a metre: x east, z south.
  std::map<std::pair<int, int>, glm::dvec3> at;
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (shown[i].any)
      at[{int(std::floor(shown[i].point.rest.x * 2.0)), int(std::floor(shown[i].point.rest.y * 2.0))}] =
          light_at(picture, i);
  double north = 0.0, east = 0.0, spread = 0.0;
  int norths = 0, easts = 0;
  for (const auto& [cell, light] : at) {
    spread = std::max(spread, glm::length(light - glm::dvec3(0.5)));
    if (const auto other = at.find({cell.first, cell.second + 32}); other != at.end())
      north += glm::length(light - other->second), ++norths;
    if (const auto other = at.find({cell.first + 32, cell.second}); other != at.end())
      east += glm::length(light - other->second), ++easts;
  }
  ASSERT_GT(norths, 500);
  ASSERT_GT(easts, 500);
  EXPECT_GT(spread, 0.04) << test::leave(picture, "debug_slices");
  EXPECT_LT(north / norths, 0.6 * east / easts) << north / norths << ' ' << east / easts;
  shot.set("waves.change_s", "0");
  shot.set("waves.wind_speed_mps", "0");
  shot.set("waves.swell_height_m", "0");
  EXPECT_EQ(test::count_colour(shot.picture(view, time_s), 187, 187, 187, 1), width * height);
}

// Frozen, the vertices stay where they are in the world while the camera goes elsewhere. Control: thawed, they follow.
TEST_F(DebugViews, FreezeKeepsTheMesh) {
  SeaShot shot = shot_of("open_sea", "low", "lod");
  const Viewpoint first = looking(pose({3.0, 4.0, 5.0}, 20.0, -20.0)),
                  later = looking(pose({43.0, 24.0, -35.0}, 200.0, -60.0));
  const auto rests = [&](const Viewpoint& view) {
    (void)shot.picture(view, time_s);
    std::vector<glm::dvec2> result;
    const DrawnMesh mesh(shot, view);
    for (const test::SurfacePoint& p : mesh.vertices()) result.push_back(p.rest);
    return result;
  };
  const auto before = rests(first);
  shot.set("debug.freeze", "true");
  const auto frozen = rests(later);
  ASSERT_EQ(frozen.size(), before.size());
  double most = 0.0;
  for (std::size_t i = 0; i < frozen.size(); ++i)
    most = std::max(most, glm::length(frozen[i] - before[i]) / (1.0 + glm::length(before[i] - glm::dvec2(3.0, 5.0))));
  EXPECT_LT(most, 1e-5);
  shot.set("debug.freeze", "false");
  EXPECT_NE(rests(later), before);
}

// The counters count what is drawn: two triangles a quad of every patch, and the sky's one; with tone mapping one more.
// Control: a patch less.
TEST_F(DebugViews, CountersCountTriangles) {
  for (const char* preset : {"low", "high"}) {
    SeaShot shot = shot_of("open_sea", preset, "lod");
    const Pose head = pose({3.0, 4.0, 5.0}, 20.0, -20.0);
    shot.draw(head, time_s);
    const std::uint64_t patches = shot.experience().ocean().selection()->patches.size(),
                        each = 2u * gpu::patch_quads * gpu::patch_quads;
    const std::uint64_t screens = shot.experience().in_tile() ? 1u : 2u;
    EXPECT_EQ(shot.counts().triangles, patches * each + screens) << preset;
    shot.set("debug.drop_patch", "0");
    shot.draw(head, time_s);
    EXPECT_EQ(shot.counts().triangles, (patches - 1) * each + screens) << preset;
  }
}

}  // namespace

}  // namespace seascape
