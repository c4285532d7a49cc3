#include "app/solids/solid_instances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "ocean/mesh/tree_frame.h"
#include "shaders/shared/fresnel.h"

namespace seascape {

namespace {

// Whether a ball may be seen by an eye, of which it lies at `at` (m).
bool may_see(const Fov& fov, const glm::dvec3& at, double radius) {
  const auto inside = [&](double past, double slope) { return past >= -radius * std::sqrt(1.0 + slope * slope); };
  return -at.z >= -radius && inside(at.x + fov.left * at.z, fov.left) && inside(-at.x - fov.right * at.z, fov.right) &&
         inside(-at.y - fov.up * at.z, fov.up) && inside(at.y + fov.down * at.z, fov.down);
}

// Least and most x and y in clip space of a ball at `at`, as the eye sees it; the whole picture where it surrounds the
// eye.
glm::vec4 in_picture(const Fov& fov, const glm::dvec3& at, double radius) {
  const auto slopes = [&](double across) {
    const double away = std::hypot(across, at.z);
    if (away <= radius) return glm::dvec2(-1e9, 1e9);
    const double middle = std::atan2(across, -at.z), half = std::asin(radius / away),
                 quarter = 0.5 * std::numbers::pi - 1e-6;
    return glm::dvec2(std::tan(std::clamp(middle - half, -quarter, quarter)),
                      std::tan(std::clamp(middle + half, -quarter, quarter)));
  };
  const auto clip = [](double slope, double least, double most) {
    return std::clamp(2.0 * (slope - least) / (most - least) - 1.0, -2.0, 2.0);
  };
  const glm::dvec2 x = slopes(at.x), y = slopes(at.y);
  return {float(clip(x[0], fov.left, fov.right)), float(-clip(y[1], fov.down, fov.up)),
          float(clip(x[1], fov.left, fov.right)), float(-clip(y[0], fov.down, fov.up))};
}

// Whether light from a ball at `at` may leave the water towards the eye: the surface, however it slopes, turns it by no
// more than Snell's law turns what runs along it.
bool may_be_refracted_to(const Fov& fov, const glm::dvec3& at, double radius) {
  const double away = glm::length(at);
  if (away <= radius) return true;
  const double corner = std::atan(std::hypot(std::max(-fov.left, fov.right), std::max(fov.up, -fov.down))),
               most_turn = std::acos(1.0 / double(gpu::water_index));
  return std::acos(std::clamp(-at.z / away, -1.0, 1.0)) - std::asin(radius / away) <= corner + most_turn;
}

glm::vec4 around(const glm::vec4& a, const glm::vec4& b) {
  return {glm::min(a.x, b.x), glm::min(a.y, b.y), glm::max(a.z, b.z), glm::max(a.w, b.w)};
}

glm::dvec3 in_eye(const View& eye, const glm::dvec3& place) {
  return glm::conjugate(eye.pose.orientation) * (place - eye.pose.position_m);
}

// What the picture of things under water sees.
Fov widened(const Fov& fov) {
  const double across = 0.5 * (gpu::solid_margin - 1.0) * (fov.right - fov.left),
               along = 0.5 * (gpu::solid_margin - 1.0) * (fov.up - fov.down);
  return {fov.left - across, fov.right + across, fov.up + along, fov.down - along};
}

gpu::SolidInstance instance(const glm::dmat4& world, const glm::dvec3& viewer_m, int picture) {
  gpu::SolidInstance made;
  made.picture = glm::vec4(float(picture), 0.0f, 0.0f, 0.0f);
  glm::vec4* const rows[3] = {&made.row_x, &made.row_y, &made.row_z};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) (*rows[row])[column] = float(world[column][row]);
    rows[row]->w = float(world[3][row] - (row == 1 ? 0.0 : viewer_m[row]));
  }
  return made;
}

}  // namespace

PlacedModel::PlacedModel(std::shared_ptr<const SolidModel> model) : model_(std::move(model)) {
  struct How {
    bool drawn = false;
    int chosen_by = -1, level = 0;
  };
  std::vector<How> how(model_->nodes.size());
  for (const int root : model_->drawn) how[std::size_t(root)].drawn = true;
  for (const int index : model_->order) {
    const SolidNode& node = model_->nodes[std::size_t(index)];
    How& own = how[std::size_t(index)];
    if (node.parent >= 0 && !own.drawn) own = how[std::size_t(node.parent)];
    if (!own.drawn) continue;
    if (!node.coarser.empty()) {
      own.chosen_by = index;
      own.level = 0;
      for (std::size_t i = 0; i < node.coarser.size(); ++i)
        how[std::size_t(node.coarser[i])] = {true, index, int(i) + 1};
    }
    if (node.mesh >= 0) parts_.push_back({node.mesh, index, own.chosen_by, own.level});
  }
  still_ = placed_nodes(*model_);
  insides_ = inside_hulls(*model_);
  sheets_.resize(model_->nodes.size());
  for (SolidPart& part : parts_) {
    part.mirrored = glm::determinant(glm::dmat3(still_[std::size_t(part.node)])) < 0.0;
    for (const SolidPrimitive& one : model_->meshes[std::size_t(part.mesh)].primitives)
      if (part.chosen_by >= 0 && one.material >= 0 && model_->materials[std::size_t(one.material)].double_sided)
        sheets_[std::size_t(part.chosen_by)] = true;
  }
  bound();
  count();
}

void PlacedModel::count() {
  std::vector<std::vector<std::size_t>> levels(model_->nodes.size());  // of each node that chooses: parts a level
  for (const SolidPart& part : parts_) {
    if (part.chosen_by < 0) {
      ++most_parts_;
      continue;
    }
    std::vector<std::size_t>& own = levels[std::size_t(part.chosen_by)];
    own.resize(std::max(own.size(), std::size_t(part.level) + 1));
    ++own[std::size_t(part.level)];
  }
  for (const std::vector<std::size_t>& own : levels)
    if (!own.empty()) most_parts_ += *std::max_element(own.begin(), own.end());
}

void PlacedModel::bound() {
  // Where a part may be: as the file leaves it, and at moments of what moves it.
  std::vector<std::vector<glm::dmat4>> moments{still_};
  if (!model_->animations.empty())
    for (int i = 0; i < 32; ++i)
      moments.push_back(
          placed_nodes(*model_, &model_->animations.front(), model_->animations.front().duration_s * i / 32.0));
  const auto ball_of = [](const auto& each, glm::dvec3& half_sides) {
    glm::dvec3 least(std::numeric_limits<double>::max()), most(-least);
    each([&](const glm::dvec3& place) {
      least = glm::min(least, place);
      most = glm::max(most, place);
    });
    if (least.x > most.x) return glm::dvec4(0.0);
    const glm::dvec3 middle = 0.5 * (least + most);
    half_sides = 0.5 * (most - least);
    double radius = 0.0;
    each([&](const glm::dvec3& place) { radius = std::max(radius, glm::length(place - middle)); });
    return glm::dvec4(middle, radius);
  };
  const auto corners = [&](const SolidPart& part, const auto& take) {
    for (const SolidPrimitive& one : model_->meshes[std::size_t(part.mesh)].primitives)
      for (const glm::vec3& place : one.positions) take(glm::dvec3(place));
  };
  balls_.assign(model_->nodes.size(), glm::dvec4(0.0));
  boxes_.assign(model_->nodes.size(), glm::dvec3(0.0));
  for (const SolidPart& part : parts_)
    balls_[std::size_t(part.node)] =
        ball_of([&](const auto& take) { corners(part, take); }, boxes_[std::size_t(part.node)]);
  const glm::dvec4 all = ball_of(
      [&](const auto& take) {
        for (const SolidPart& part : parts_)
          for (const std::vector<glm::dmat4>& nodes : moments)
            corners(part, [&](const glm::dvec3& place) {
              take(glm::dvec3(nodes[std::size_t(part.node)] * glm::dvec4(place, 1.0)));
            });
      },
      half_sides_);
  middle_ = glm::dvec3(all);
  radius_ = all.w;
  if (model_->animations.empty()) return;
  radius_ *= 1.1;  // between those moments
  half_sides_ = glm::dvec3(radius_);
}

const std::vector<glm::dmat4>& PlacedModel::nodes_at(double time_s, MovedNodes& room) const {
  return model_->animations.empty() ? still_ : place_nodes(*model_, &model_->animations.front(), time_s, room);
}

int PlacedModel::level(int node, double share) const {
  const SolidNode& chooses = model_->nodes[std::size_t(node)];
  const std::size_t levels = chooses.coarser.size() + 1;
  for (std::size_t i = 0; i < levels; ++i) {
    // Where a file is silent each level holds from a quarter of the size of the one before.
    const double usual = i + 1 == levels ? 0.0 : 0.25 * std::pow(0.25, double(i));
    const double least = i < chooses.coverage.size() ? double(chooses.coverage[i]) : usual;
    if (share >= least) return int(i);
  }
  return int(levels);
}

namespace {

// Where a thing is: the ball that holds it, as on a still sea laid flat and on the curved one, and its lowest point.
struct Bounds {
  glm::dvec3 flat{0.0}, middle{0.0};
  double radius = 0.0, lowest_m = 0.0;
};

Bounds bounds_of(const PlacedModel& model, const SolidThing& thing, const glm::dvec3& viewer_m) {
  Bounds bounds;
  bounds.flat = bounds.middle = thing.pose.position_m + thing.pose.orientation * (thing.scale * model.middle());
  bounds.radius = model.radius() * thing.scale;
  const glm::dmat3 axes = glm::mat3_cast(thing.pose.orientation);
  const glm::dvec3 up = glm::abs(glm::dvec3(axes[0].y, axes[1].y, axes[2].y));
  bounds.lowest_m = bounds.flat.y - thing.scale * glm::dot(up, model.half_sides());
  const glm::dvec3 away = bounds.flat - viewer_m;
  bounds.middle.y -= curvature_drop(away.x * away.x + away.z * away.z);
  return bounds;
}

// How much of their size counts for levels of detail: of sheets, and of all else.
struct Detail {
  double others, sheets;
};

// Whether a part looks smaller than that, in radians. A wheel on a boat is missed less than a buoy of its size.
bool looks_small(const PartBounds& part, double away_m, double smallest) {
  return 2.0 * part.radius < (part.radius < 0.25 * part.thing_radius ? 2.0 : 1.0) * smallest * away_m;
}
// Waves break up what looks smaller through them.
constexpr double smallest_through_water = 0.044;  // two degrees and a half

// `wanted`: of Bounds, whether the thing is; `part_wanted`: of PartBounds, in which pictures, a bit each, where it is
// drawn into several, or else whether at all.
template <typename Seen, typename PartSeen>
void select(std::span<const PlacedModel> models, std::span<const SolidThing> things, const Viewpoint& viewpoint,
            double time_s, SolidSelection& selection, const Detail& detail, const Seen& wanted,
            const PartSeen& part_wanted, const NearWaterSight& water = {}) {
  selection.draws.clear();
  selection.instances.clear();
  std::vector<SolidSelection::Seen>& seen = selection.seen;
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  double tall = 2.0;
  for (const View& eye : viewpoint.eyes) tall = std::min(tall, eye.fov.up - eye.fov.down);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const PlacedModel& model = models[m];
    seen.clear();
    for (const SolidThing& thing : things) {
      if (thing.model != m) continue;
      const Bounds bounds = bounds_of(model, thing, viewer);
      const double range = std::max(glm::length(bounds.middle - viewer), 1e-3);
      if (!wanted(bounds)) continue;
      if (viewpoint.pixels_per_radian > 0.0 && 2.0 * bounds.radius / range * viewpoint.pixels_per_radian < 0.7)
        continue;
      glm::dmat4 world = glm::mat4_cast(thing.pose.orientation);
      for (int c = 0; c < 3; ++c) world[c] *= thing.scale;
      world[3] = glm::dvec4(thing.pose.position_m, 1.0);
      seen.push_back({&thing, range, world});
    }
    if (seen.empty()) continue;
    std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) {
      return a.range_m != b.range_m ? a.range_m > b.range_m : a.thing < b.thing;
    });
    const std::vector<glm::dmat4>& usual = model.nodes_at(time_s, selection.moved);
    const auto node_at = [&](const SolidSelection::Seen& one, int node) -> const glm::dmat4& {
      return (one.thing->nodes.empty() ? usual : one.thing->nodes)[std::size_t(node)];
    };
    const auto shown_level = [&](int node, const SolidSelection::Seen& one) {
      const glm::dvec4& ball = model.ball(node);
      const glm::dmat4 world = one.world * node_at(one, node);
      const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(world))));
      const double range = glm::length(glm::dvec3(world * glm::dvec4(glm::dvec3(ball), 1.0)) - viewer);
      const double share = 2.0 * ball.w * scale / (std::max(range, 1e-3) * tall);
      const int own = model.level(node, share), last = int(model.model().nodes[std::size_t(node)].coarser.size());
      const double counts = share * (model.sheet(node) ? detail.sheets : detail.others);
      return own > last ? own : std::min(model.level(node, counts), last);
    };
    for (std::size_t p = 0; p < model.parts().size(); ++p) {
      const SolidPart& part = model.parts()[p];
      SolidDraw draw{m, p, selection.instances.size()};
      draw.through_air = false;
      std::size_t before_water = 0;
      for (const SolidSelection::Seen& one : seen) {
        if (part.chosen_by >= 0 && shown_level(part.chosen_by, one) != part.level) continue;
        const glm::dmat4 world = one.world * node_at(one, part.node);
        const glm::dvec4& ball = model.ball(part.node);
        const double longest = std::max(
            {glm::length(glm::dvec3(world[0])), glm::length(glm::dvec3(world[1])), glm::length(glm::dvec3(world[2]))});
        const glm::dvec3 up(world[0].y, world[1].y, world[2].y);
        const PartBounds bounds{glm::dvec3(world * glm::dvec4(glm::dvec3(ball), 1.0)), ball.w * longest,
                                glm::dot(glm::abs(up), model.box(part.node)), one.thing->scale * model.radius()};
        const auto pictures = unsigned(part_wanted(bounds));
        if (pictures == 0) continue;
        draw.through_air = draw.through_air || water.through_air(bounds);
        if (before_water == selection.instances.size() - draw.first && !water.through_water(bounds, viewer))
          ++before_water;
        if (draw.range_m == 0.0) draw.range_m = one.range_m;
        for (int picture = 0; pictures >> picture != 0; ++picture)
          if ((pictures >> picture & 1u) != 0) selection.instances.push_back(instance(world, viewer, picture));
      }
      draw.count = selection.instances.size() - draw.first;
      draw.through_water = draw.count - before_water;
      if (draw.count > 0) selection.draws.push_back(draw);
    }
  }
  selection.far_first.resize(selection.draws.size());
  std::iota(selection.far_first.begin(), selection.far_first.end(), std::size_t{0});
  std::sort(selection.far_first.begin(), selection.far_first.end(), [&](std::size_t a, std::size_t b) {
    const double of_a = selection.draws[a].range_m, of_b = selection.draws[b].range_m;
    return of_a != of_b ? of_a > of_b : a < b;
  });
}

}  // namespace

bool NearWaterSight::through_water(const PartBounds& part, const glm::dvec3& viewer_m) const {
  const glm::dvec3 away = part.flat - viewer_m;
  if (glm::length(away) - part.radius > sight_m) return false;
  if (portals == nullptr) return high_air || part.flat.y - part.up_m < highest_m;
  return portals->may_show(away, part.radius + curvature_drop(away.x * away.x + away.z * away.z));
}

void select_solids(std::span<const PlacedModel> models, std::span<const SolidThing> things, const Viewpoint& viewpoint,
                   double time_s, double detail, SolidSelection& selection, const NearWaterSight& water) {
  const auto seen = [&](const Bounds& thing) {
    return std::any_of(viewpoint.eyes.begin(), viewpoint.eyes.end(),
                       [&](const View& eye) { return may_see(eye.fov, in_eye(eye, thing.middle), thing.radius); });
  };
  select(
      models, things, viewpoint, time_s, selection, {detail, detail}, seen, [](const PartBounds&) { return true; },
      water);
}

gpu::SolidsThroughWater select_in_water(std::span<const PlacedModel> models, std::span<const SolidThing> things,
                                        const Viewpoint& viewpoint, double time_s, double detail, double highest_m,
                                        SolidSelection& selection) {
  const glm::vec4 nowhere(9, 9, -9, -9);
  gpu::SolidsThroughWater water{{nowhere, nowhere}, {float(highest_m), float(highest_m), 0, 0}, {}};
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  // From a degree and a half above it water mirrors nearly all.
  const double farthest_m = std::min(600.0, 40.0 * (std::max(viewer.y - highest_m, 0.0) + 0.5));
  const auto seen = [&](const Bounds& thing) {
    if (thing.lowest_m >= highest_m || glm::length(thing.flat - viewer) > farthest_m + thing.radius) return false;
    // All that is near counts, whichever eye sees it, so that an eye by itself sees the same.
    water.reach.x = std::min(water.reach.x, float(thing.lowest_m));
    const bool in_sight = std::any_of(viewpoint.eyes.begin(), viewpoint.eyes.end(), [&](const View& eye) {
      return may_see(widened(eye.fov), in_eye(eye, thing.middle), thing.radius);
    });
    for (std::size_t i = 0; in_sight && i < viewpoint.eyes.size() && i < 2; ++i)
      water.seen[i] = around(water.seen[i],
                             in_picture(viewpoint.eyes[i].fov, in_eye(viewpoint.eyes[i], thing.middle), thing.radius));
    return in_sight;
  };
  // Water bends and dims what is seen in it: coarse levels of detail are enough.
  select(models, things, viewpoint, time_s, selection, {detail / 16.0, detail / 16.0}, seen,
         [&](const PartBounds& part) {
           return part.flat.y - part.up_m < highest_m &&
                  !looks_small(part, glm::length(part.flat - viewer), smallest_through_water);
         });
  // A thing's bounds may reach into the water where none of its parts does: then nothing is drawn to be seen there.
  if (selection.draws.empty()) water.seen[0] = water.seen[1] = nowhere;
  return water;
}

double select_above(std::span<const PlacedModel> models, std::span<const SolidThing> things, const Viewpoint& viewpoint,
                    const glm::dvec3& middle_m, double time_s, double detail, double deepest_m,
                    SolidSelection& selection) {
  double nearest_m = std::numeric_limits<double>::max();
  select(
      models, things, {viewpoint.viewer, {}}, time_s, selection, {detail / 16.0, detail / 16.0},
      [&](const Bounds& thing) { return 2.0 * thing.flat.y - thing.lowest_m > -deepest_m; },
      [&](const PartBounds& part) {
        unsigned sides = 0;
        if (part.flat.y + part.up_m <= -deepest_m ||
            looks_small(part, glm::length(part.flat - viewpoint.viewer.position_m), smallest_through_water))
          return sides;
        const glm::dvec3 away = part.flat - middle_m;
        nearest_m = std::min(nearest_m, std::max(glm::length(away) - part.radius, 0.05));
        // The pictures are of the curved sea.
        const double radius = part.radius + curvature_drop(away.x * away.x + away.z * away.z);
        if (std::none_of(viewpoint.eyes.begin(), viewpoint.eyes.end(),
                         [&](const View& eye) { return may_be_refracted_to(eye.fov, in_eye(eye, part.flat), radius); }))
          return sides;
        for (int side = 0; side < gpu::solids_above_sides; ++side) {
          const glm::dvec3 own(gpu::in_side_above(glm::vec3(away), side));
          const Fov fov{-1.0, 1.0, 1.0, side == 0 ? -1.0 : -double(gpu::solids_above_down)};
          if (may_see(fov, {own.x, own.y, -own.z}, radius)) sides |= 1u << side;
        }
        return sides;
      });
  return selection.draws.empty() ? 0.0 : nearest_m;
}

void select_casters(std::span<const PlacedModel> models, std::span<const SolidThing> things, const Viewpoint& viewpoint,
                    const SunView& sun, double time_s, double detail, SolidSelection& selection) {
  // Nobody misses a shadow that looks smaller than a degree wherever it falls.
  const auto small = [&](const PartBounds& part) {
    const glm::dvec3 to_viewer = viewpoint.viewer.position_m - part.flat;
    const double past = std::max(glm::dot(to_viewer, -sun.near), 0.0);
    return looks_small(part, glm::length(to_viewer + past * sun.near), 0.0175);
  };
  // Nor are shadows seen as sharp as what throws them.
  select(
      models, things, viewpoint, time_s, selection, {0.25 * detail, detail},
      [&](const Bounds& thing) { return sun.may_shade(thing.flat, thing.radius); },
      [&](const PartBounds& part) { return sun.may_shade(part.flat, part.radius) && !small(part); });
}

}  // namespace seascape
