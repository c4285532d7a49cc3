#include "ocean/bodies/hull.h"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "engine/error.h"

namespace seascape {
namespace {

// Triangles of corners of their own, welded at the end.
struct Soup {
  HullMesh mesh;
  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto first = std::uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
};

}  // namespace

HullMesh welded(const HullMesh& soup) {
  HullMesh mesh;
  std::map<std::tuple<long long, long long, long long>, std::uint32_t> known;
  std::vector<std::uint32_t> now;
  for (const glm::dvec3& p : soup.vertices) {
    const auto key = std::tuple(std::llround(p.x * 1e7), std::llround(p.y * 1e7), std::llround(p.z * 1e7));
    const auto [found, made] = known.emplace(key, std::uint32_t(mesh.vertices.size()));
    if (made) mesh.vertices.push_back(p);
    now.push_back(found->second);
  }
  for (const auto& t : soup.triangles) {
    const std::array<std::uint32_t, 3> w{now[t[0]], now[t[1]], now[t[2]]};
    if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) mesh.triangles.push_back(w);
  }
  return mesh;
}

HullMesh hull_of(const Model& model, double scale) {
  HullMesh soup;
  for (const MeshPart& part : model.parts) {
    const auto first = std::uint32_t(soup.vertices.size());
    for (const glm::vec3& p : part.positions) soup.vertices.push_back(scale * glm::dvec3(p));
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3)
      soup.triangles.push_back({first + part.indices[i], first + part.indices[i + 1], first + part.indices[i + 2]});
  }
  return welded(soup);
}

HullVolume volume_of(const HullMesh& mesh) {
  double volume = 0.0;
  glm::dvec3 first(0.0);
  glm::dmat3 second(0.0);  // integral of x x^T
  // About the first vertex, so that a hull far from its origin loses no digits.
  const glm::dvec3 origin = mesh.vertices.empty() ? glm::dvec3(0.0) : mesh.vertices.front();
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin,
                     c = mesh.vertices[t[2]] - origin, sum = a + b + c;
    const double v = glm::dot(a, glm::cross(b, c)) / 6.0;
    volume += v;
    first += v / 4.0 * sum;
    second +=
        v / 20.0 *
        (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) + glm::outerProduct(sum, sum));
  }
  if (!(volume > 0.0)) return {};
  const glm::dvec3 centre = first / volume;
  second -= volume * glm::outerProduct(centre, centre);
  const double trace = second[0][0] + second[1][1] + second[2][2];
  return {volume, centre + origin, glm::dmat3(trace) - second};
}

void validate(const HullMesh& mesh, const char* where) {
  const char* remedy = "close the model: each side belongs to two triangles, counter-clockwise seen from outside";
  for (const glm::dvec3& v : mesh.vertices)
    if (!(std::abs(v.x) < 1e6 && std::abs(v.y) < 1e6 && std::abs(v.z) < 1e6))
      throw Error(where, "a corner of the hull is no number within 1e6 m", "give corners in metres");
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;  // how often more one way than the other
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (a >= mesh.vertices.size())
        throw Error(where, "a triangle of the hull has a corner that is not there", remedy);
      if (a == b) continue;
      sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  for (const auto& [side, balance] : sides)
    if (balance != 0) throw Error(where, "the hull is not closed", remedy);
  if (!(volume_of(mesh).volume_m3 > 0.0)) throw Error(where, "the hull encloses nothing", remedy);
}

HullMesh box_hull(const glm::dvec3& size, int parts) {
  Soup soup;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5})
      for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j) {
          const auto corner = [&](int di, int dj) {
            glm::dvec3 p(0.0);
            p[axis] = side;
            p[(axis + 1) % 3] = double(i + di) / parts - 0.5;
            p[(axis + 2) % 3] = double(j + dj) / parts - 0.5;
            return p * size;
          };
          if (side > 0.0)
            soup.quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
          else
            soup.quad(corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0));
        }
  return welded(soup.mesh);
}

HullMesh cylinder_hull(double radius, double height, int parts) {
  Soup soup;
  const auto rim = [&](int i, double y) {
    const double turn = 2.0 * std::numbers::pi * double(i % parts) / parts;
    return glm::dvec3(radius * std::cos(turn), y, -radius * std::sin(turn));
  };
  const double top = 0.5 * height;
  for (int i = 0; i < parts; ++i) {
    soup.quad(rim(i, -top), rim(i + 1, -top), rim(i + 1, top), rim(i, top));
    soup.triangle({0.0, top, 0.0}, rim(i, top), rim(i + 1, top));
    soup.triangle({0.0, -top, 0.0}, rim(i + 1, -top), rim(i, -top));
  }
  return welded(soup.mesh);
}

HullMesh sphere_hull(double radius, int parts) {
  Soup soup;
  const int rows = parts / 2;
  const auto point = [&](int i, int j) {
    const double turn = 2.0 * std::numbers::pi * double(i % parts) / parts, down = std::numbers::pi * double(j) / rows,
                 ring = j == 0 || j == rows ? 0.0 : std::sin(down);
    return radius * glm::dvec3(ring * std::cos(turn), std::cos(down), -ring * std::sin(turn));
  };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < rows; ++j) soup.quad(point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
  return welded(soup.mesh);
}

}  // namespace seascape
