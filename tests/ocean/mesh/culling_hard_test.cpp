// Culling against brute force: what any eye can see of a displaced patch is in the list. Hard cases 23, 39 and 40.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include "tests/ocean/mesh/lod_support.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {
using namespace lod_test;

std::tuple<int, int, int, unsigned> identity(const gpu::PatchInstance& p) {
  return {p.corner.x, p.corner.y, p.stride, p.flags};
}

struct Sight {
  int views = 0, patches = 0, culled = 0, missed = 0;  // missed: culled, yet brute force saw a point of it
};

using Random = std::mt19937;
double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Whether no eye can see any point of a box because all eight corners lie beyond one of its clip planes: true of few
// boxes that are seen nowhere, false of all that are seen anywhere, whatever culling thinks of them. Spares most of the
// points below.
bool beyond_a_plane(const std::vector<glm::dmat4>& clip, const glm::dvec3& low, const glm::dvec3& high) {
  for (const glm::dmat4& m : clip) {
    unsigned beyond_all = 31u;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec4 c =
          m * glm::dvec4(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z, 1.0);
      beyond_all &= (c.x > c.w ? 1u : 0u) | (c.x < -c.w ? 2u : 0u) | (c.y > c.w ? 4u : 0u) | (c.y < -c.w ? 8u : 0u) |
                    (c.w < 0.001 ? 16u : 0u);
    }
    if (beyond_all == 0u) return false;
  }
  return true;
}

// The patches of `all` that are not in `kept`, and whether any eye sees one of their points: 7 x 7 vertices (for strips
// all along the rows), displaced by up to `bounds` to a random side, then lowered by the Earth's curvature.
void look(const SurfaceSelection& all, const SurfaceSelection& kept, const Viewpoint& view,
          const DisplacementBounds& bounds, bool curved, Random& random, Sight& sight) {
  std::set<std::tuple<int, int, int, unsigned>> listed;
  for (const auto& p : kept.patches) listed.insert(identity(p));
  const glm::dvec3 origin(all.grid_origin_m.x, 0.0, all.grid_origin_m.y);
  std::vector<glm::dmat4> clip;
  for (const View& eye : view.eyes) clip.push_back(projection(eye.fov, 0.001) * eye_from_relative(eye.pose, origin));
  const glm::dvec2 viewer = glm::dvec2(view.viewer.position_m.x, view.viewer.position_m.z) - all.grid_origin_m;
  ++sight.views;
  for (const auto& p : all.patches) {
    ++sight.patches;
    if (listed.contains(identity(p))) continue;
    ++sight.culled;
    bool seen = false;
    if (!is_skirt(p)) {
      const glm::dvec2 low = glm::dvec2(p.corner) * all.unit_m - bounds.horizontal_m - 0.01;
      const glm::dvec2 high =
          glm::dvec2(p.corner + p.stride * gpu::patch_quads) * all.unit_m + bounds.horizontal_m + 0.01;
      const glm::dvec2 farthest = glm::max(glm::abs(low - viewer), glm::abs(high - viewer));
      const double drop =
          curved ? glm::dot(farthest, farthest) / (2.0 * static_cast<double>(gpu::earth_radius_m)) : 0.0;
      if (beyond_a_plane(clip, {low.x, -bounds.vertical_m - drop - 0.01, low.y},
                         {high.x, bounds.vertical_m + 0.01, high.y}))
        continue;
    }
    for (int a = 0; a <= 6 && !seen; ++a)
      for (int b = 0; b <= 6 && !seen; ++b) {
        const glm::dvec2 rest =
            glm::dvec2(gpu::patch_vertex(p, a * gpu::patch_quads / 6, b * gpu::patch_quads / 6, all.mesh)) * all.unit_m;
        const auto side = [&] { return (random() & 1u) != 0u ? 1.0 : -1.0; };
        const glm::dvec2 moved = rest + glm::dvec2(side(), side()) * bounds.horizontal_m;
        const glm::dvec2 away =
            ((random() & 1u) != 0u ? moved : rest) - viewer;  // whichever of the two the drawing takes
        const double drop = curved ? glm::dot(away, away) / (2.0 * static_cast<double>(gpu::earth_radius_m)) : 0.0;
        const glm::dvec4 point(moved.x, side() * bounds.vertical_m - drop, moved.y, 1.0);
        for (const glm::dmat4& m : clip) {
          const glm::dvec4 c = m * point;
          if (c.w > 0.001 && std::abs(c.x) <= c.w && std::abs(c.y) <= c.w) seen = true;
        }
      }
    sight.missed += seen ? 1 : 0;
  }
}

glm::dquat random_orientation(Random& random, int kind) {
  const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  const glm::dquat yaw = glm::angleAxis(uniform(random, -3.15, 3.15), y);
  const double quarter = glm::radians(90.0);
  switch (kind % 6) {
    case 0:
      return yaw * glm::angleAxis(-quarter, x);  // straight down
    case 1:
      return yaw * glm::angleAxis(quarter, x);  // straight up
    case 2:
      return yaw * glm::angleAxis((random() & 1u) != 0u ? quarter : -quarter, z);  // rolled
    case 3:
      return yaw * glm::angleAxis(uniform(random, -0.02, 0.02), x);  // grazing
    case 4:
      return yaw * glm::angleAxis(uniform(random, -1.5, 0.5), x);
    default:
      return glm::normalize(
          glm::dquat(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)));
  }
}

// `shrink` multiplies the bounds that culling is told, `only_left` hides the second eye from it: the planted faults.
Sight watch(int views, double shrink, bool only_left) {
  Random random(23);
  std::vector<Quadtree> trees, whole;
  std::vector<LodSettings> used;
  for (const Preset& preset : presets)
    for (const double size : {256.0, 1024.0, 4096.0}) {
      LodSettings s = settings_of(preset, size);
      s.cull_scale = 1.0;  // the tightest
      s.earth_curvature = trees.size() % 3 != 1;
      used.push_back(s);
      trees.emplace_back(s);
      whole.emplace_back(s);
    }
  Sight sight;
  for (int n = 0; n < views; ++n) {
    const std::size_t which = static_cast<std::size_t>(n) % trees.size();
    Viewpoint view;
    const double height = std::pow(10.0, uniform(random, -0.7, 4.3)) * (n % 17 == 3 ? -0.01 : 1.0);
    view.viewer = {{uniform(random, -1e4, 1e4), height, uniform(random, -1e4, 1e4)}, random_orientation(random, n)};
    const Fov fov{-uniform(random, 0.1, 2.0), uniform(random, 0.1, 2.0), uniform(random, 0.1, 1.5),
                  -uniform(random, 0.1, 1.5)};
    view.eyes = stereo_views(view.viewer, fov, uniform(random, 0.0, 0.08));
    if (n % 2 == 0) view.eyes[1].fov = {-fov.right, -fov.left, fov.up, fov.down};  // mirrored, as in a headset
    if (n % 5 == 0)
      view.eyes[1].pose.orientation =
          view.eyes[1].pose.orientation * glm::angleAxis(-0.4, glm::dvec3(0, 1, 0));  // canted
    const DisplacementBounds bounds{uniform(random, 0.0, 12.0), uniform(random, 0.0, 12.0)};
    Viewpoint told = view;
    if (only_left) told.eyes.resize(1);
    // The levels depend on the bounds, so the whole list is made from what culling was told.
    const DisplacementBounds told_bounds{bounds.vertical_m * shrink, bounds.horizontal_m * shrink};
    const SurfaceSelection& kept = trees[which].select(told, told_bounds);
    told.eyes.clear();
    look(whole[which].select(told, told_bounds), kept, view, bounds, used[which].earth_curvature, random, sight);
  }
  return sight;
}

// Hard case 23 and the 10,000 views: straight down, straight up, rolled, grazing, any; heights 0.2 m to 20 km and under
// water; asymmetric, mirrored and canted eyes. Controls: bounds that are too small and a forgotten eye, in the test
// below.
TEST(CullingHard, hard_23_down_up_rolled_never_drops_what_brute_force_sees) {
  constexpr int views = test::sanitized ? 500 : 10000;
  const Sight sight = watch(views, 1.0, false);
  EXPECT_EQ(sight.views, views);
  EXPECT_EQ(sight.missed, 0);
  EXPECT_GT(sight.culled, sight.patches / 3);  // and it does cull
}

// The controls: bounds half as large as the displacement, and an eye that culling does not know of.
TEST(CullingHard, BruteForceSeesShrunkenBoundsAndAForgottenEye) {
  constexpr int views = test::sanitized ? 200 : 2000;
  EXPECT_GT(watch(views, 0.5, false).missed, 0);
  EXPECT_GT(watch(views, 1.0, true).missed, 0);
}

// A box without size is a point: what single boxes are held against, in floats, says of it what doubles say, but for
// what floats lose. Controls seen: no spare room for that (points at the edge are dropped), the spare room a hundred
// times as large, the second eye's planes forgotten, the four first planes forgotten.
TEST(CullingHard, SingleBoxesAreSeenWhereOneEyeSeesThem) {
  Random random(41);
  EyeFrusta frusta;
  int inside = 0, outside = 0, dropped = 0, kept = 0;
  for (int n = 0; n < 1000; ++n) {
    const glm::dvec3 origin(uniform(random, -1e6, 1e6), 0.0, uniform(random, -1e6, 1e6));
    const Pose head{origin + glm::dvec3(uniform(random, -500.0, 500.0), uniform(random, -5.0, 300.0),
                                        uniform(random, -500.0, 500.0)),
                    random_orientation(random, n)};
    const Fov fov{-uniform(random, 0.1, 2.0), uniform(random, 0.1, 2.0), uniform(random, 0.1, 1.5),
                  -uniform(random, 0.1, 1.5)};
    const std::vector<View> eyes = stereo_views(head, fov, n % 3 == 0 ? 20.0 : 0.064);
    frusta.set(eyes, origin);
    for (int point = 0; point < 100; ++point) {
      // In an eye's own space, most of them within a hair's breadth of one of its planes.
      const View& eye = eyes[static_cast<std::size_t>(point % 2)];
      const double away = std::pow(10.0, uniform(random, -1.0, 3.0)),
                   hair = point % 3 == 0 ? 0.5 : std::pow(10.0, uniform(random, -7.0, -4.0));
      double x = uniform(random, eye.fov.left, eye.fov.right), y = uniform(random, eye.fov.down, eye.fov.up);
      if (point % 4 < 2)
        x = (point % 4 == 0 ? eye.fov.left : eye.fov.right) * (1.0 + uniform(random, -hair, hair));
      else
        y = (point % 4 == 2 ? eye.fov.down : eye.fov.up) * (1.0 + uniform(random, -hair, hair));
      const glm::dvec3 at = eye.pose.position_m - origin + eye.pose.orientation * (away * glm::dvec3(x, y, -1.0));
      // How far inside the nearest plane of the better eye, in metres.
      double most = -1e300;
      for (const View& of : eyes) {
        const glm::dvec3 p = glm::conjugate(of.pose.orientation) * (at - (of.pose.position_m - origin));
        const auto within = [&p](double rise, double along) {
          return (along - rise * p.z) / std::sqrt(1.0 + rise * rise);
        };
        most = std::max(most, std::min({within(of.fov.right, -p.x), within(-of.fov.left, p.x), within(of.fov.up, -p.y),
                                        within(-of.fov.down, p.y), -p.z}));
      }
      const bool seen = frusta.may_see({at.x, at.z, 0.0, 0.0, at.y, at.y});
      const double lost_m = 1e-5 * (glm::length(at) + glm::length(eye.pose.position_m - origin));
      if (most >= 0.0) ++inside;
      if (most < -lost_m) ++outside;
      if (most >= 0.0 && !seen) ++dropped;
      if (most < -lost_m && seen) ++kept;
    }
  }
  EXPECT_EQ(dropped, 0);
  EXPECT_EQ(kept, 0);
  EXPECT_GT(inside, 30000);
  EXPECT_GT(outside, 10000);
}

// An eye that looks through a keyhole at one vertex of the curved, still sea has that vertex's patch in its list. Near
// the horizon the sea has fallen away by many times the keyhole. Controls seen: no curvature in the bounds of nodes, or
// of strips; and in the test, culling told that the Earth is flat.
TEST(CullingHard, AKeyholeSeesTheCurvedSeaBehindIt) {
  const auto missed = [](bool told_curved, bool strips) {
    Random random(11);
    const DisplacementBounds bounds{0.5, 0.0};  // enough motion to split for, next to nothing beside the curve
    int count = 0;
    for (const Preset& preset : presets) {
      LodSettings settings = settings_of(preset, 8192.0);
      settings.cull_scale = 1.0;
      settings.earth_curvature = told_curved;
      Quadtree tree(settings), whole(settings);
      for (int n = 0; n < 1000; ++n) {
        Viewpoint view{{{uniform(random, -99, 99), std::pow(10.0, uniform(random, 0.0, 4.0)), uniform(random, -99, 99)},
                        {1, 0, 0, 0}},
                       {}};
        const SurfaceSelection& all = whole.select(view, bounds);
        const gpu::PatchInstance p = all.patches[random() % all.patches.size()];
        if (is_skirt(p) != strips) continue;
        constexpr int quads = gpu::patch_quads;
        const int i = static_cast<int>(random() % static_cast<unsigned>(quads));
        const int j = static_cast<int>(random() % static_cast<unsigned>(quads));
        const glm::dvec2 at = glm::dvec2(gpu::patch_vertex(p, i, j, all.mesh)) * all.unit_m + all.grid_origin_m -
                              glm::dvec2(view.viewer.position_m.x, view.viewer.position_m.z);
        const double drop = glm::dot(at, at) / (2.0 * static_cast<double>(gpu::earth_radius_m));
        const glm::dvec3 to = glm::normalize(glm::dvec3(at.x, -drop - view.viewer.position_m.y, at.y));
        view.viewer.orientation =
            glm::quatLookAt(to, std::abs(to.y) < 0.7 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0));
        view.eyes = {{view.viewer, {-1e-6, 1e-6, 1e-6, -1e-6}}};
        const SurfaceSelection& kept = tree.select(view, bounds);
        bool listed = false;
        for (const auto& k : kept.patches) listed = listed || identity(k) == identity(p);
        count += listed ? 0 : 1;
      }
    }
    return count;
  };
  EXPECT_EQ(missed(true, false), 0);
  EXPECT_EQ(missed(true, true), 0);
  EXPECT_GT(missed(false, false), 0);
  EXPECT_GT(missed(false, true), 0);
}

// Hard case 40: fields of view that do not hold the straight-ahead direction, an eye each to one side: culling drops
// nothing that either sees. Control, in the test: the frustum of one eye alone misses some.
TEST(CullingHard, hard_40_asymmetric_fov) {
  for (const Preset& preset : presets) {
    LodSettings settings = settings_of(preset, 1024.0);
    settings.cull_scale = 1.0;
    Quadtree tree(settings), whole(settings);
    Random random(40);
    Sight sight, forgotten;
    for (int n = 0; n < (test::sanitized ? 20 : 200); ++n) {
      Viewpoint view;
      view.viewer = {{uniform(random, -99, 99), 1.7, uniform(random, -99, 99)}, random_orientation(random, 3)};
      view.eyes = stereo_views(view.viewer, {-1.5, -0.2, 0.3, -0.9}, 0.064);
      view.eyes[1].fov = {0.2, 1.5, 0.9, -0.3};
      const SurfaceSelection& all = whole.select({view.viewer, {}}, {1.0, 1.0});
      look(all, tree.select(view, {1.0, 1.0}), view, {1.0, 1.0}, true, random, sight);
      Viewpoint one = view;
      one.eyes.resize(1);
      look(all, tree.select(one, {1.0, 1.0}), view, {1.0, 1.0}, true, random, forgotten);
    }
    EXPECT_EQ(sight.missed, 0) << preset.name;
    EXPECT_GT(sight.culled, 0) << preset.name;
    EXPECT_GT(forgotten.missed, 0) << preset.name;  // the control: the frustum of one eye alone
  }
}

// Hard case 39, for the list: two equal eyes select what one does; and an eye added never takes a patch away. Control,
// in the test: an eye that looks elsewhere adds some in 100 of 300 views and more.
TEST(CullingHard, hard_39_equal_eyes_select_what_one_does) {
  Quadtree mono{LodSettings{}}, stereo{LodSettings{}}, wide{LodSettings{}};
  Random random(39);
  int more = 0;
  for (int n = 0; n < 300; ++n) {
    const Pose head{{uniform(random, -99, 99), uniform(random, 0.2, 30.0), uniform(random, -99, 99)},
                    random_orientation(random, n)};
    const std::vector<View> eyes = stereo_views(head, {-1.2, 1.0, 1.0, -1.1}, 0.0);
    const SurfaceSelection& one = mono.select({head, {eyes[0]}}, {});
    const SurfaceSelection& two = stereo.select({head, eyes}, {});
    ASSERT_EQ(one.patches.size(), two.patches.size());
    for (std::size_t p = 0; p < one.patches.size(); ++p) ASSERT_EQ(identity(one.patches[p]), identity(two.patches[p]));
    View other = eyes[0];
    other.pose.orientation = random_orientation(random, 5);
    std::set<std::tuple<int, int, int, unsigned>> listed;
    for (const auto& p : wide.select({head, {eyes[0], other}}, {}).patches) listed.insert(identity(p));
    for (const auto& p : one.patches) ASSERT_TRUE(listed.contains(identity(p)));
    more += listed.size() > one.patches.size() ? 1 : 0;
  }
  EXPECT_GT(more, 100);  // the other eye does see more
}

// Many eyes in one walk select exactly what each selects alone, together: with as many as are asked about by and by,
// and with more. Controls seen: one eye that sees nothing of a node hides it from all; only the first eight asked.
TEST(CullingHard, ManyEyesSelectWhatEachSelectsAlone) {
  Random random(8);
  Quadtree together{LodSettings{}}, alone{LodSettings{}};
  for (int n = 0; n < 200; ++n) {
    const int eyes = std::array{1, 2, 3, 8, 9, 13}[static_cast<std::size_t>(n) % 6];
    Viewpoint view{
        {{uniform(random, -99, 99), std::pow(10.0, uniform(random, 0.0, 3.5)), uniform(random, -99, 99)}, {1, 0, 0, 0}},
        {}};
    std::set<std::tuple<int, int, int, unsigned>> each;
    for (int e = 0; e < eyes; ++e) {
      View eye{view.viewer,
               {-uniform(random, 0.1, 0.8), uniform(random, 0.1, 0.8), uniform(random, 0.1, 0.8),
                -uniform(random, 0.1, 0.8)}};
      eye.pose.orientation = random_orientation(random, n + e);
      view.eyes.push_back(eye);
      for (const auto& p : alone.select({view.viewer, {eye}}, {1.0, 1.0}).patches) each.insert(identity(p));
    }
    std::set<std::tuple<int, int, int, unsigned>> all;
    for (const auto& p : together.select(view, {1.0, 1.0}).patches) all.insert(identity(p));
    ASSERT_EQ(all, each) << eyes << " eyes";
  }
}

}  // namespace
}  // namespace seascape
