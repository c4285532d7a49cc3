// The light of solid things against double precision: what rough surfaces mirror of white surroundings, and spheres
// under our own sun, sky and sea. Controls are named beside each test.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "app/frame.h"
#include "app/program.h"
#include "engine/pipeline.h"
#include "shaders/shared/fresnel.h"
#include "shaders/shared/sky_push.h"
#include "shaders/shared/solid_data.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

constexpr double pi = 3.14159265358979323846;

class SolidLight : public test::GpuTest {};

float half_at(const std::vector<std::uint8_t>& bytes, std::size_t i) {
  std::uint16_t half;
  std::memcpy(&half, &bytes[2 * i], 2);
  return glm::unpackHalf1x16(half);
}

double facets(double nh, double a) {  // Walter et al. 2007, eq. 33
  const double tan2 = (1.0 - nh * nh) / (nh * nh), c2 = nh * nh;
  return a * a / (pi * c2 * c2 * (a * a + tan2) * (a * a + tan2));
}
double lambda(double cosine, double a) {  // Heitz 2014, eq. 72
  const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
  return 0.5 * (-1.0 + std::sqrt(1.0 + a * a * tan2));
}
double masked(double nl, double nv, double a) { return 1.0 / (1.0 + lambda(nl, a) + lambda(nv, a)); }  // eq. 99

// Directions of light that facets mirror towards v, with the weight of each (its share of the hemisphere times facets,
// masking and cosines, without Fresnel), and the cosine at the facet.
template <class Take>
void each_mirrored(const glm::dvec3& n, const glm::dvec3& v, double a, int count, const Take& take) {
  const glm::dvec3 across =
      glm::normalize(std::abs(n.y) < 0.9 ? glm::cross(n, glm::dvec3(0, 1, 0)) : glm::cross(n, glm::dvec3(1, 0, 0)));
  const glm::dvec3 along = glm::cross(n, across);
  const double nv = glm::dot(n, v);
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < count; ++k) {
      // Even in u where the tangent of the facet's slope is a u / (1 - u).
      const double u = (i + 0.5) / count, turn = 2.0 * pi * (k + 0.5 * (i % 2)) / count, slope = a * u / (1.0 - u);
      const double cosine = 1.0 / std::sqrt(1.0 + slope * slope), sine = slope * cosine;
      const double solid = 2.0 * pi / count * sine * cosine * cosine * a / ((1.0 - u) * (1.0 - u) * count);
      const glm::dvec3 h = sine * std::cos(turn) * across + sine * std::sin(turn) * along + cosine * n;
      const double vh = glm::dot(v, h);
      const glm::dvec3 l = 2.0 * vh * h - v;
      const double nl = glm::dot(n, l);
      if (nl <= 0.0 || vh <= 0.0) continue;
      take(l, solid * facets(cosine, a) * masked(nl, nv, a) * vh / nv, vh);
    }
}

// Every place of the table. With it the sum of what is mirrored and spread is one for white surfaces by itself, so its
// error is that of a white furnace for a metal. Control seen: glTF's roughness
// for its square.
TEST_F(SolidLight, WhatRoughSurfacesMirrorOfWhiteSurroundings) {
  Device& device = test::device();
  ImageSpec spec;
  spec.width = spec.height = gpu::solid_albedo_side;
  spec.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  spec.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  spec.array = false;
  const Image table(device, "table", spec);
  const Pipeline pipeline = make_compute_pipeline(device, test::shaders(), "solid_albedo.comp");
  const Bindings bindings(device, pipeline, {{.binding = 0, .view = table.view()}}, "table");
  Frame frame(device);
  frame.begin();
  frame.pass("table", {use(table, Access::compute_write, true)}, [&](Commands& c) {
    c.bind(pipeline, bindings);
    c.dispatch(gpu::solid_albedo_side / 8, gpu::solid_albedo_side / 8, 1);
  });
  frame.submit();
  frame.finish();
  const std::vector<std::uint8_t> bytes = read_image(device, table, 0);
  double worst = 0.0, least = 1.0;
  for (int y = 0; y < gpu::solid_albedo_side; ++y)
    for (int x = 1; x < gpu::solid_albedo_side; ++x) {  // at n.v = 0 nothing is seen
      const double nv = double(x) / (gpu::solid_albedo_side - 1);
      const double rough = std::max(double(y) / (gpu::solid_albedo_side - 1), 0.03);
      glm::dvec2 expected(0.0);
      each_mirrored({0, 0, 1}, {std::sqrt(1.0 - nv * nv), 0.0, nv}, rough * rough, 160,
                    [&](const glm::dvec3&, double weight, double vh) {
                      const double f = std::pow(1.0 - vh, 5.0);
                      expected += weight * glm::dvec2(1.0 - f, f);
                    });
      const std::size_t at = 4 * (std::size_t(y) * gpu::solid_albedo_side + std::size_t(x));
      const glm::dvec2 found(half_at(bytes, at), half_at(bytes, at + 1));
      worst = std::max(worst, std::abs(found.x + found.y - expected.x - expected.y));
      least = std::min(least, found.x + found.y);
      EXPECT_NEAR(found.x, expected.x, 0.01) << nv << " " << rough;
      EXPECT_NEAR(found.y, expected.y, 0.01) << nv << " " << rough;
    }
  EXPECT_LE(worst, 0.01);
  EXPECT_LT(least, 0.6) << "rough surfaces lose light to further bounces";
}

// Radiance around a scene's middle, read back: sky above, and below the horizon a level sea.
class Surroundings {
 public:
  explicit Surroundings(SeaShot& shot, const Viewpoint& viewpoint)
      : map_(read_image(shot.device(), shot.experience().sky().map(), 0)) {
    const std::vector<std::uint8_t> bytes = read_buffer(shot.device(), shot.experience().sky().light());
    std::memcpy(&light, bytes.data(), sizeof light);
    data = frame_data(shot.scene().settings, viewpoint, 1);
    shot.experience().ocean().describe(data, viewpoint);
  }
  glm::dvec3 from(const glm::dvec3& d) const {
    const glm::dvec3 sky_there = sky({d.x, std::abs(d.y), d.z});
    if (d.y >= 0.0) return sky_there;
    const double f = gpu::fresnel(float(-d.y));
    const glm::dvec3 below =
        glm::dvec3(data.water_reflectance) *
        (0.93 * glm::dvec3(light.sky_irradiance) + double(data.water_reflectance.w) * glm::dvec3(light.sun_irradiance));
    return f * sky_there + (1.0 - f) * below;
  }
  gpu::SkyLight light{};
  gpu::FrameData data{};

 private:
  glm::dvec3 sky(const glm::dvec3& d) const {  // sky_coordinate() of shaders/lib/sky.glsl, filtered
    const double p = d.x / (std::abs(d.x) + std::abs(d.z));
    const double across = d.z < 0.0 ? 0.25 * p : 0.5 - 0.25 * p;
    const double x = across * gpu::sky_map_width - 0.5;
    const double y = std::clamp(std::sqrt(d.y) * gpu::sky_map_height - 0.5, 0.0, gpu::sky_map_height - 1.0);
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    glm::dvec3 sum(0.0);
    for (int v = 0; v < 2; ++v)
      for (int u = 0; u < 2; ++u) {
        const int column = (int(std::floor(x)) + u + 2 * gpu::sky_map_width) % gpu::sky_map_width;
        const int row = std::min(int(y) + v, gpu::sky_map_height - 1);
        const std::size_t at = 4 * (std::size_t(row) * gpu::sky_map_width + std::size_t(column));
        sum += (u ? fx : 1.0 - fx) * (v ? fy : 1.0 - fy) *
               glm::dvec3(half_at(map_, at), half_at(map_, at + 1), half_at(map_, at + 2));
      }
    return sum;
  }
  std::vector<std::uint8_t> map_;
};

struct Ball {
  const char* name;
  double rough, metallic;
};

// What white facets mirror, for a direction of the eye, in one bounce.
double white_mirrored(double nv, double a, int count) {
  double sum = 0.0;
  each_mirrored({0, 0, 1}, {std::sqrt(1.0 - nv * nv), 0.0, nv}, a, count,
                [&](const glm::dvec3&, double weight, double) { sum += weight; });
  return sum;
}

// What further bounces between facets add (Kulla and Conty 2017, "Revisiting physically based shading at Imageworks"),
// as if it left in all directions alike.
glm::dvec3 bounced(const glm::dvec3& f0, double nv, double a) {
  double mean = 0.0;
  for (int i = 0; i < 16; ++i) mean += 2.0 / 16 * (i + 0.5) / 16 * white_mirrored((i + 0.5) / 16, a, 32);
  const glm::dvec3 f = f0 + (1.0 - f0) / 21.0;
  return (1.0 - white_mirrored(nv, a, 64)) * f * f * mean / (1.0 - f * (1.0 - mean));
}

// Radiance towards v of a place of a ball: facets that mirror sun and surroundings, and below them a Lambertian that
// gets the rest.
glm::dvec3 lit(const Surroundings& around, const Ball& ball, const glm::dvec3& base, const glm::dvec3& n,
               const glm::dvec3& v) {
  const double a = ball.rough * ball.rough;
  const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), base, ball.metallic), albedo = base * (1.0 - ball.metallic);
  const auto fresnel = [&](double vh) { return f0 + (1.0 - f0) * std::pow(1.0 - vh, 5.0); };
  glm::dvec3 mirrored(0.0), share(0.0), irradiance(0.0);
  each_mirrored(n, v, a, 96, [&](const glm::dvec3& l, double weight, double vh) {
    mirrored += weight * fresnel(vh) * around.from(l);
    share += weight * fresnel(vh);
  });
  const glm::dvec3 across =
      glm::normalize(std::abs(n.y) < 0.9 ? glm::cross(n, glm::dvec3(0, 1, 0)) : glm::cross(n, glm::dvec3(1, 0, 0)));
  const glm::dvec3 along = glm::cross(n, across);
  for (int i = 0; i < 64; ++i)
    for (int k = 0; k < 64; ++k) {
      const double u = (i + 0.5) / 64, turn = 2.0 * pi * (k + 0.5) / 64;
      irradiance +=
          pi / 4096 *
          around.from(std::sqrt(u) * (std::cos(turn) * across + std::sin(turn) * along) + std::sqrt(1.0 - u) * n);
    }
  const glm::dvec3 sun(around.data.sun), again = bounced(f0, glm::dot(n, v), a);
  const glm::dvec3 spread = (again + albedo * (1.0 - share - again)) / pi;
  glm::dvec3 sum = mirrored + spread * irradiance;
  if (const double nl = glm::dot(n, sun), nv = glm::dot(n, v); nl > 0.0) {
    const glm::dvec3 h = glm::normalize(sun + v);
    sum += glm::dvec3(around.light.sun_irradiance) * nl *
           (fresnel(glm::dot(v, h)) * facets(glm::dot(n, h), a) * masked(nl, nv, a) / (4.0 * nl * nv) + spread);
  }
  return sum;
}

// Balls of several materials, in both ways of lighting, at noon and in low sun. Mean difference of all places in each:
// 3 %. Control seen: the sun from the other side (l = -frame.sun.xyz).
TEST_F(SolidLight, ASphereUnderOurSunAndSky) {
  constexpr std::uint32_t side = 96;
  const glm::dvec3 base(0.8, 0.5, 0.2);
  for (const Ball& ball :
       {Ball{"paint", 0.6, 0.0}, Ball{"varnish", 0.25, 0.0}, Ball{"chalk", 1.0, 0.0}, Ball{"steel", 0.4, 1.0}})
    for (const char* elevation : {"55", "8"})
      for (const char* lighting : {"forward", "deferred"}) {
        SceneObjects objects;
        const std::string material =
            R"({"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.5,0.2,1],"roughnessFactor":)" +
            std::to_string(ball.rough) + R"(,"metallicFactor":)" + std::to_string(ball.metallic) + "}}";
        const glm::dvec3 middle(0.0, 30.0, -5.0);
        test::stand(objects, test::solid_model(test::solid_sphere(1.0f, 128), material), Pose{middle});
        SeaShot shot({.scene = "calm",
                      .preset = "medium",
                      .width = side,
                      .height = side,
                      .set = {{"frame.shape", "desktop"},
                              {"msaa", "1"},
                              {"frame.lighting", lighting},
                              {"waves.resolution", "32"},
                              {"sky.sun_elevation_deg", elevation},
                              {"sky.sun_to_deg", "140"}},
                      .effects = {{"waves", "models"}},
                      .objects = objects});
        const Viewpoint viewpoint = shot.viewpoint(pose({0.0, 30.0, 0.0}, 0.0, 0.0));
        shot.draw(viewpoint, 1.0);
        const ImageF picture = linear_picture_of(shot.device(), shot.experience(), 0);
        const Surroundings around(shot, viewpoint);
        const double exposed = around.light.exposure.x * std::exp2(double(around.data.air.y));
        const View& eye = viewpoint.eyes.front();
        double off = 0.0, all = 0.0;
        int places = 0;
        for (std::uint32_t y = 1; y < side; y += 4)
          for (std::uint32_t x = 1; x < side; x += 4) {
            const glm::dvec3 d =
                glm::normalize(glm::dvec3(eye.fov.left + (eye.fov.right - eye.fov.left) * (x + 0.5) / side,
                                          eye.fov.up - (eye.fov.up - eye.fov.down) * (y + 0.5) / side, -1.0));
            const glm::dvec3 from = eye.pose.position_m - middle;
            const double b = glm::dot(from, d), c = glm::dot(from, from) - 1.0;
            if (b * b < c) continue;
            const glm::dvec3 n = from + (-b - std::sqrt(b * b - c)) * d;
            if (glm::dot(n, -d) < 0.2) continue;  // its rim
            const glm::dvec3 expected = exposed * lit(around, ball, base, n, -d);
            for (int channel = 0; channel < 3; ++channel) {
              const double found = picture.pixels[4 * (std::size_t(y) * side + x) + std::size_t(channel)];
              off += std::abs(found - expected[channel]);
              all += expected[channel];
            }
            ++places;
          }
        EXPECT_GT(places, 25);
        EXPECT_LE(off / all, 0.03) << ball.name << " " << elevation << " " << lighting;
        RecordProperty(std::string(ball.name) + elevation + lighting, std::to_string(off / all));
      }
}

}  // namespace
}  // namespace seascape
