// Hard cases found by reading the inputs' divisions, roots, casts and loops: points at one place, strips of texels,
// times without end, models of any size.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/gltf.h"
#include "engine/image_file.h"
#include "ocean/inputs/clip_volumes.h"
#include "ocean/inputs/inputs.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {
namespace {

constexpr glm::vec4 zero{0.0f};

InputSpec of(InputTarget to, decltype(InputSpec::shape) shape, float value = 1.0f) {
  InputSpec spec;
  spec.to = to;
  spec.where = "s.json:7: inputs[2]";
  spec.value = {value, 0.0f, 0.0f, 0.0f};
  spec.shape = std::move(shape);
  return spec;
}
float level_at(const Inputs& inputs, glm::dvec2 at, double footprint = 0.0, double time = 0.0) {
  return inputs.value(at, footprint, time, zero).x;
}

// Hard 60: Points of a spline 1e-7 to 1e-320 m apart count as one, with a remark, and the band is what it is without
// them (1e-6). Control: the code as it was: knots that coincide made all chords NaN, and the whole band was gone
// without a word.
TEST(InputsHard, hard_60_points_closer_than_roots_tell) {
  const auto at = [](double x, double z) { return SplinePoint{{x, z}, 10.0, glm::vec4(3.0f, 0.0f, 0.0f, 0.0f)}; };
  for (const bool closed : {false, true}) {
    const auto band = [&](std::vector<SplinePoint> points) {
      return Inputs(InputTarget::level,
                    std::vector{of(InputTarget::level, SplineInput{.points = std::move(points), .closed = closed})});
    };
    const Inputs plain = band({at(0, 0), at(100, 0), at(50, 80)});
    ASSERT_TRUE(plain.remarks().empty());
    ASSERT_NEAR(level_at(plain, {100.0, 0.0}), 3.0f, 1e-6f);
    for (const double apart : {1e-7, 1e-17, 1e-160, 1e-200, 1e-320}) {
      const Inputs near = band({at(0, 0), at(0, apart), at(100, 0), at(50, 80), at(50, 80 + 1e-7),
                                at(closed ? apart : 50, closed ? 0 : 80)});
      EXPECT_EQ(near.remarks().size(), 1u) << apart;
      for (double x = -10.0; x < 110.0; x += 1.7)
        EXPECT_NEAR(level_at(near, {x, 2.0}, 1.0), level_at(plain, {x, 2.0}, 1.0), 1e-5f) << x << " " << apart;
    }
  }
}

// Hard 61: A picture 20,000 texels wide and one high is read to its last texel, and one of a single texel is that value
// everywhere. Control: the code as it was: every texel from the 16,386th on was the 16,386th's.
TEST(InputsHard, hard_61_strips_and_single_texels) {
  const auto picture = [](int width, int height) {
    auto image = std::make_shared<ImageF>();
    image->width = width, image->height = height;
    image->pixels.assign(std::size_t(4 * width * height), 1.0f);
    for (int i = 0; i < width * height; ++i) image->pixels[std::size_t(4 * i)] = float(i);
    return image;
  };
  for (const bool tall : {false, true}) {
    TextureInput strip;
    strip.image = picture(tall ? 1 : 20000, tall ? 20000 : 1);
    strip.size_m = {tall ? 10.0 : 20000.0, tall ? 20000.0 : 10.0};
    strip.scale = 1e-3;
    const Inputs inputs(InputTarget::level, std::vector{of(InputTarget::level, strip)});
    for (int i = 7; i < 20000; i += 97) {
      const double along = i + 0.5 - 10000.0;
      ASSERT_NEAR(level_at(inputs, tall ? glm::dvec2(0.0, along) : glm::dvec2(along, 0.0)), 1e-3f * float(i), 1e-5f)
          << i;
    }
    EXPECT_NEAR(level_at(inputs, {0.0, 0.0}, 1e6) / level_at(inputs, {0.0, 0.0}), 0.0f, 1.0f);
  }
  TextureInput one;
  one.image = picture(1, 1), one.image = [&] {
    auto image = std::make_shared<ImageF>(*one.image);
    image->pixels[0] = 5.0f;
    return image;
  }();
  one.size_m = {30.0, 20.0};
  const Inputs inputs(InputTarget::level, std::vector{of(InputTarget::level, one)});
  for (double x = -14.9; x < 15.0; x += 1.3)
    for (double z = -9.9; z < 10.0; z += 1.1) ASSERT_EQ(level_at(inputs, {x, z}), 5.0f);
  EXPECT_EQ(level_at(inputs, {15.1, 0.0}), 0.0f);
}

// Hard 62: Trails at times up to 1e300 s, and with keys a thousandth of a second apart at 1e9 s: an end to the search,
// shares from 0 to 1, and a loop that repeats. Control: the code as it was: a loop at 1e17 s went through passes that
// no double tells apart, for ever.
TEST(InputsHard, hard_62_trails_without_end) {
  TrailInput loop{.keys = {{0.0, {0.0, 0.0}}, {3.0, {30.0, 0.0}}, {6.0, {15.0, 20.0}}, {9.0, {0.0, 0.0}}},
                  .radius_m = 3.0,
                  .life_s = 20.0,
                  .spread_mps = 0.1,
                  .loop = true};
  const Inputs looped(InputTarget::foam, std::vector{of(InputTarget::foam, loop)});
  for (const double time : {0.0, -1e9, 1e9, 1e12, 1e15, 1e17, -1e17, 1e100, 1e300})
    for (double x = -5.0; x < 36.0; x += 3.3) {
      const float share = level_at(looped, {x, 1.0}, 0.5, time);
      ASSERT_TRUE(share >= 0.0f && share <= 1.0f) << time;
    }
  double most = 0.0;
  for (double x = -5.0; x < 36.0; x += 0.7) {
    most = std::max(most, double(level_at(looped, {x, 1.0}, 0.5, 4.0)));
    EXPECT_NEAR(level_at(looped, {x, 1.0}, 0.5, 4.0), level_at(looped, {x, 1.0}, 0.5, 4.0 + 9.0 * 1e6), 1e-4f);
  }
  EXPECT_GT(most, 0.5);
  for (const double sign : {-1.0, 1.0}) {
    TrailInput late{.keys = {{sign * 1e9 - (sign > 0.0 ? 2e-3 : 0.0), {-1e7, 0.0}},
                             {sign * 1e9 + (sign > 0.0 ? 0.0 : 2e-3), {1e7, 0.0}}},
                    .radius_m = 1e-3,
                    .life_s = 1e-3};
    const Inputs one(InputTarget::foam, std::vector{of(InputTarget::foam, late)});
    for (const double after : {-1.0, 0.0, 1e-3, 2e-3, 3e-3, 1.0})
      for (const double x : {-1e7, 0.0, 5e6, 1e7}) {
        const float share = level_at(one, {x, 0.0}, 1.0, late.keys[0].time_s + after);
        ASSERT_TRUE(share >= 0.0f && share <= 1.0f);
      }
  }
}

// Hard 63: Models of 1e38 and of 1e-38 m, weights that no float holds, and heights beyond all ranges: a level within
// its range and no number that is none. Control: the code as it was: a weight of 1e-60 times an infinite height was
// NaN.
TEST(InputsHard, hard_63_models_of_any_size) {
  for (const float size : {1e-38f, 1e-30f, 1.0f, 1e20f, 3e38f})
    for (const double weight : {1e-320, 1e-60, 1e-40, 1.0})
      for (const InputBlend blend : {InputBlend::add, InputBlend::replace, InputBlend::max}) {
        auto model = std::make_shared<Model>();
        model->parts.emplace_back();
        model->parts[0].positions = {{-size, size, -size}, {size, size, -size}, {0.0f, size, size}};
        model->parts[0].indices = {0, 2, 1};
        ShapeInput shape;
        shape.model = model, shape.from = ShapeInput::From::height, shape.scale = 1e6;
        InputSpec spec = of(InputTarget::level, shape, 0.0f);
        spec.weight = weight, spec.blend = blend;
        const Inputs inputs(InputTarget::level, std::vector{spec});
        for (const glm::dvec2 at : {glm::dvec2(0.0), glm::dvec2(0.25 * double(size)), glm::dvec2(1e3, -20.0)})
          for (const double footprint : {0.0, 1.0, 1e7}) {
            const float level = level_at(inputs, at, footprint);
            ASSERT_TRUE(level >= -10000.0f && level <= 10000.0f) << size << " " << weight << " " << level;
          }
      }
}

// Hard 64: A hull with triangles of no area (all corners at one place, two at one, three in a line) holds what it holds
// without them, at 4,000 points to either side. Control: triangles with corners at one place counted as sides (the hull
// is refused as open).
TEST(ClipVolumesHard, hard_64_triangles_of_no_area) {
  const auto box = [](bool slivers) {
    auto model = std::make_shared<Model>();
    model->parts.emplace_back();
    MeshPart& p = model->parts[0];
    for (int i = 0; i < 8; ++i)
      p.positions.push_back({i & 1 ? 3.0f : -3.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 2.0f : -2.0f});
    p.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    if (slivers) {
      p.positions.push_back({0.0f, 1.0f, -2.0f});  // in the middle of a side
      for (const std::uint32_t i : {3u, 3u, 3u, 5u, 5u, 1u, 2u, 8u, 3u, 3u, 8u, 2u}) p.indices.push_back(i);
    }
    ShapeInput shape;
    shape.file = "box.glb", shape.model = model, shape.from = ShapeInput::From::hull;
    InputSpec spec = of(InputTarget::clip, shape);
    spec.blend = InputBlend::replace;
    return ClipVolumes(std::vector{spec});
  };
  const ClipVolumes plain = box(false), slivers = box(true);
  int inside = 0;
  for (double x = -3.95; x < 4.0; x += 0.41)
    for (double y = -1.45; y < 1.5; y += 0.17)
      for (double z = -2.95; z < 3.0; z += 0.47) {
        const bool in = plain.clipped({x, y, z}, false);
        inside += in;
        ASSERT_EQ(slivers.clipped({x, y, z}, false), in) << x << " " << y << " " << z;
      }
  EXPECT_GT(inside, 500);
}

// Hard 65: What a soft edge adds to a shape seen with a footprint is taken away again to 1e-6 of its area for bands and
// 1e-3 for discs, with feathers and footprints from 1e-3 of the shape to a million times it; factors are finite and
// from 0 to 1 at 0, at the least double and at 1e7 m. Control: the band's integral without its half of h (off by up to
// a fifth).
TEST(InputsHard, hard_65_soft_edges_of_any_width) {
  for (const double feather : {0.0, 1e-3, 0.3, 1.0})
    for (const double footprint : {1e-3, 0.2, 1.0, 3.0, 50.0}) {
      double sharp = 0.0, soft = 0.0, disc = 0.0, disc_soft = 0.0;
      const double reach = 0.5 + soft_reach(feather, footprint), step = reach / 20000.0;
      for (double x = 0.5 * step; x < reach; x += step) {
        const double a = soft_share(0.5 - x, feather, 0.0), b = soft_share(0.5 - x, feather, footprint);
        sharp += step * a, soft += step * b * band_factor(0.5, feather, footprint);
        disc += step * x * a, disc_soft += step * x * b * disc_factor(0.5, feather, footprint);
      }
      EXPECT_NEAR(soft / sharp, 1.0, 2e-3) << feather << " " << footprint;
      EXPECT_NEAR(disc_soft / disc, 1.0, 5e-3) << feather << " " << footprint;
    }
  for (const double half : {5e-4, 1.0, 5e5})
    for (const double feather : {0.0, 5e-324, 1e-300, 1e-3, 1e6})
      for (const double footprint : {0.0, 5e-324, 1e-300, 1.0, 1e7})
        for (const double factor : {band_factor(half, feather, footprint), disc_factor(half, feather, footprint),
                                    soft_share(half, feather, footprint), soft_share(-half, feather, footprint)})
          EXPECT_TRUE(factor >= 0.0 && factor <= 1.0 + 1e-9)
              << half << " " << feather << " " << footprint << " " << factor;
}

// Hard 66: Points exactly on the faces, edges and ends of volumes, whose rounding is half the least side and whose
// length is twice the radius, of two millimetres and 10,000 km from the origin: never NaN, and a hundredth of their
// size to either side decides. Control: a box's distance without its case of the inside.
TEST(ClipVolumesHard, hard_66_exactly_on_their_faces) {
  using Form = VolumeInput::Form;
  for (const double size : {2e-3, 1.0, 1e4})
    for (const double far : {0.0, 1e7 - 1.0})
      for (const Form form : {Form::sphere, Form::box, Form::capsule, Form::cylinder}) {
        VolumeInput body;
        body.form = form, body.at_m = {far, 0.0, -far}, body.size_m = glm::dvec3(size), body.round_m = 0.5 * size,
        body.radius_m = 0.5 * size, body.length_m = size;
        InputSpec spec = of(InputTarget::clip, body);
        spec.blend = InputBlend::replace;
        const ClipVolumes volumes(std::vector{spec});
        for (int axis = 0; axis < 3; ++axis)
          for (const double side : {-0.5, 0.5}) {
            glm::dvec3 on = body.at_m;
            on[axis] += side * size;
            EXPECT_TRUE(std::isfinite(volumes.distance_m(0, on)));
            glm::dvec3 in = body.at_m, out = body.at_m;
            in[axis] += 0.98 * side * size, out[axis] += 1.02 * side * size;
            EXPECT_TRUE(volumes.clipped(in, false)) << size << " " << int(form) << " " << axis;
            EXPECT_FALSE(volumes.clipped(out, false)) << size << " " << int(form) << " " << axis;
          }
        for (const double bad :
             {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300})
          for (const bool flat : {false, true}) EXPECT_EQ(volumes.clipped({bad, 0.0, 0.0}, flat), flat);
      }
}

}  // namespace
}  // namespace seascape
