// The curve of the waterline: what says where the water ends on an eye's near plane, against the drawn triangles.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "app/lab/lab.h"
#include "app/lab/screen_error.h"
#include "app/quality.h"
#include "ocean/surface/eyes_in.h"

namespace seascape {

namespace {

constexpr double near_m = 0.1;
constexpr WaveQuality drawn_quality{256, 5, false}, felt_quality{128, 3, false};  // felt: SeaSpec::felt

template <class Real>
using Triangle = std::array<glm::vec<3, Real>, 3>;

// Height of the highest triangle over a place (x, z); nothing where none is.
template <class Real>
std::optional<double> height_over(const std::vector<Triangle<Real>>& triangles, glm::dvec2 place) {
  std::optional<double> highest;
  for (const Triangle<Real>& t : triangles) {
    const glm::dvec3 a(t[0]), b(t[1]), c(t[2]);
    const glm::dvec2 o = place - glm::dvec2(a.x, a.z), u(b.x - a.x, b.z - a.z), v(c.x - a.x, c.z - a.z);
    const double area = u.x * v.y - u.y * v.x;
    if (area == 0.0) continue;
    const double s = (o.x * v.y - o.y * v.x) / area, r = (u.x * o.y - u.y * o.x) / area;
    if (s < -1e-7 || r < -1e-7 || s + r > 1.0 + 1e-7) continue;
    const double height = a.y + s * (b.y - a.y) + r * (c.y - a.y);
    if (!highest || height > *highest) highest = height;
  }
  return highest;
}

// One eye at the surface: its near plane, and where along it the drawn triangles pass.
struct Posed {
  Viewpoint view;
  SurfaceSelection mesh;
  std::vector<glm::dvec3> line;  // places on the near plane at which the surface passes it, from the eye
  glm::dvec3 eye() const { return view.eyes[0].pose.position_m; }
  // A place of the near plane, from the eye; x and y from -1 to 1.
  glm::dvec3 on_plane(double x, double y) const {
    const Fov& fov = view.eyes[0].fov;
    return view.eyes[0].pose.orientation * (near_m * glm::dvec3(x * fov.right, y * fov.up, -1.0));
  }
};

// A sea, eyes at its surface, and the meshes that presets draw for them.
struct Lens {
  Lens(double wind_mps, const LabOptions& options, const std::string& preset)
      : drawn(lab_sea(wind_mps, options), drawn_quality), felt(lab_sea(wind_mps, options), felt_quality) {
    const std::int64_t ticks = ticks_from_seconds(17.0);
    drawn.evaluate(ticks, drawn_tiles);
    felt.evaluate(ticks, felt_tiles);
    Settings settings;
    apply_preset(settings, preset);
    Quadtree tree(settings.lod);
    std::mt19937 random(options.seed + 5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int n = 0; n < (!options.timed ? 3 : options.quick ? 6 : 24); ++n) {
      const glm::dvec2 at = 500.0 * glm::dvec2{unit(random), unit(random)};
      const double water_m = asked(drawn, drawn_tiles, at).height_m;
      const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
      const Pose head{{at.x, water_m + 0.03 * unit(random), at.y},
                      glm::angleAxis(3.1416 * unit(random), y) * glm::angleAxis(0.6 * unit(random), x) *
                          glm::angleAxis(0.5 * unit(random), z)};
      Posed one;
      one.view = {head, {{head, symmetric_fov(headset_fov_deg, headset_aspect)}}};
      one.view.pixels_per_radian = pixels_per_radian(one.view.eyes, headset_height_px);
      one.mesh = tree.select(one.view, MeshWater(bounds_of(drawn, drawn_tiles, head.position_m), &drawn, &drawn_tiles));
      find_line(one);
      if (!one.line.empty()) posed.push_back(std::move(one));
    }
  }

  static QueryAnswer asked(const WaveField& field, const WaveTiles& tiles, glm::dvec2 place) {
    QueryAnswer answer;
    query(field, tiles, {&place, 1}, {&answer, 1});
    return answer;
  }

  // All triangles within a third of a metre of the eye, in double, from the eye.
  std::vector<Triangle<double>> triangles_about(const Posed& one) const {
    const DrawnMesh mesh{drawn, drawn_tiles, one.mesh};
    return collect<double>(one, [&](const gpu::PatchInstance& p) {
      const glm::dvec3 middle = mesh.vertex(p, 12).at - one.eye();
      return std::max(std::abs(middle.x), std::abs(middle.z)) < 0.33 + 4.0 * p.stride * one.mesh.unit_m;
    });
  }
  // What near_line.glsl looks at: the patches that may pass the near plane, in floats.
  std::vector<Triangle<float>> triangles_near(const Posed& one) const {
    const QueryAnswer water = asked(drawn, drawn_tiles, {one.eye().x, one.eye().z});
    const Fov& fov = one.view.eyes[0].fov;
    NearWater near = near_water(
        one.view.eyes[0], near_m, near_m * std::hypot(1.0, fov.right, fov.up),
        {water.height_m - one.eye().y, -water.normal.x / water.normal.y, -water.normal.z / water.normal.y}, 0.0);
    near.rest_m += glm::dvec2(one.eye().x - water.displacement.x, one.eye().z - water.displacement.z);
    near.half_m += water.residual_m + (water.converged ? 0.0 : 0.5);
    return collect<float>(one, [&](const gpu::PatchInstance& p) {
      const glm::dvec2 least = one.mesh.grid_origin_m + one.mesh.unit_m * glm::dvec2(p.corner);
      return near.touches(least, least + one.mesh.unit_m * double(gpu::patch_quads * p.stride));
    });
  }

  template <class Real, class Wanted>
  std::vector<Triangle<Real>> collect(const Posed& one, const Wanted& wanted) const {
    static const std::vector<std::uint16_t> indices = patch_indices(gpu::patch_quads);
    const DrawnMesh mesh{drawn, drawn_tiles, one.mesh};
    std::vector<Triangle<Real>> found;
    for (const gpu::PatchInstance& p : one.mesh.patches) {
      if ((p.flags & gpu::patch_skirt) != 0u || !wanted(p)) continue;
      std::array<glm::vec<3, Real>, (gpu::patch_quads + 1) * (gpu::patch_quads + 1)> at;
      for (std::size_t i = 0; i < at.size(); ++i) {
        // As shaders have it: places from the grid's origin, then from the viewer.
        const DrawnMesh::Vertex v = mesh.vertex(p, int(i));
        const glm::dvec2 origin = one.mesh.grid_origin_m;
        const glm::vec<2, Real> rest(v.rest - origin), viewer(glm::dvec2(one.eye().x, one.eye().z) - origin);
        const glm::vec<3, Real> d(v.at - glm::dvec3(v.rest.x, 0.0, v.rest.y));
        at[i] = {rest.x - viewer.x + d.x, d.y - Real(one.eye().y), rest.y - viewer.y + d.z};
      }
      for (std::size_t i = 0; i < indices.size(); i += 3)
        found.push_back({at[indices[i]], at[indices[i + 1]], at[indices[i + 2]]});
    }
    return found;
  }

  // From the picture's upper edge down, 33 columns: where the water first stands over the near plane. A column that is
  // wet or dry from end to end has none.
  void find_line(Posed& one) const {
    const std::vector<Triangle<double>> triangles = triangles_about(one);
    const auto over = [&](double x, double y) {
      const glm::dvec3 p = one.on_plane(x, y);
      return height_over(triangles, {p.x, p.z}).value_or(-1e9) - p.y;
    };
    for (int column = -16; column <= 16; ++column) {
      const double x = column / 16.5;
      for (int row = 16; row > -16; --row) {
        double dry = row / 16.0, wet = (row - 1) / 16.0;
        if (over(x, dry) > 0.0 || over(x, wet) <= 0.0) continue;
        for (int i = 0; i < 48; ++i) (over(x, 0.5 * (dry + wet)) > 0.0 ? wet : dry) = 0.5 * (dry + wet);
        one.line.push_back(one.on_plane(x, wet));
        break;
      }
    }
  }

  WaveField drawn, felt;
  WaveTiles drawn_tiles, felt_tiles;
  std::vector<Posed> posed;
};

// How high the water stands over a place of the near plane (from the eye), by some means made for one eye.
using Over = std::function<double(const glm::dvec3& place)>;

LabTask task_of(const std::string& knob, double value, const std::shared_ptr<const Lens>& lens,
                const std::function<Over(const Posed&)>& make, const std::string& preset = "",
                const std::string& settings = "") {
  const auto made = std::make_shared<std::vector<Over>>(lens->posed.size());
  const auto run = [=] {
    for (std::size_t n = 0; n < made->size(); ++n) (*made)[n] = make(lens->posed[n]);
  };
  const auto errors = [=]() -> std::vector<LabError> {
    double sum = 0.0, worst = 0.0, count = 0.0;
    for (std::size_t n = 0; n < made->size(); ++n)
      for (const glm::dvec3& place : lens->posed[n].line) {
        const double miss = std::abs((*made)[n](place));
        sum += miss * miss, worst = std::max(worst, miss), count += 1.0;
      }
    const double rms = std::sqrt(sum / count),
                 pixel = near_m * 2.0 * std::tan(glm::radians(0.5 * headset_fov_deg)) / headset_height_px;
    return {{1e3 * rms, "mm at the near plane, rms"},
            {1e3 * worst, "mm at the near plane, worst"},
            {rms / pixel, "pixels of a headset, rms"}};
  };
  return {knob, value, run, double(lens->posed.size()), errors, preset, settings};
}

// Queries on the near plane, `side` by `side`, straight lines between.
Over by_grid(const Posed& one, const WaveField& field, const WaveTiles& tiles, int side) {
  std::vector<glm::dvec2> places;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const glm::dvec3 p = one.eye() + one.on_plane(2.0 * i / (side - 1) - 1.0, 2.0 * j / (side - 1) - 1.0);
      places.emplace_back(p.x, p.z);
    }
  std::vector<QueryAnswer> answers(places.size());
  query(field, tiles, places, answers);
  std::vector<double> heights;
  for (const QueryAnswer& a : answers) heights.push_back(a.height_m - one.eye().y);
  const glm::dquat back = glm::conjugate(one.view.eyes[0].pose.orientation);
  const Fov fov = one.view.eyes[0].fov;
  return [=, heights = std::move(heights)](const glm::dvec3& place) {
    const glm::dvec3 p = back * place / near_m;
    const double x = 0.5 * (p.x / fov.right + 1.0) * (side - 1), y = 0.5 * (p.y / fov.up + 1.0) * (side - 1);
    const int i = std::clamp(int(x), 0, side - 2), j = std::clamp(int(y), 0, side - 2);
    const auto at = [&](int di, int dj) { return heights[std::size_t((j + dj) * side + i + di)]; };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), x - i), glm::mix(at(0, 1), at(1, 1), x - i), y - j) - place.y;
  };
}

std::vector<LabTask> waterline_tasks(double wind_mps, const LabOptions& options) {
  const auto lens = std::make_shared<const Lens>(wind_mps, options, "high");
  std::vector<LabTask> tasks;
  const auto add = [&](const std::string& knob, double value, const std::function<Over(const Posed&)>& make) {
    tasks.push_back(task_of(knob, value, lens, make));
  };
  const std::string planes = "a plane: 1 still, 2 felt height, 3 and slope, 4 drawn height and slope";
  add(planes, 1.0,
      [](const Posed& one) -> Over { return [y = one.eye().y](const glm::dvec3& place) { return -y - place.y; }; });
  for (const int kind : {2, 3, 4})
    add(planes, kind, [lens, kind](const Posed& one) -> Over {
      const glm::dvec2 at(one.eye().x, one.eye().z);
      const QueryAnswer water =
          kind == 4 ? Lens::asked(lens->drawn, lens->drawn_tiles, at) : Lens::asked(lens->felt, lens->felt_tiles, at);
      const double over = water.height_m - one.eye().y;
      const glm::dvec2 slope =
          kind == 2 ? glm::dvec2(0.0) : -glm::dvec2(water.normal.x, water.normal.z) / water.normal.y;
      return [=](const glm::dvec3& place) { return over + glm::dot(slope, glm::dvec2(place.x, place.z)) - place.y; };
    });
  for (const int side : options.quick ? std::vector<int>{2, 4, 16} : std::vector<int>{2, 3, 4, 8, 16, 32}) {
    add("felt water, queries a side of the near plane", side,
        [=](const Posed& one) { return by_grid(one, lens->felt, lens->felt_tiles, side); });
    add("drawn waves, queries a side of the near plane", side,
        [=](const Posed& one) { return by_grid(one, lens->drawn, lens->drawn_tiles, side); });
  }
  for (const char* preset : {"low", "medium", "high", "ultra"}) {
    const auto of_preset =
        std::string_view(preset) == "high" ? lens : std::make_shared<const Lens>(wind_mps, options, preset);
    Settings settings;
    apply_preset(settings, preset);
    tasks.push_back(task_of(
        "the drawn triangles cut by the near plane, lod.pixel_error", settings.lod.pixel_error, of_preset,
        [of_preset](const Posed& one) -> Over {
          return [triangles = of_preset->triangles_near(one)](const glm::dvec3& place) {
            // Where none is, a plane through the eye has to do.
            return height_over(triangles, {place.x, place.z}).value_or(0.0) - place.y;
          };
        },
        preset));
  }
  return tasks;
}

}  // namespace

LabCurve waterline_curve() {
  return {"waterline", "The waterline on the near plane", "one eye's near plane", {}, true, false, waterline_tasks};
}

}  // namespace seascape
