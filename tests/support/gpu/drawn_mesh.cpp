#include "tests/support/gpu/drawn_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "ocean/mesh/patch_mesh.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/horizon_truth.h"

namespace seascape::test {

namespace {

constexpr std::size_t per_patch = std::size_t(gpu::patch_quads + 1) * std::size_t(gpu::patch_quads + 1);

const std::vector<std::uint16_t>& indices() {
  static const std::vector<std::uint16_t> all = patch_indices(gpu::patch_quads);
  return all;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// From a point to the nearest of a triangle: within it, or of one of its edges.
double to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto to_edge = [&p](const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 along = to - from;
    const double length2 = glm::dot(along, along),
                 t = length2 > 0.0 ? std::clamp(glm::dot(p - from, along) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, from + t * along);
  };
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double size = glm::length(normal);
  if (size > 0.0) {
    const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
      return glm::dot(glm::cross(to - from, p - from), normal) >= 0.0;
    };
    if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(glm::dot(p - a, normal)) / size;
  }
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

}  // namespace

DrawnMesh::DrawnMesh(SeaShot& shot, const Viewpoint& viewpoint)
    : viewpoint_(viewpoint), curved_(shot.scene().settings.lod.earth_curvature) {
  const SurfaceSelection& s = *shot.experience().ocean().selection();
  if (s.patches.size() > Surface::probe_patches) throw std::runtime_error("more patches than the probe holds");
  const auto bytes = read_buffer(shot.device(), shot.experience().surface().probed());
  const glm::dvec2 viewer(viewpoint.viewer.position_m.x, viewpoint.viewer.position_m.z);
  vertices_.resize(s.patches.size() * per_patch);
  patches_.resize(s.patches.size());
  for (std::size_t n = 0; n < patches_.size(); ++n) {
    Patch& patch = patches_[n] = {glm::dvec2(1e30), glm::dvec2(-1e30)};
    for (std::size_t v = n * per_patch; v < (n + 1) * per_patch; ++v) {
      std::array<float, 8> out;
      std::memcpy(out.data(), &bytes[v * 32], 32);
      const glm::dvec2 place = viewer + glm::dvec2(out[4], out[5]);
      vertices_[v] = {s.grid_origin_m + glm::dvec2(out[0], out[1]), {place.x, out[6], place.y}, out[2]};
      patch.low = glm::min(patch.low, vertices_[v].rest);
      patch.high = glm::max(patch.high, vertices_[v].rest);
    }
  }
}

std::optional<glm::dvec3> DrawnMesh::at(const glm::dvec2& rest) const {
  for (std::size_t tried = 0; tried < patches_.size(); ++tried) {
    const std::size_t n = (found_ + tried) % patches_.size();
    if (!glm::all(glm::lessThanEqual(patches_[n].low, rest)) || !glm::all(glm::lessThanEqual(rest, patches_[n].high)))
      continue;
    for (std::size_t t = 0; t < indices().size(); t += 3) {
      const SurfacePoint *a = &vertices_[n * per_patch + indices()[t]],
                         *b = &vertices_[n * per_patch + indices()[t + 1]],
                         *c = &vertices_[n * per_patch + indices()[t + 2]];
      const double whole = cross(b->rest - a->rest, c->rest - a->rest);
      if (std::abs(whole) < 1e-9) continue;
      const double wa = cross(b->rest - rest, c->rest - rest) / whole,
                   wb = cross(c->rest - rest, a->rest - rest) / whole, wc = 1.0 - wa - wb;
      if (std::min({wa, wb, wc}) < -1e-6) continue;
      found_ = n;
      return wa * a->at + wb * b->at + wc * c->at;
    }
  }
  return std::nullopt;
}

std::vector<DrawnMesh::Triangle> DrawnMesh::triangles(const glm::dvec2& rest, double reach_m) const {
  std::vector<Triangle> list;
  for (std::size_t n = 0; n < patches_.size(); ++n)
    if (glm::all(glm::lessThanEqual(patches_[n].low, rest + reach_m)) &&
        glm::all(glm::lessThanEqual(rest - reach_m, patches_[n].high)))
      for (std::size_t t = 0; t < indices().size(); t += 3)
        list.push_back({vertices_[n * per_patch + indices()[t]].at, vertices_[n * per_patch + indices()[t + 1]].at,
                        vertices_[n * per_patch + indices()[t + 2]].at});
  return list;
}

double DrawnMesh::distance(const glm::dvec3& point, const glm::dvec2& rest, double reach_m) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < patches_.size(); ++n) {
    if (!glm::all(glm::lessThanEqual(patches_[n].low, rest + reach_m)) ||
        !glm::all(glm::lessThanEqual(rest - reach_m, patches_[n].high)))
      continue;
    for (std::size_t t = 0; t < indices().size(); t += 3)
      least = std::min(least, to_triangle(point, vertices_[n * per_patch + indices()[t]].at,
                                          vertices_[n * per_patch + indices()[t + 1]].at,
                                          vertices_[n * per_patch + indices()[t + 2]].at));
  }
  return least;
}

glm::dvec3 DrawnMesh::seen(const glm::dvec3& at) const {
  const View& eye = viewpoint_.eyes.at(0);
  const glm::dvec2 away(at.x - viewpoint_.viewer.position_m.x, at.z - viewpoint_.viewer.position_m.z);
  const double drop = curved_ ? glm::dot(away, away) / (2.0 * truth::mean_earth_radius_m) : 0.0;
  const glm::dvec3 of_eye =
      glm::conjugate(eye.pose.orientation) * (glm::dvec3(at.x, at.y - drop, at.z) - eye.pose.position_m);
  return {of_eye.x / -of_eye.z, of_eye.y / -of_eye.z, -of_eye.z};
}

std::vector<DrawnMesh::Shown> DrawnMesh::shown(int width, int height) const {
  const Fov& fov = viewpoint_.eyes.at(0).fov;
  std::vector<Shown> pixels(std::size_t(width) * std::size_t(height));
  std::vector<glm::dvec3> places(vertices_.size());  // x and y in pixels, and depth
  for (std::size_t v = 0; v < places.size(); ++v) {
    const glm::dvec3 s = seen(vertices_[v].at);
    places[v] = {(s.x - fov.left) / (fov.right - fov.left) * width, (fov.up - s.y) / (fov.up - fov.down) * height, s.z};
  }
  for (std::size_t first = 0; first < places.size(); first += per_patch)
    for (std::size_t t = 0; t < indices().size(); t += 3) {
      std::array<std::size_t, 3> v;
      for (std::size_t c = 0; c < 3; ++c) v[c] = first + indices()[t + c];
      const std::array<glm::dvec3, 3> p{places[v[0]], places[v[1]], places[v[2]]};
      if (std::min({p[0].z, p[1].z, p[2].z}) < 0.05) continue;
      const auto from = [](double low, int most) { return int(std::clamp(std::ceil(low - 0.5), 0.0, double(most))); };
      const int x0 = from(std::min({p[0].x, p[1].x, p[2].x}), width),
                x1 = from(std::max({p[0].x, p[1].x, p[2].x}) + 1e-9, width);
      const int y0 = from(std::min({p[0].y, p[1].y, p[2].y}), height),
                y1 = from(std::max({p[0].y, p[1].y, p[2].y}) + 1e-9, height);
      const double whole = cross(glm::dvec2(p[1] - p[0]), glm::dvec2(p[2] - p[0]));
      if (whole == 0.0) continue;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
          const glm::dvec2 here(x + 0.5, y + 0.5);
          std::array<double, 3> w{cross(glm::dvec2(p[1]) - here, glm::dvec2(p[2]) - here) / whole,
                                  cross(glm::dvec2(p[2]) - here, glm::dvec2(p[0]) - here) / whole, 0.0};
          w[2] = 1.0 - w[0] - w[1];
          if (std::min({w[0], w[1], w[2]}) < -1e-9) continue;
          double sum = 0.0;
          for (std::size_t c = 0; c < 3; ++c) sum += w[c] /= p[c].z;
          Shown& pixel = pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
          if (pixel.any && pixel.depth <= 1.0 / sum) continue;
          pixel = {{}, 1.0 / sum, first / per_patch, true};
          for (std::size_t c = 0; c < 3; ++c) {
            pixel.point.rest += w[c] / sum * vertices_[v[c]].rest;
            pixel.point.at += w[c] / sum * vertices_[v[c]].at;
          }
        }
    }
  return pixels;
}

}  // namespace seascape::test
