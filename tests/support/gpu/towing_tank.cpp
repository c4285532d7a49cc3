#include "tests/support/gpu/towing_tank.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/files.h"
#include "ocean/mesh/patch_mesh.h"
#include "tests/support/gpu/drawn_mesh.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wake_truth.h"

namespace seascape::test {

namespace {

constexpr double g = 9.81, before_m = 10.0;

std::string scene_of(const TankRun& run, double speed_mps, const TemporaryFolder& folder) {
  const std::string shipped = std::string(SEASCAPE_TEST_DIR) + "/../content/scenes/wake_tank.json";
  nlohmann::json scene = nlohmann::json::parse(read_text(shipped));
  const double course = glm::radians(run.course_deg);
  nlohmann::json& hull = scene.at("objects").at(0);
  hull["at_m"] = {0, 0, 0};
  hull["yaw_deg"] = run.course_deg;
  hull["float"]["velocity_mps"] = {speed_mps * std::sin(course), -speed_mps * std::cos(course)};
  write_atomically(folder / "tank.json", scene.dump());
  return (folder / "tank.json").string();
}

double degrees(double across, double behind) { return std::atan2(across, behind) * 180.0 / truth::pi; }

}  // namespace

DrawnWake::DrawnWake(const TankRun& run) : speed_(run.froude * std::sqrt(g * length_m)) {
  const TemporaryFolder folder;
  SeaShot shot({.scene = scene_of(run, speed_, folder),
                .preset = run.preset,
                .width = 960,
                .height = 960,
                .probe = true,
                .set = run.set});
  const double course = glm::radians(run.course_deg);
  const glm::dvec2 ahead(std::sin(course), -std::cos(course)), right(-ahead.y, ahead.x);
  Experience& experience = shot.experience();
  const auto head = [&](double time_s) {
    const glm::dvec2 eye = (speed_ * time_s - run.eye_m.z) * ahead + run.eye_m.x * right;
    return pose({eye.x, run.eye_m.y, eye.y}, run.course_deg + run.to_right_deg, -run.looks_down_deg);
  };
  constexpr int drawn = 4;  // the mesh is chosen by the water of the frame before
  const int frames = int(std::round(run.way_m / speed_ / run.frame_s));
  for (int i = 0; i < frames - drawn; ++i) {
    const double time_s = i * run.frame_s;
    experience.sea()->advance(time_s, head(time_s).position_m);
  }
  for (int i = frames - drawn; i < frames; ++i) shot.draw(head(i * run.frame_s), i * run.frame_s);
  const double now_s = (frames - 1) * run.frame_s;
  const Pose hull = experience.bodies()->pose_at(0, now_s);
  const glm::dvec2 middle(hull.position_m.x, hull.position_m.z);
  const DrawnMesh mesh(shot, shot.viewpoint(head(now_s)));
  const DrawnWakes* wakes = experience.ocean().wakes();
  const double share = wakes != nullptr && wakes->surface() != nullptr ? wakes->surface()->share() : 1.0;
  std::vector<Vertex> vertices;
  vertices.reserve(mesh.vertices().size());
  for (const SurfacePoint& v : mesh.vertices()) {
    const glm::dvec2 from = glm::dvec2(v.at.x, v.at.z) - middle, by = (glm::dvec2(v.at.x, v.at.z) - v.rest) / share;
    vertices.push_back({{-glm::dot(from, ahead), glm::dot(from, right)}, {by.x, v.at.y, by.y}});
  }
  rasterise(vertices);
}

void DrawnWake::rasterise(const std::vector<Vertex>& vertices) {
  columns_ = int((before_m + behind_m) / step_m) + 1, rows_ = int(2.0 * aside_m / step_m) + 1;
  moved_.assign(std::size_t(columns_) * std::size_t(rows_), glm::vec3(std::numeric_limits<float>::quiet_NaN()));
  const std::vector<std::uint16_t> indices = patch_indices(gpu::patch_quads);
  constexpr auto side = std::size_t(gpu::patch_quads + 1);
  const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
  for (std::size_t first = 0; first < vertices.size(); first += side * side)
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      std::array<glm::dvec2, 3> p;
      std::array<glm::dvec3, 3> moved;
      for (std::size_t c = 0; c < 3; ++c) {
        const Vertex& vertex = vertices[first + indices[t + c]];
        p[c] = (vertex.at + glm::dvec2(before_m, aside_m)) / step_m;
        moved[c] = vertex.moved;
      }
      const auto from = [](double low, int most) { return int(std::clamp(std::ceil(low), 0.0, double(most))); };
      const int x0 = from(std::min({p[0].x, p[1].x, p[2].x}), columns_),
                x1 = from(std::max({p[0].x, p[1].x, p[2].x}) + 1e-9, columns_),
                y0 = from(std::min({p[0].y, p[1].y, p[2].y}), rows_),
                y1 = from(std::max({p[0].y, p[1].y, p[2].y}) + 1e-9, rows_);
      const double whole = cross(p[1] - p[0], p[2] - p[0]);
      if (std::abs(whole) < 1e-9) continue;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
          const glm::dvec2 here(x, y);
          const double a = cross(p[1] - here, p[2] - here) / whole, b = cross(p[2] - here, p[0] - here) / whole,
                       c = 1.0 - a - b;
          if (std::min({a, b, c}) < -1e-9) continue;
          moved_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)] =
              glm::vec3(a * moved[0] + b * moved[1] + c * moved[2]);
        }
    }
}

double DrawnWake::transverse_number() const { return g / (speed_ * speed_); }

bool DrawnWake::drawn(double behind, double right) const { return !std::isnan(moved(behind, right).y); }

glm::vec3 DrawnWake::moved(double behind, double right) const {
  const double px = (behind + before_m) / step_m, py = (right + aside_m) / step_m;
  const int x = int(std::floor(px)), y = int(std::floor(py));
  if (x < 0 || y < 0 || x + 1 >= columns_ || y + 1 >= rows_) return glm::vec3(std::numeric_limits<float>::quiet_NaN());
  const auto at = [&](int i, int j) { return moved_[std::size_t(j) * std::size_t(columns_) + std::size_t(i)]; };
  return glm::mix(glm::mix(at(x, y), at(x + 1, y), float(px - x)),
                  glm::mix(at(x, y + 1), at(x + 1, y + 1), float(px - x)), float(py - y));
}

double DrawnWake::height(double behind, double right) const {
  const double height = double(moved(behind, right).y);
  return std::isnan(height) ? 0.0 : height;
}

double DrawnWake::amplitude(double behind, double right) const {
  const double size = double(glm::length(moved(behind, right)));
  return std::isnan(size) ? 0.0 : size;
}

double DrawnWake::difference(const DrawnWake& other, glm::dvec2 behind, glm::dvec2 right) const {
  double off = 0.0, all = 0.0;
  for (double x = behind.x; x <= behind.y; x += step_m)
    for (double y = right.x; y <= right.y; y += step_m) {
      const double here = height(x, y), there = other.height(x, y);
      off += (here - there) * (here - there), all += here * here;
    }
  return off / all;
}

double DrawnWake::envelope_deg(double from_m, double to_m) const {
  double sum = 0.0;
  int lines = 0;
  for (double behind = from_m; behind <= to_m + 1e-9; behind += (to_m - from_m) / 4.0)
    for (const double side : {1.0, -1.0}) {
      constexpr double step_deg = 0.1;
      std::vector<double> high;
      for (double at = 0.0; at < 32.0; at += step_deg)
        high.push_back(amplitude(behind, side * (behind + 0.5 * length_m) * std::tan(glm::radians(at))));
      const double best = *std::max_element(high.begin(), high.end());
      std::size_t at = 0;
      for (std::size_t i = 1; i + 1 < high.size(); ++i)
        if (high[i] > high[i - 1] && high[i] >= high[i + 1] && high[i] > 0.4 * best) at = i;
      const double crest = high[at];
      while (at + 1 < high.size() && high[at] > truth::airy_at_fold() * crest) ++at;
      sum += double(at) * step_deg;
      ++lines;
    }
  return sum / lines;
}

double DrawnWake::highest_deg(double from_m, double to_m) const {
  double sum = 0.0;
  int lines = 0;
  for (double behind = from_m; behind <= to_m + 1e-9; behind += (to_m - from_m) / 4.0)
    for (const double side : {1.0, -1.0}) {
      double best = 0.0, at = 0.0;
      for (double y = 0.0; y < 12.0; y += 0.1)
        if (const double here = amplitude(behind, side * y); here > best) best = here, at = y;
      sum += degrees(at, behind);
      ++lines;
    }
  return sum / lines;
}

double DrawnWake::wavelength_m(double from_m, double to_m) const {
  double best = std::numeric_limits<double>::infinity(), at = 0.0;
  const double k0 = transverse_number();
  for (double k = 0.8 * k0; k < 1.2 * k0; k += 0.001 * k0) {
    double cc = 0.0, cs = 0.0, ss = 0.0, hc = 0.0, hs = 0.0, hh = 0.0;
    for (double x = from_m; x < to_m; x += step_m) {
      const double h = height(x, 0.0) * std::sqrt(x - 0.5 * length_m), c = std::cos(k * x), s = std::sin(k * x);
      cc += c * c, cs += c * s, ss += s * s, hc += h * c, hs += h * s, hh += h * h;
    }
    const double det = cc * ss - cs * cs, a = (hc * ss - hs * cs) / det, b = (hs * cc - hc * cs) / det,
                 left = hh - a * hc - b * hs;
    if (left < best) best = left, at = k;
  }
  return 2.0 * truth::pi / at;
}

}  // namespace seascape::test
