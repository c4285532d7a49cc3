// How many pixels the drawn mesh lies off the sea: points of its triangles against a surface with eight times the
// vertices a side.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "ocean/mesh/patch_mesh.h"
#include "ocean/mesh/quadtree.h"
#include "ocean/mesh/water_below.h"
#include "ocean/sea/query.h"
#include "shaders/shared/patch_vertex.h"

namespace seascape {

// A headset's picture: 1680 x 1760 an eye, 100 degrees up and down.
inline constexpr double headset_height_px = 1760.0, headset_fov_deg = 100.0, headset_aspect = 1680.0 / 1760.0;

struct DrawnMesh {
  const WaveField& field;
  const WaveTiles& tiles;
  const SurfaceSelection& selection;

  // Rest place in the world and, displaced, the place in the world, of a vertex as surface.vert draws it (uncurved).
  struct Vertex {
    glm::dvec2 rest;
    double footprint;
    glm::dvec3 at;
  };
  Vertex vertex(const gpu::PatchInstance& p, int index) const {
    const SurfaceSelection& s = selection;
    constexpr int side = gpu::patch_quads + 1;
    const glm::vec2 place = gpu::patch_vertex(p, index % side, index / side, s.mesh);
    const double footprint = static_cast<double>(gpu::displacement_footprint(s.mesh.morph, place)) * s.unit_m;
    const glm::dvec2 rest = s.grid_origin_m + glm::dvec2(place) * s.unit_m;
    const glm::dvec3 d = field.displacement(tiles, rest, footprint);
    return {rest, footprint, glm::dvec3(rest.x, 0.0, rest.y) + d};
  }
};

// Distance of a point to the sea smoothed over `footprint`, from a rest place near it: steps of Gauss and Newton over
// the rest place, the nearest that they come by. Where the first place is nearer than `enough_m` the sea is nearer
// still, and its tangent plane says how near.
inline double distance_to_sea(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest, double footprint,
                              const glm::dvec3& point, double enough_m) {
  const WaveField::Filter filter = field.filter(footprint);
  double nearest = 1e300;
  for (int step = 0; step < 4; ++step) {
    const SeaSample s = field.sea(tiles, rest, filter);
    const glm::dvec3 off = point - glm::dvec3(rest.x, 0.0, rest.y) - s.displacement;
    const double distance = glm::length(off);
    if (distance >= nearest) break;
    nearest = distance;
    const glm::dvec3 x(1.0 + s.shift_gradient.x, s.height_gradient.x, s.shift_gradient.z),
        z(s.shift_gradient.z, s.height_gradient.y, 1.0 + s.shift_gradient.y);
    const double xx = glm::dot(x, x), zz = glm::dot(z, z), xz = glm::dot(x, z), determinant = xx * zz - xz * xz;
    if (!(determinant > 1e-6)) break;
    if (step == 0 && distance < enough_m)
      return std::min(distance, std::abs(glm::dot(off, glm::normalize(glm::cross(z, x)))));
    const double a = glm::dot(off, x), b = glm::dot(off, z);
    rest += glm::dvec2(zz * a - xz * b, xx * b - xz * a) / determinant;
  }
  return nearest;
}

struct ScreenError {
  double enough = 0.0;        // pixels: below, the sea's tangent plane is near enough
  std::vector<float> pixels;  // of every point looked at
  double triangles = 0.0;     // of all poses
  int poses = 0;
  double worst = 0.0;
  int nearer_elsewhere = 0;  // points whose nearest sea was found from another place
  std::string where;

  double share(double most) {  // below which this share of them lies
    const auto at = pixels.begin() + static_cast<std::ptrdiff_t>(std::min(most * static_cast<double>(pixels.size()),
                                                                          static_cast<double>(pixels.size() - 1)));
    std::nth_element(pixels.begin(), at, pixels.end());
    return static_cast<double>(*at);
  }
  double rms() const {
    double sum = 0.0;
    for (const float p : pixels) sum += static_cast<double>(p) * static_cast<double>(p);
    return std::sqrt(sum / static_cast<double>(pixels.size()));
  }
};

// What an Ocean tells the quadtree of its sea.
inline DisplacementBounds bounds_of(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& viewer) {
  const SeaStatistics& s = field.statistics();
  return {s.largest_height_m, s.largest_shift_m, s.mesh_error, water_below(field, tiles, viewer, s.near_motion)};
}

// A head over the water: from 0.3 m to a kilometre above what stands there, grazing, looking down, rolled.
inline Viewpoint pose_over(const WaveField& field, const WaveTiles& tiles, std::mt19937& random, int n) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const std::array<glm::dvec2, 1> at{glm::dvec2{unit(random), unit(random)} * 20000.0};
  std::array<QueryAnswer, 1> water;
  query(field, tiles, at, water);
  const double above = n % 3 == 0 ? 1.7 : std::pow(10.0, 1.25 + 1.75 * unit(random));
  const double pitch = n % 7 == 3 ? -90.0 : n % 2 == 0 ? -5.0 + 5.0 * unit(random) : -40.0 + 40.0 * unit(random);
  const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  const Pose head{{at[0].x, std::max(water[0].height_m, 0.0 * above) + above, at[0].y},
                  glm::angleAxis(3.1416 * unit(random), y) * glm::angleAxis(glm::radians(pitch), x) *
                      glm::angleAxis(n % 5 == 4 ? 1.0 : 0.0, z)};
  Viewpoint view{head, stereo_views(head, symmetric_fov(headset_fov_deg, headset_aspect), 0.064)};
  view.pixels_per_radian = pixels_per_radian(view.eyes, headset_height_px);
  return view;
}

// Adds the points of one picture: of every patch in the list `per_patch` triangles' corners, edges or insides.
inline void add_picture(const DrawnMesh& drawn, const Viewpoint& view, int per_patch, std::mt19937& random,
                        ScreenError& to) {
  static const std::vector<std::uint16_t> indices = patch_indices(gpu::patch_quads);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  ++to.poses;
  to.triangles += static_cast<double>(drawn.selection.patches.size() * indices.size() / 3);
  const glm::dmat4 clip[2] = {
      projection(view.eyes[0].fov, 0.1) * eye_from_relative(view.eyes[0].pose, view.viewer.position_m),
      projection(view.eyes[1].fov, 0.1) * eye_from_relative(view.eyes[1].pose, view.viewer.position_m)};
  std::array<std::optional<DrawnMesh::Vertex>, (gpu::patch_quads + 1) * (gpu::patch_quads + 1)> vertices;
  for (const gpu::PatchInstance& p : drawn.selection.patches) {
    vertices.fill(std::nullopt);
    const auto vertex = [&](std::uint16_t index) {
      if (!vertices[index]) vertices[index] = drawn.vertex(p, index);
      return *vertices[index];
    };
    for (int n = 0; n < per_patch; ++n) {
      const std::size_t t = 3 * (random() % (indices.size() / 3));
      const std::array<DrawnMesh::Vertex, 3> v{vertex(indices[t]), vertex(indices[t + 1]), vertex(indices[t + 2])};
      double a = unit(random), b = unit(random);
      if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
      if (n % 4 == 1) a = 0.0, b = 0.5;  // the middle of an edge: the one across a quad
      if (n % 4 == 2) a = 1.0, b = 0.0;  // a vertex
      const double c = 1.0 - a - b;
      const glm::dvec3 at = a * v[0].at + b * v[1].at + c * v[2].at;
      const glm::dvec2 rest = a * v[0].rest + b * v[1].rest + c * v[2].rest;
      const glm::dvec3 off = at - view.viewer.position_m;
      const glm::dvec4 seen(off.x, off.y - curvature_drop(off.x * off.x + off.z * off.z), off.z, 1.0);
      double range = 1e300;
      for (int eye = 0; eye < 2; ++eye) {
        const glm::dvec4 q = clip[eye] * seen;
        if (q.w > 0.1 && std::abs(q.x) <= q.w && std::abs(q.y) <= q.w)
          range = std::min(
              range, glm::length(glm::dvec3(seen) -
                                 (view.eyes[static_cast<std::size_t>(eye)].pose.position_m - view.viewer.position_m)));
      }
      if (range > 1e200) continue;
      // Eight times the vertices: an eighth of the spacing, an eighth of what a vertex averages.
      const double footprint = (a * v[0].footprint + b * v[1].footprint + c * v[2].footprint) / 8.0;
      const double pixel_m = range / view.pixels_per_radian;
      double pixels = distance_to_sea(drawn.field, drawn.tiles, rest, footprint, at, to.enough * pixel_m) / pixel_m;
      // The largest are looked for again from places about: where the sea is about to break, the nearest of it may be
      // of other water.
      if (pixels > 2.5 * to.enough && pixels > 0.9 * to.worst) {
        const double first = pixels;
        for (int from = 0; from < 81; ++from)
          pixels = std::min(pixels, distance_to_sea(drawn.field, drawn.tiles,
                                                    rest + 4.0 * footprint * glm::dvec2(from % 9 - 4, from / 9 - 4),
                                                    footprint, at, 0.0) /
                                        pixel_m);
        if (pixels < 0.98 * first) ++to.nearer_elsewhere;
      }
      to.pixels.push_back(static_cast<float>(pixels));
      if (pixels > to.worst) {
        to.worst = pixels;
        to.where =
            std::string((p.flags & gpu::patch_skirt) != 0u ? "skirt"
                                                           : "level " + std::to_string(gpu::patch_level(p.flags))) +
            ", vertices " + std::to_string(p.stride * drawn.selection.unit_m) + " m apart, footprint " +
            std::to_string(8.0 * footprint) + " m, at " + std::to_string(range) + " m, rest " +
            std::to_string(glm::length(rest - glm::dvec2(view.viewer.position_m.x, view.viewer.position_m.z))) +
            " m off, by the levels' law " +
            std::to_string(static_cast<double>(gpu::morph_distance(
                               drawn.selection.mesh.morph,
                               glm::vec2((rest - drawn.selection.grid_origin_m) / drawn.selection.unit_m))) *
                           drawn.selection.unit_m) +
            " m, eye " + std::to_string(view.viewer.position_m.y) + " m high, pose " + std::to_string(to.poses - 1);
      }
    }
  }
}

}  // namespace seascape
