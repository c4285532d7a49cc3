// What is small, bright or thin is looked for where it must be: the sun's disc, its glitter, the waterline. Where that
// is comes from plain double precision. (The horizon's line: tests/ocean/horizon_gpu_test.cpp. No moon is drawn.)
#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/multiview_check.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/gpu/solid_shot.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;
using Set = std::vector<std::pair<std::string, std::string>>;

class ThinThings : public test::GpuTest {};

constexpr int width = 160, height = 120;
constexpr double pi = 3.14159265358979323846, degree = pi / 180.0;

// Every way that light comes to the picture.
struct Way {
  const char *msaa, *shape, *lighting;
  bool per_eye;
};
constexpr Way ways[] = {{"4", "tile", "forward", false},
                        {"1", "desktop", "forward", true},
                        {"1", "tile", "deferred", false},
                        {"1", "desktop", "deferred", true}};

SeaShot shot_of(const Way& way, Set set, std::vector<std::string> effects = {"waves"},
                const std::vector<InputSpec>& inputs = {}) {
  set.insert(set.end(), {{"msaa", way.msaa}, {"frame.shape", way.shape}, {"frame.lighting", way.lighting}});
  return SeaShot({.scene = "calm",
                  .preset = "medium",
                  .width = width,
                  .height = height,
                  .views = 2,
                  .per_eye = way.per_eye || !multiview_works(test::device(), test::shaders()),
                  .set = std::move(set),
                  .effects = std::move(effects),
                  .inputs = inputs});
}
const Set still{{"waves.wind_speed_mps", "0"}, {"waves.swell_height_m", "0"}, {"waves.resolution", "16"}};

std::string named(const Way& way) {
  return std::string(way.msaa) + " " + way.shape + " " + way.lighting + (way.per_eye ? " per eye" : " together");
}

// Two eyes apart, with fields of view that are neither symmetric nor alike.
Viewpoint eyes_of(const Pose& head, double half_deg, double apart_m) {
  const double up = std::tan(half_deg * degree), side = up * width / height;
  std::vector<View> eyes = stereo_views(head, {}, apart_m);
  eyes[0].fov = {-1.1 * side, 0.9 * side, 1.1 * up, -0.9 * up};
  eyes[1].fov = {-0.9 * side, 1.1 * side, 0.9 * up, -1.1 * up};
  return {head, eyes, pixels_per_radian(eyes, height)};
}

// The unit direction in which a place of the picture lies, in pixels from its upper left corner.
glm::dvec3 ray(const View& eye, double x, double y) { return test::pixel_ray(eye, x, y, width, height); }
double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}
// Towards what stands `up` degrees above the horizon, `to` degrees clockwise from -z seen from above.
glm::dvec3 towards(double to_deg, double up_deg) {
  return {std::sin(to_deg * degree) * std::cos(up_deg * degree), std::sin(up_deg * degree),
          -std::cos(to_deg * degree) * std::cos(up_deg * degree)};
}

// The pixels that are at least half as bright as the brightest: the middle of their light, and how many there are.
struct Bright {
  double x = 0.0, y = 0.0, most = 0.0;
  int pixels = 0;
};
Bright brightest(const Image8& picture) {
  Bright found;
  for (std::size_t i = 0; i < std::size_t(width * height); ++i)
    found.most = std::max(found.most, test::light_at(picture, i).y);
  double sum = 0.0;
  for (int i = 0; i < width * height; ++i) {
    const double light = test::light_at(picture, std::size_t(i)).y;
    if (light < 0.5 * found.most) continue;
    sum += light, found.x += light * (i % width + 0.5), found.y += light * (i / width + 0.5);
    ++found.pixels;
  }
  found.x /= sum, found.y /= sum;
  return found;
}

// With so little exposure that nothing else is bright. Its middle within 0.05 degrees, which is half a pixel; its size,
// of 0.267 degrees half across, within a fifth. Controls seen: the disc a degree off, none at all (the planted faults
// sun_disc_off and sun_disc_gone), and the sun itself a degree off.
TEST_F(ThinThings, TheSunsDiscIsWhereTheSunStands) {
  for (const Way& way : ways) {
    SeaShot shot = shot_of(way, {{"sky.exposure_ev", "-8"}});
    for (const glm::dvec2 sun : {glm::dvec2(320.0, 32.0), glm::dvec2(15.0, 9.0), glm::dvec2(110.0, 70.0)}) {
      shot.set("sky.sun_to_deg", std::to_string(sun.x));
      shot.set("sky.sun_elevation_deg", std::to_string(sun.y));
      const Viewpoint view = eyes_of(pose({3.0, 4.0, -5.0}, sun.x + 2.0, sun.y - 1.5, 20.0), 5.0, 2.0);
      const auto pictures = shot.pictures(view, 10.0);
      for (std::size_t eye = 0; eye < 2; ++eye) {
        const std::string what = named(way) + ", sun " + std::to_string(sun.x) + ", eye " + std::to_string(eye) + " ";
        const Bright disc = brightest(pictures[eye]);
        EXPECT_GT(disc.most, 0.5) << what << test::leave(pictures[eye], "sun");
        EXPECT_LT(angle_deg(ray(view.eyes[eye], disc.x, disc.y), towards(sun.x, sun.y)), 0.05)
            << what << test::leave(pictures[eye], "sun");
        const double pixel_deg = 10.0 / height, area = disc.pixels * pixel_deg * pixel_deg;
        EXPECT_NEAR(std::sqrt(area / pi), 0.267, 0.05) << what << test::leave(pictures[eye], "sun");
      }
    }
  }
}

// On still water it is the sun's mirror image, wherever an eye stands: within a tenth of a degree, and within the
// slopes that its spread allows, six deviations of which are dark, and one bright. Controls seen: light to the head
// instead of the eye (the planted fault light_from_head), and a sun a degree off for the water alone (glitter_off).
TEST_F(ThinThings, GlitterOnStillWaterIsTheSunsMirrorImage) {
  constexpr double spread = 0.0028284;  // of slopes: the sun's disc, and the least that is drawn
  for (const Way& way : ways) {
    Set set = still;
    set.emplace_back("sky.exposure_ev", "-8");
    SeaShot shot = shot_of(way, set);
    for (const glm::dvec2 sun : {glm::dvec2(200.0, 30.0), glm::dvec2(75.0, 55.0)}) {
      shot.set("sky.sun_to_deg", std::to_string(sun.x));
      shot.set("sky.sun_elevation_deg", std::to_string(sun.y));
      const glm::dvec3 l = towards(sun.x, sun.y);
      const Viewpoint view = eyes_of(pose({3.0, 3.0, -5.0}, sun.x + 1.0, -sun.y + 1.0, -15.0), 5.0, 2.0);
      const auto pictures = shot.pictures(view, 10.0);
      for (std::size_t eye = 0; eye < 2; ++eye) {
        const std::string what = named(way) + ", sun " + std::to_string(sun.x) + ", eye " + std::to_string(eye) + " ";
        const Bright image = brightest(pictures[eye]);
        EXPECT_GT(image.most, 0.2) << what;
        EXPECT_LT(angle_deg(ray(view.eyes[eye], image.x, image.y), towards(sun.x, -sun.y)), 0.1)
            << what << test::leave(pictures[eye], "glitter_still");
        int wrong = 0, within = 0;
        for (int i = 0; i < width * height; ++i) {
          const glm::dvec3 half = glm::normalize(l - ray(view.eyes[eye], i % width + 0.5, i / width + 0.5));
          const double slope = std::hypot(half.x, half.z) / half.y / spread;
          const double light = test::light_at(pictures[eye], std::size_t(i)).y / image.most;
          wrong += slope < 1.0 ? light < 0.4 : slope > 6.0 ? light > 0.05 : 0;
          within += slope < 1.0;
        }
        EXPECT_GT(within, 10) << what;
        EXPECT_EQ(wrong, 0) << what << test::leave(pictures[eye], "glitter_still");
      }
    }
  }
}

// On a rough sea, seen from so high that a pixel holds all its waves, glitter fills the slopes that the waves have
// (Cox and Munk 1954): bright within one deviation of the mirror's direction, gone beyond four and a half.
TEST_F(ThinThings, GlitterOnARoughSeaEndsWhereItsSlopesDo) {
  const glm::dvec2 sun(60.0, 55.0);
  SeaShot shot = shot_of(ways[0], {{"waves.wind_speed_mps", "3"},
                                   {"waves.wind_to_deg", "60"},
                                   {"waves.swell_height_m", "0"},
                                   {"sky.exposure_ev", "-2"},
                                   {"sky.sun_to_deg", "60"},
                                   {"sky.sun_elevation_deg", "55"}});
  const glm::dvec3 l = towards(sun.x, sun.y);
  const Viewpoint view = eyes_of(pose({0.0, 600.0, 0.0}, sun.x + 8.0, -sun.y + 5.0, 10.0), 40.0, 30.0);
  const auto with = shot.pictures(view, 10.0);
  shot.set("water.glitter", "0");
  const auto without = shot.pictures(view, 10.0);
  const SeaStatistics all = WaveField(shot.scene().settings.sea, shot.scene().settings.waves).statistics();
  const glm::dvec3 m = all.slope_moments + all.tail_slope_moments;
  const double determinant = m.x * m.y - m.z * m.z;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    double inner = 0.0, outer = 0.0, aside = 0.0, sum = 0.0;
    int inner_pixels = 0, outer_pixels = 0;
    for (int i = 0; i < width * height; ++i) {
      const glm::dvec3 way = ray(view.eyes[eye], i % width + 0.5, i / width + 0.5);
      if (way.y > -0.2) continue;
      const glm::dvec3 half = glm::normalize(l - way);
      const double x = half.x / half.y, z = half.z / half.y;
      const double q = (m.y * x * x - 2.0 * m.z * x * z + m.x * z * z) / determinant;
      const double light = test::light_at(with[eye], std::size_t(i)).y - test::light_at(without[eye], std::size_t(i)).y;
      if (q < 1.0) inner += light, ++inner_pixels;
      if (q > 20.0) outer += light, ++outer_pixels;
      // In the middle of the patch: how far it lies beside the sun's azimuth.
      if (q < 6.0) {
        aside += light * (std::atan2(way.x, -way.z) / degree - sun.x);
        sum += light;
      }
    }
    EXPECT_GT(inner_pixels, 200);
    EXPECT_GT(outer_pixels, 200);
    EXPECT_GT(inner / inner_pixels, 0.1) << test::leave(with[eye], "glitter_rough");
    EXPECT_LT(outer / outer_pixels, 0.01 * inner / inner_pixels) << test::leave(with[eye], "glitter_rough");
    EXPECT_LT(std::abs(aside / sum), 1.0) << test::leave(with[eye], "glitter_rough");
  }
}

// A bank rises through still water as steep as a wall. What another water's colour changes is water, what it leaves as
// it is is land: the two meet where the bed comes to y = 0, within a tenth of a degree. Seen from above the land.
// Controls seen: a bed half a metre lower (the planted fault waterline_low), and read a metre aside.
TEST_F(ThinThings, TheWaterlineIsWhereTheBedComesThroughTheWater) {
  constexpr double depth_m = 10.0, land_m = 8.0, feather_m = 4.0, edge_z = -12.0;
  // The share of the land is smooth, u^2 (3 - 2u), over the feather within its edge.
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double u = 0.5 * (low + high);
    (-depth_m + (depth_m + land_m) * u * u * (3.0 - 2.0 * u) < 0.0 ? low : high) = u;
  }
  const double line_z = edge_z - low * feather_m;
  InputSpec bank;
  bank.to = InputTarget::sea_depth;
  bank.value = {land_m, 0.0f, 0.0f, 0.0f};
  bank.blend = InputBlend::replace;
  bank.feather_m = feather_m;
  bank.shape = AreaInput{.round = false, .at_m = {0.0, edge_z - 40.0}, .size_m = {160.0, 80.0}};
  for (const Way& way : ways) {
    SeaShot shot = shot_of(way,
                           {{"waves.wind_speed_mps", "2"},
                            {"waves.fetch_m", "1000"},
                            {"waves.swell_height_m", "0"},
                            {"waves.depth_m", std::to_string(depth_m)},
                            {"lod.pixel_error", "1"},
                            {"water.glitter", "0"}},
                           {"waves", "sea_depth"}, {bank});
    const Viewpoint view = eyes_of(pose({1.0, 25.0, -15.0}, 176.0, -88.0, 10.0), 8.0, 3.0);
    shot.set("water.chlorophyll_mg_m3", "0.01");
    const auto blue = shot.pictures(view, 10.0);
    shot.set("water.chlorophyll_mg_m3", "10");
    const auto green = shot.pictures(view, 10.0);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const glm::dvec3 from = view.eyes[eye].pose.position_m;
      double worst = 0.0;
      int water = 0, land = 0;
      for (int i = 0; i < width * height; ++i) {
        const glm::dvec3 way_there = ray(view.eyes[eye], i % width + 0.5, i / width + 0.5);
        const glm::dvec3 there = from + way_there * (from.y / -way_there.y);
        int change = 0;
        for (std::size_t c = 0; c < 3; ++c)
          change = std::max(change, std::abs(int(blue[eye].pixels[4 * std::size_t(i) + c]) -
                                             int(green[eye].pixels[4 * std::size_t(i) + c])));
        const bool wet = change > 2;
        (wet ? water : land) += 1;
        if (wet != (there.z > line_z))
          worst = std::max(worst, angle_deg(way_there, glm::dvec3(there.x, 0.0, line_z) - from));
      }
      EXPECT_GT(water, 2000) << named(way);
      EXPECT_GT(land, 2000) << named(way);
      RecordProperty("waterline_" + named(way) + std::to_string(eye), std::to_string(worst) + " degrees");
      EXPECT_LT(worst, 0.1) << named(way) << ", eye " << eye << ' ' << test::leave(green[eye], "waterline");
    }
  }
}

}  // namespace

}  // namespace seascape
