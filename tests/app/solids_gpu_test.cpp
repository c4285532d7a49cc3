// Solid things as they are drawn: where the water meets them, in how many draws, of which materials, in each shape of
// the frame. Controls are named beside each test.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/multiview_check.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

class Solids : public test::GpuTest {};

constexpr std::uint32_t width = 240, height = 180;

SeaShot shot_of(const test::FrameLook& look, const SceneObjects& objects, const test::Set& set = {}) {
  return SeaShot(test::solid_options(look, objects, width, height, set));
}

const std::uint8_t* texel(const Image8& picture, std::size_t x, std::size_t y) {
  return &picture.pixels[4 * (y * width + x)];
}
bool is_magenta(const std::uint8_t* p) { return p[0] > 110 && p[2] > 110 && p[1] < 70; }

glm::dvec3 ray(const View& eye, double x, double y) { return test::pixel_ray(eye, x, y, width, height); }

// How far along a ray the pile or the box begins; nothing: NaN.
double to_pile(const glm::dvec3& from, const glm::dvec3& d, double radius) {
  const double a = d.x * d.x + d.z * d.z, b = from.x * d.x + from.z * d.z;
  const double c = from.x * from.x + from.z * from.z - radius * radius;
  return b < 0.0 && b * b > a * c ? (-b - std::sqrt(b * b - a * c)) / a : std::nan("");
}
double to_box(const glm::dvec3& from, const glm::dvec3& d, double half) {
  double near = -1e30, far = 1e30;
  for (const int axis : {0, 2}) {
    const double s = (-half - from[axis]) / d[axis], t = (half - from[axis]) / d[axis];
    near = std::max(near, std::min(s, t));
    far = std::min(far, std::max(s, t));
  }
  return near < far && near > 0.0 ? near : std::nan("");
}

// A pile and a square post stand still in a swell; in each column of the picture their lowest pixel is where `query`
// has the water, within a pixel, as seen from the side and from above. Controls seen: things drawn 0.1 m beside;
// their depth 3 % too near.
TEST_F(Solids, TheWaterlineIsWhereQueriesSayItIs) {
  int columns = 0;
  double worst = 0.0;
  for (const test::FrameLook& look : test::sampled_looks())
    for (const bool round : {true, false}) {
      SceneObjects objects;
      test::stand(objects,
                  test::solid_model(round ? test::solid_pile(1.0f, -6.0f, 12.0f) : test::solid_box({0.8f, 12.0f, 0.8f}),
                                    test::unlit_magenta),
                  Pose{});
      SeaShot shot = shot_of(look, objects,
                             {{"waves.wind_speed_mps", "0"},
                              {"waves.swell_height_m", "1.5"},
                              {"waves.swell_period_s", "6"},
                              {"lod.pixel_error", "0.25"},
                              {"models.seen_in_water", "false"},
                              {"sky.exposure_ev", "0"}});
      int number = 0;
      for (const glm::dvec3& from : {glm::dvec3(0.5, 2.5, 9.0), glm::dvec3(-7.0, 3.5, 5.0), glm::dvec3(2.0, 9.0, -5.0),
                                     glm::dvec3(8.0, 2.2, -3.0), glm::dvec3(-4.0, 4.0, -7.0)}) {
        const double time_s = 3.0 + 7.3 * number++;
        const double to_deg = std::atan2(-from.x, from.z) * 57.29577951;
        const double down_deg = std::atan2(from.y, std::hypot(from.x, from.z)) * 57.29577951;
        const Viewpoint viewpoint = shot.viewpoint(pose(from, to_deg, -down_deg));
        const Image8 picture = shot.picture(viewpoint, time_s);
        const View& eye = viewpoint.eyes.front();
        const SeaView view = shot.experience().sea()->view_at(time_s, SeaDetail::drawn);
        const auto above = [&](double x, double y) {  // how far over the water the thing is there; NaN: it is not there
          const glm::dvec3 d = ray(eye, x, y);
          const double range = round ? to_pile(eye.pose.position_m, d, 1.0) : to_box(eye.pose.position_m, d, 0.8);
          const glm::dvec3 at = eye.pose.position_m + range * d;
          return at.y - view.query({at.x, at.z}, {.footprint_m = 0.02, .tolerance_m = 1e-4}).height_m;
        };
        for (std::size_t x = 0; x < width; ++x) {
          int lowest = -1;
          for (std::size_t y = 0; y < height; ++y)
            if (is_magenta(texel(picture, x, y))) lowest = int(y);
          const auto line_at = [&](double column) {
            double y = height - 1.0;
            while (y > 0.0 && !(above(column, y) > 0.0)) y -= 1.0;
            if (y <= 0.0) return std::nan("");
            for (int eighths = 7; eighths > 0; --eighths)
              if (above(column, y + eighths / 8.0) > 0.0) return y + eighths / 8.0;
            return y;
          };
          // A pixel off in any direction, as the line may be steep. Columns that only graze its side, or where the line
          // is not in the picture, are left out.
          const double left = line_at(x - 0.5), line = line_at(x + 0.5), right = line_at(x + 1.5);
          const double low = std::max({left, line, right}), high = std::min({left, line, right});
          if (std::isnan(left + line + right) || low > height - 3.0 || high < 3.0) continue;
          ++columns;
          const double off = std::max({0.0, lowest + 1.0 - low, high - lowest - 1.0});
          worst = std::max(worst, off);
          EXPECT_LE(off, 1.0) << look.name << (round ? " pile " : " box ") << number << " column " << x << ": "
                              << lowest + 1 << " for " << line << " " << test::leave(picture, "waterline");
          if (HasFailure()) return;
        }
      }
    }
  EXPECT_GE(columns, test::long_run() ? 1000 : 500);
  RecordProperty("columns", std::to_string(columns));
  RecordProperty("worst_pixels", std::to_string(worst));
}

// A thousand crates of one primitive are one draw, of those that are in sight, and no object is made after the first
// frame. Control seen: a draw a thing.
TEST_F(Solids, AThousandCratesAreOneDraw) {
  for (const test::FrameLook& look : test::sampled_looks()) {
    SceneObjects objects;
    test::stand(objects, test::solid_model(test::solid_box({0.3f, 0.3f, 0.3f}), "{}"), Pose{{0.0, 0.3, -6.0}});
    SceneObjects one = objects;
    for (int i = 1; i < 1000; ++i)
      objects.things.push_back({0, Pose{{(i % 40 - 20) * 1.5, 0.3, -6.0 - 1.5 * (i / 40)}}, 1.0});
    SeaShot alone = shot_of(look, one), all = shot_of(look, objects);
    const Pose head = pose({0.0, 4.0, 0.0}, 0.0, -15.0), away = pose({0.0, 4.0, 0.0}, 180.0, -15.0);
    alone.draw(head, 1.0);
    all.draw(head, 1.0);
    const std::uint64_t draws = all.counts().draws;
    EXPECT_EQ(draws, alone.counts().draws) << look.name;
    const std::size_t seen = all.experience().solids()->selection().instances.size();
    EXPECT_GT(seen, 300u);
    EXPECT_LT(seen, 1000u);
    const std::size_t held = test::device().objects().size();
    all.draw(away, 1.1);
    EXPECT_EQ(all.experience().solids()->selection().instances.size(), 0u);
    EXPECT_EQ(all.counts().draws, draws - 2);  // themselves, and what of them is under water
    all.draw(head, 1.2);
    EXPECT_EQ(test::device().objects().size(), held) << look.name;
  }
}

// One plate that stands before the sky, upright. `colours`: of its left and right corners.
SceneObjects plate(const std::string& material, const glm::vec4& left, const glm::vec4& right) {
  test::SolidShape shape = test::solid_plate(1.0f);
  for (const glm::vec4& c : {left, right, right, left}) shape.colours.insert(shape.colours.end(), {c.x, c.y, c.z, c.w});
  SceneObjects objects;
  test::stand(objects, test::solid_model(shape, material), pose({0.0, 6.0, -3.0}, 0.0, 90.0));
  return objects;
}

const Pose before_plate = pose({0.0, 6.0, 0.0}, 0.0, 0.0);
const std::string unlit = R"("extensions":{"KHR_materials_unlit":{}})";

// Controls seen: the cutoff's test taken away; COLOR_0 left out in make_model(); `blends` false.
TEST_F(Solids, ColoursMasksAndGlassAreThere) {
  const std::size_t y = height / 2, left = width / 2 - 40, right = width / 2 + 40;
  for (const test::FrameLook& look : test::sampled_looks()) {
    SCOPED_TRACE(look.name);
    const auto drawn = [&](const SceneObjects& objects) { return shot_of(look, objects).picture(before_plate, 1.0); };
    const Image8 nothing = drawn(plate("{\"alphaMode\":\"MASK\"}", glm::vec4(0.0f), glm::vec4(0.0f)));
    const Image8 colours = drawn(plate("{" + unlit + "}", {1.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f, 1.0f}));
    EXPECT_GT(texel(colours, left, y)[0], texel(colours, left, y)[1] + 40);
    EXPECT_GT(texel(colours, right, y)[1], texel(colours, right, y)[0] + 40);
    const Image8 mask = drawn(plate("{" + unlit + ",\"alphaMode\":\"MASK\",\"alphaCutoff\":0.5}",
                                    {1.0f, 0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f, 1.0f}));
    EXPECT_EQ(std::memcmp(texel(mask, left, y), texel(nothing, left, y), 3), 0) << "cut away: the sky";
    EXPECT_GT(texel(mask, right, y)[0], texel(mask, right, y)[2] + 40);
    const Image8 glass =
        drawn(plate("{" + unlit + ",\"alphaMode\":\"BLEND\"}", {1.0f, 0.0f, 0.0f, 0.5f}, {1.0f, 0.0f, 0.0f, 0.5f}));
    const Image8 opaque = drawn(plate("{" + unlit + "}", {1.0f, 0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f, 1.0f}));
    for (const int channel : {0, 2}) {
      const int sky = texel(nothing, left, y)[channel], red = texel(opaque, left, y)[channel],
                both = texel(glass, left, y)[channel];
      EXPECT_GT(both, std::min(sky, red)) << channel;
      EXPECT_LT(both, std::max(sky, red)) << channel;
    }
  }
}

// Slats a third of a pixel wide, from dark to red, are nowhere brighter than red ones, nor darker than dark ones: a
// pixel of four samples takes no colour from beside them. Control seen: `tint` without centroid.
TEST_F(Solids, ThinThingsHaveNoColoursButTheirOwn) {
  constexpr float across_m = 0.01f, apart_m = 0.03137f;  // at 6 m a pixel is 0.026 m
  const auto slats = [&](const glm::vec4& left, const glm::vec4& right) {
    test::SolidShape shape;
    for (int i = 0; i < 100; ++i) {
      const float x = (float(i) - 49.5f) * apart_m;
      const auto first = std::uint32_t(4 * i);
      for (const glm::vec2& at : {glm::vec2(0.0f, -1.0f), {across_m, -1.0f}, {across_m, 1.0f}, {0.0f, 1.0f}}) {
        shape.corner({x + at.x, at.y, 0.0f}, {0.0f, 0.0f, 1.0f});
        const glm::vec4& c = at.x > 0.0f ? right : left;
        shape.colours.insert(shape.colours.end(), {c.x, c.y, c.z, c.w});
      }
      for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) shape.indices.push_back(first + corner);
    }
    SceneObjects objects;
    test::stand(objects, test::solid_model(shape, "{" + unlit + "}"), pose({0.0, 6.0, -6.0}, 0.0, 0.0));
    return objects;
  };
  const glm::vec4 dark(0.02f, 0.02f, 0.02f, 1.0f), red(0.3f, 0.02f, 0.02f, 1.0f);
  const auto drawn = [&](const glm::vec4& left, const glm::vec4& right) {
    return shot_of(test::frame_looks[0], slats(left, right)).picture(before_plate, 1.0);
  };
  const Image8 both = drawn(dark, red), darkest = drawn(dark, dark), reddest = drawn(red, red);
  EXPECT_GT(test::differing_pixels(both, darkest), 500);
  int beyond = 0;
  for (std::size_t i = 0; i < both.pixels.size(); ++i)
    beyond += both.pixels[i] > std::max(darkest.pixels[i], reddest.pixels[i]) + 1 ||
              both.pixels[i] + 1 < std::min(darkest.pixels[i], reddest.pixels[i]);
  EXPECT_EQ(beyond, 0);
}

// A plate whose node is mirrored is lit as the plain one is, and like it not seen from behind. Controls seen: mirrored
// parts drawn on both sides; their triangles not turned round; their normals not turned back.
TEST_F(Solids, MirroredThingsShowTheirFrontsAlone) {
  const std::string grey = R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0}})";
  const auto drawn = [&](const test::FrameLook& look, const char* scale, double yaw_deg) {
    SceneObjects objects;
    test::stand(objects,
                test::solid_model(test::solid_plate(1.0f), grey, R"({"mesh":0,"scale":)" + std::string(scale) + "}"),
                pose({0.0, 6.0, -3.0}, yaw_deg, 90.0));
    return shot_of(look, objects).picture(before_plate, 1.0);
  };
  for (const test::FrameLook& look : test::sampled_looks()) {
    const Image8 plain = drawn(look, "[1,1,1]", 0.0), behind = drawn(look, "[1,1,1]", 180.0);
    EXPECT_GT(test::differing_pixels(plain, behind), 1000) << look.name;
    for (const char* mirrored : {"[-1,1,1]", "[1,1,-1]"}) {
      const Image8 front = drawn(look, mirrored, 0.0);
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(texel(front, width / 2, height / 2)[channel], texel(plain, width / 2, height / 2)[channel], 1)
            << look.name << mirrored;
      EXPECT_EQ(test::differing_pixels(drawn(look, mirrored, 180.0), behind), 0) << look.name << mirrored;
    }
  }
}

// A two-sided plate that is mirrored where it is placed, as a sail on its other tack, is lit as the plain one on either
// side. Control seen: sides told by the order of the corners.
TEST_F(Solids, WhatIsMirroredAsItMovesIsLitOnTheSideThatIsSeen) {
  const std::string grey =
      R"({"doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0}})";
  const Pose behind_plate = pose({0.0, 6.0, -6.0}, 180.0, 0.0);
  const auto drawn = [&](const test::FrameLook& look, double side, const Pose& eye) {
    SceneObjects objects;
    test::stand(objects, test::solid_model(test::solid_plate(1.0f), grey), pose({0.0, 6.0, -3.0}, 0.0, 90.0));
    objects.things.back().nodes = {glm::scale(glm::dmat4(1.0), {side, 1.0, 1.0})};
    return shot_of(look, objects).picture(eye, 1.0);
  };
  for (const test::FrameLook& look : test::sampled_looks()) {
    std::vector<int> seen;
    for (const Pose& eye : {before_plate, behind_plate}) {
      const Image8 plain = drawn(look, 1.0, eye), mirrored = drawn(look, -1.0, eye);
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(texel(mirrored, width / 2, height / 2)[channel], texel(plain, width / 2, height / 2)[channel], 1)
            << look.name << eye.position_m.z;
      seen.push_back(texel(plain, width / 2, height / 2)[1]);
    }
    EXPECT_GT(std::abs(seen[0] - seen[1]), 20) << look.name << ": one side is in the sun";
  }
}

// What lets light through, under the sea, is hidden by it, and before it is not. Control seen: depth_sampled taken
// for false in solid.frag.
TEST_F(Solids, GlassUnderTheSeaIsHidden) {
  const std::string glass = R"({"alphaMode":"BLEND","doubleSided":true,)" + unlit + "}";
  for (const test::FrameLook& look : test::sampled_looks()) {
    SCOPED_TRACE(look.name);
    const auto drawn = [&](double up_m) {
      SceneObjects objects;
      test::stand(objects, test::solid_model(test::solid_plate(1.0f), glass), Pose{{0.0, up_m, -4.0}});
      return shot_of(look, objects).picture(pose({0.0, 3.0, 0.0}, 0.0, -35.0), 1.0);
    };
    const Image8 away = drawn(-1000.0);
    EXPECT_EQ(test::differing_pixels(drawn(-1.5), away), 0);
    EXPECT_GT(test::differing_pixels(drawn(0.6), away), 500);
  }
}

}  // namespace
}  // namespace seascape
