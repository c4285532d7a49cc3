#include "ocean/bodies/probes.h"

#include <algorithm>
#include <cmath>

namespace seascape {
namespace {

class StillWater : public BodyWater {
 public:
  void ask(double, double, std::span<const glm::dvec2>, std::span<WaterHere> answers) const override {
    for (WaterHere& a : answers) a = {};
  }
  double wave_number() const override { return 0.0; }
  std::optional<CalmWater> calm(double, const glm::dvec2&, double) const override { return CalmWater{}; }
};

}  // namespace

FloatingUpright float_upright(const HullMesh& mesh, double mass, const HullMedia& media) {
  double lowest = 1e300, highest = -1e300;
  for (const glm::dvec3& v : mesh.vertices) lowest = std::min(lowest, v.y), highest = std::max(highest, v.y);
  WaterPatch water;
  water.ask(StillWater{}, 0.0, {}, 2);
  HullClip clip(mesh);
  HullDrag none;
  none.friction = false, none.form = none.suction = none.wind = 0.0;
  const auto at = [&](double waterline) {
    return clip.forces({{0.0, -waterline, 0.0}, glm::dmat3(1.0)}, {}, water, media, none, 1.0);
  };
  const double wanted = mass / media.density_kg_m3;
  FloatingUpright out;
  out.floats = at(highest).submerged_m3 > wanted;
  double low = lowest, high = highest;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (at(middle).submerged_m3 < wanted ? low : high) = middle;
  }
  out.waterline_m = high;
  const HullForces here = at(out.waterline_m);
  out.facing_down_m2 = here.facing_down_m2;
  out.displaced_m3 = here.submerged_m3, out.buoyancy_m = here.submerged_centre_m;
  // The waterplane is what the volume grows by, and its moments those of what grows, between two near waterlines.
  const double step = 1e-4 * (highest - lowest);
  const double below = std::max(out.waterline_m - step, lowest), above = std::min(out.waterline_m + step, highest);
  const auto plane = [&](const glm::dvec2& turn) {
    // Upright the hull's pressure moment about x and z in water that is a plane through the middle gives the moments.
    const double c = std::cos(turn.x), s = std::sin(turn.x), e = std::cos(turn.y), f = std::sin(turn.y);
    const glm::dmat3 pitch(1, 0, 0, 0, c, s, 0, -s, c), roll(e, f, 0, -f, e, 0, 0, 0, 1);
    const glm::dmat3 to_world = pitch * roll;
    const glm::dvec3 pivot(out.flotation_m.x, out.waterline_m, out.flotation_m.y);
    return glm::transpose(to_world) *
           clip.forces({-(to_world * pivot), to_world}, {}, water, media, none, 1.0).submerged_centre_m;
  };
  const HullForces lower = at(below);
  const double less = lower.submerged_m3;
  const glm::dvec3 less_moment = less * lower.submerged_centre_m;
  const HullForces upper = at(above);
  const double more = upper.submerged_m3 - less;
  out.waterplane_m2 = more / std::max(above - below, 1e-300);
  if (more > 0.0) {
    const glm::dvec3 middle = (upper.submerged_m3 * upper.submerged_centre_m - less_moment) / more;
    out.flotation_m = {middle.x, middle.z};
  }
  // Turned by a small angle a about the waterplane's middle, buoyancy moves by a I / V.
  constexpr double angle = 1e-4;
  const double volume = out.displaced_m3 / (2.0 * angle);
  out.moments_m4 = glm::max(glm::dvec2((plane({0.0, -angle}).x - plane({0.0, angle}).x) * volume,
                                       (plane({angle, 0.0}).z - plane({-angle, 0.0}).z) * volume),
                            glm::dvec2(0.0));
  return out;
}

ProbeColumns columns_of(const HullMesh& mesh, const FloatingUpright& upright) {
  ProbeColumns out;
  const double area = std::max(upright.waterplane_m2, 1e-9 + 0.01 * std::pow(upright.displaced_m3, 2.0 / 3.0));
  const glm::dvec2 spread = glm::sqrt(upright.moments_m4 / area);
  for (int n = 0; n < 4; ++n)
    out.places_m[std::size_t(n)] =
        upright.flotation_m + spread * glm::dvec2(n % 2 != 0 ? 1.0 : -1.0, n > 1 ? 1.0 : -1.0);
  const double draught = upright.displaced_m3 / area;
  out.area_m2 = 0.25 * area, out.draught_m = draught;
  out.foot_m = upright.waterline_m - draught;
  out.height_m = volume_of(mesh).volume_m3 / area;
  out.lift_m = upright.buoyancy_m.y - (upright.waterline_m - 0.5 * draught);
  for (const glm::dvec3& v : mesh.vertices) out.reach_m = std::max(out.reach_m, 2.0 * std::hypot(v.x, v.z));
  return out;
}

HullForces probe_forces(const ProbeColumns& columns, const BodyPose& pose, const Vector6& velocity,
                        const WaterPatch& water, const HullMedia& media, const HullDrag& drag) {
  HullForces out;
  const glm::dvec3 up = pose.to_world[1], normal = water.plane_normal();
  glm::dvec3 moment(0.0);
  for (const glm::dvec2& at : columns.places_m) {
    const glm::dvec3 foot = pose.to_world * glm::dvec3(at.x, columns.foot_m, at.y);
    const glm::dvec3 middle = foot + 0.5 * columns.height_m * up;
    const glm::dvec3 world = pose.centre_m + middle;
    const glm::dvec2 place(world.x, world.z);
    if (water.dry(place)) continue;
    // Upside down or on its side it floats as high, by the share of its height that is in the water.
    const double tall = std::max(std::abs(up.y), 0.1) * columns.height_m, end = world.y - 0.5 * tall;
    const double depth =
        0.5 * std::clamp(water.height(place) - end, 0.0, tall);  // where waves have faded by half of it
    const double share = std::clamp((water.head(place, depth) - end) / tall, 0.0, 1.0);
    if (!(share > 0.0)) continue;
    const double volume = share * columns.area_m2 * columns.height_m;
    const double along = up.y >= 0.0 ? 0.5 * share * columns.height_m : columns.height_m * (1.0 - 0.5 * share);
    const glm::dvec3 acts = foot + up * (along + columns.lift_m);
    const glm::dvec3 force = media.density_kg_m3 * media.gravity_mps2 * volume * normal / normal.y;
    out.pressure = out.pressure + Vector6{force, glm::cross(acts, force)};
    out.submerged_m3 += volume, moment += volume * acts;
    out.facing_down_m2 += std::min(share * 20.0, 1.0) * columns.area_m2;  // wet from a twentieth on
    const glm::dvec3 carried = water.velocity(place),
                     slip = velocity.linear + glm::cross(velocity.angular, acts) - carried;
    const double side = std::sqrt(share * columns.height_m * std::sqrt(columns.area_m2));
    const glm::dmat3 k(0.5 * media.density_kg_m3 * side * side * drag.form * glm::length(slip));
    out.resists.add_at(acts, k);
    const glm::dvec3 pull = k * carried;
    out.carried = out.carried + Vector6{pull, glm::cross(acts, pull)};
  }
  if (out.submerged_m3 > 0.0) out.submerged_centre_m = moment / out.submerged_m3;
  return out;
}

}  // namespace seascape
