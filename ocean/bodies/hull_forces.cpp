#include "ocean/bodies/hull_forces.h"

#include <algorithm>
#include <cmath>

namespace seascape {

double friction_coefficient(double reynolds) {
  if (!(reynolds > 1000.0)) return 1.328 / std::sqrt(std::max(reynolds, 1.0));
  const double log = std::log10(reynolds) - 2.0;
  return 0.075 / (log * log);
}

// Force -rho g A n mean(h), moment X x (-rho g n) with X = A / 12 (sum h sum x + sum h_i x_i): exact where the pressure
// head h is linear over the triangle.
void HullClip::press(const Corner& a, const Corner& b, const Corner& c, const HullMedia& media) {
  const glm::dvec3 area = 0.5 * glm::cross(b.at - a.at, c.at - a.at);  // A n
  const double heads = a.head + b.head + c.head, weight = media.gravity_mps2 * media.density_kg_m3;
  const glm::dvec3 arm =
      (heads * (a.at + b.at + c.at) + a.head * a.at + b.head * b.at + c.head * c.at) / 12.0;  // X / A
  out_.pressure.linear -= weight * heads / 3.0 * area;
  out_.pressure.angular -= weight * glm::cross(arm, area);
  out_.wetted_m2 += glm::length(area);
  out_.facing_down_m2 += std::max(-area.y, 0.0);
  // The volume between the triangle and the surface above it; upper faces count negatively.
  const double depths = a.depth + b.depth + c.depth, volume = -area.y * depths / 3.0;
  out_.submerged_m3 += volume;
  // Of each column the middle lies half its depth higher than its foot.
  const double squares = a.depth * a.depth + b.depth * b.depth + c.depth * c.depth;
  const glm::dvec3 foot = (depths * (a.at + b.at + c.at) + a.depth * a.at + b.depth * b.at + c.depth * c.at) / 12.0;
  moment_ += -area.y * (foot + glm::dvec3(0.0, (depths * depths + squares) / 24.0, 0.0));
}

// Drag of one triangle at its middle: of the wetted part against the water, of the rest against the air.
void HullClip::resist(const std::array<Corner, 3>& t, const glm::dvec3& area, double wet, const BodyPose& pose) {
  const double size = glm::length(area);
  if (!(size > 0.0)) return;
  const glm::dvec3 middle = (t[0].at + t[1].at + t[2].at) / 3.0, normal = area / size;
  const glm::dvec3 own = flow_.velocity.linear + glm::cross(flow_.velocity.angular, middle);
  const HullMedia& media = *flow_.media;
  if (wet > 0.0) {
    const glm::dvec3 world = pose.centre_m + middle;
    const glm::dvec3 water = flow_.water->velocity({world.x, world.z}), slip = own - water;
    const double ahead = glm::dot(slip, normal), speed = glm::length(slip),
                 half = 0.5 * media.density_kg_m3 * size * wet;
    const double skin =
        flow_.drag->friction ? half * friction_coefficient(speed * flow_.length_m / media.viscosity_m2_s) * speed : 0.0;
    const double form = half * (ahead > 0.0 ? flow_.drag->form : flow_.drag->suction) * std::abs(ahead);
    const glm::dmat3 along_normal = glm::outerProduct(normal, normal);
    const glm::dmat3 k = skin * (glm::dmat3(1.0) - along_normal) + form * along_normal;
    out_.resists.add_at(middle, k);
    const glm::dvec3 force = k * water;
    out_.carried.linear += force, out_.carried.angular += glm::cross(middle, force);
  }
  if (wet < 1.0 && flow_.drag->wind > 0.0) {
    const glm::dvec3 slip = own - media.wind_mps;
    const double ahead = glm::dot(slip, normal);
    if (!(ahead > 0.0)) return;  // in the lee
    const double k = 0.5 * media.air_kg_m3 * size * (1.0 - wet) * flow_.drag->wind * ahead;
    out_.resists.add_at(middle, glm::dmat3(k));
    const glm::dvec3 force = k * media.wind_mps;
    out_.carried.linear += force, out_.carried.angular += glm::cross(middle, force);
  }
}

const HullForces& HullClip::forces(const HullMesh& mesh, const BodyPose& pose, const Vector6& velocity,
                                   const WaterPatch& water, const HullMedia& media, const HullDrag& drag,
                                   double length_m) {
  out_ = {};
  moment_ = {};
  flow_ = {velocity, &water, &media, &drag, length_m};
  corners_.resize(mesh.vertices.size());
  for (std::size_t n = 0; n < corners_.size(); ++n) {
    Corner& c = corners_[n];
    c.at = pose.to_world * mesh.vertices[n];
    const glm::dvec3 world = pose.centre_m + c.at;
    const glm::dvec2 place(world.x, world.z);
    const double surface = water.height(place);
    c.depth = surface - world.y;
    // At the surface the pressure is the air's: the head is the depth, less what waves have faded by.
    c.head = c.depth > 0.0 && !water.flat() ? std::max(c.depth - surface + water.head(place, c.depth), 0.0) : c.depth;
    if (water.dry(place)) c.depth = c.head = -1.0;
  }
  for (const auto& indices : mesh.triangles) {
    std::array<Corner, 3> t{corners_[indices[0]], corners_[indices[1]], corners_[indices[2]]};
    const glm::dvec3 area = 0.5 * glm::cross(t[1].at - t[0].at, t[2].at - t[0].at);
    const double before = out_.wetted_m2;
    const int below = (t[0].depth > 0.0) + (t[1].depth > 0.0) + (t[2].depth > 0.0);
    const auto cut = [](const Corner& wet, const Corner& dry) {  // where the depth is 0
      const double f = wet.depth / (wet.depth - dry.depth);
      return Corner{wet.at + f * (dry.at - wet.at), 0.0, 0.0};
    };
    const auto rotate_until = [&](bool first_is_wet) {
      while ((t[0].depth > 0.0) != first_is_wet) std::rotate(t.begin(), t.begin() + 1, t.end());
    };
    if (below == 3) {
      press(t[0], t[1], t[2], media);
    } else if (below == 1) {
      rotate_until(true);
      press(t[0], cut(t[0], t[1]), cut(t[0], t[2]), media);
    } else if (below == 2) {
      rotate_until(false);
      const Corner first = cut(t[1], t[0]), last = cut(t[2], t[0]);
      press(first, t[1], t[2], media);
      press(first, t[2], last, media);
    }
    const double size = glm::length(area);
    resist(t, area, size > 0.0 ? std::min((out_.wetted_m2 - before) / size, 1.0) : 0.0, pose);
  }
  if (out_.submerged_m3 > 0.0) out_.submerged_centre_m = moment_ / out_.submerged_m3;
  return out_;
}

}  // namespace seascape
