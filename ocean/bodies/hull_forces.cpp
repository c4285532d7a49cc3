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
  const double size = glm::length(area);
  out_.wetted_m2 += size, head_m3_ += heads / 3.0 * size;
  out_.facing_down_m2 += std::max(-area.y, 0.0);
  // The volume between the triangle and the surface above it; upper faces count negatively.
  const double depths = a.depth + b.depth + c.depth, volume = -area.y * depths / 3.0;
  out_.submerged_m3 += volume;
  // Of each column the middle lies half its depth higher than its foot.
  const double squares = a.depth * a.depth + b.depth * b.depth + c.depth * c.depth;
  const glm::dvec3 foot = (depths * (a.at + b.at + c.at) + a.depth * a.at + b.depth * b.at + c.depth * c.at) / 12.0;
  moment_ += -area.y * (foot + glm::dvec3(0.0, (depths * depths + squares) / 24.0, 0.0));
}

void HullClip::DragSums::add(const glm::dvec3& r, double even, double normal_part, const glm::dvec3& normal,
                             const glm::dvec3& carrier) {
  even_sum += even;
  const glm::dvec3 er = even * r;
  even_r += er;
  even_rr[0] += er.x * r.x, even_rr[1] += er.y * r.y, even_rr[2] += er.z * r.z;
  even_rr[3] += er.x * r.y, even_rr[4] += er.y * r.z, even_rr[5] += er.z * r.x;
  glm::dvec3 force = even * carrier;
  if (normal_part != 0.0) {
    along.add_along(r, normal, normal_part);
    force += normal_part * glm::dot(normal, carrier) * normal;
  }
  carried.linear += force, carried.angular += glm::cross(r, force);
}

// J^T k J with J = (1, -[r]) and k = even 1 + normal_part n n^T, summed over the triangles.
Matrix6 HullClip::DragSums::resists() const {
  Matrix6 out = along;
  const glm::dvec3& r = even_r;
  const double rr[3][3] = {{0.0, -r.z, r.y}, {r.z, 0.0, -r.x}, {-r.y, r.x, 0.0}};
  const double second[3][3] = {{even_rr[1] + even_rr[2], -even_rr[3], -even_rr[5]},
                               {-even_rr[3], even_rr[2] + even_rr[0], -even_rr[4]},
                               {-even_rr[5], -even_rr[4], even_rr[0] + even_rr[1]}};
  for (std::size_t i = 0; i < 3; ++i) {
    out.rows[i][i] += even_sum;
    for (std::size_t j = 0; j < 3; ++j) {
      out.rows[i][3 + j] -= rr[i][j], out.rows[3 + i][j] += rr[i][j];
      out.rows[3 + i][3 + j] += second[i][j];
    }
  }
  return out;
}

// Drag of one triangle at its middle: of the wetted part against the water, of the rest against the air.
// A face that is left behind is no emptier than the air lets it be: its suction ends where its water's own pressure
// does, and a transom runs dry (at about U^2 = 5 g T, as those of ships do; Doctors 2006).
void HullClip::resist(const std::array<Corner, 3>& t, const glm::dvec3& area, double wet, double head_m3,
                      const BodyPose& pose) {
  const double square = glm::dot(area, area);
  if (!(square > 0.0)) return;
  const double size = std::sqrt(square);
  const glm::dvec3 middle = (t[0].at + t[1].at + t[2].at) * (1.0 / 3.0), normal = area * (1.0 / size);
  const glm::dvec3 own = flow_.velocity.linear + glm::cross(flow_.velocity.angular, middle);
  const HullMedia& media = *flow_.media;
  if (wet > 0.0) {
    const glm::dvec3 world = pose.centre_m + middle;
    const glm::dvec3 water = flow_.water->velocity({world.x, world.z}), slip = own - water;
    const double ahead = glm::dot(slip, normal), speed = glm::length(slip),
                 half = 0.5 * media.density_kg_m3 * size * wet;
    const double skin =
        flow_.drag->friction ? half * friction_coefficient(speed * flow_.length_m / media.viscosity_m2_s) * speed : 0.0;
    const double form = ahead > 0.0
                            ? half * flow_.drag->form * ahead
                            : std::min(half * flow_.drag->suction * -ahead,
                                       media.density_kg_m3 * media.gravity_mps2 * head_m3 / std::max(-ahead, 1e-9));
    drag_.add(middle, skin, form - skin, normal, water);
  }
  if (wet < 1.0 && flow_.drag->wind > 0.0) {
    const double ahead = glm::dot(own - media.wind_mps, normal);
    if (!(ahead > 0.0)) return;  // in the lee
    drag_.add(middle, 0.5 * media.air_kg_m3 * size * (1.0 - wet) * flow_.drag->wind * ahead, 0.0, normal,
              media.wind_mps);
  }
}

const HullForces& HullClip::forces(const HullMesh& mesh, const BodyPose& pose, const Vector6& velocity,
                                   const WaterPatch& water, const HullMedia& media, const HullDrag& drag,
                                   double length_m) {
  out_ = {};
  moment_ = {};
  drag_ = {};
  head_m3_ = 0.0;
  flow_ = {velocity, &water, &media, &drag, length_m};
  corners_.resize(mesh.vertices.size());
  for (std::size_t n = 0; n < corners_.size(); ++n) {
    Corner& c = corners_[n];
    c.at = pose.to_world * mesh.vertices[n];
    const WaterPatch::Below below = water.below(pose.centre_m + c.at);
    c.depth = below.depth_m, c.head = below.head_m;
  }
  for (const auto& indices : mesh.triangles) {
    std::array<Corner, 3> t{corners_[indices[0]], corners_[indices[1]], corners_[indices[2]]};
    const glm::dvec3 area = 0.5 * glm::cross(t[1].at - t[0].at, t[2].at - t[0].at);
    const double before = out_.wetted_m2, head_before = head_m3_;
    const int wet_corners = (t[0].depth > 0.0) + (t[1].depth > 0.0) + (t[2].depth > 0.0);
    const auto cut = [](const Corner& wet, const Corner& dry) {  // where the depth is 0
      const double f = wet.depth / (wet.depth - dry.depth);
      return Corner{wet.at + f * (dry.at - wet.at), 0.0, 0.0};
    };
    const auto rotate_until = [&](bool first_is_wet) {
      while ((t[0].depth > 0.0) != first_is_wet) std::rotate(t.begin(), t.begin() + 1, t.end());
    };
    if (wet_corners == 3) {
      press(t[0], t[1], t[2], media);
    } else if (wet_corners == 1) {
      rotate_until(true);
      press(t[0], cut(t[0], t[1]), cut(t[0], t[2]), media);
    } else if (wet_corners == 2) {
      rotate_until(false);
      const Corner first = cut(t[1], t[0]), last = cut(t[2], t[0]);
      press(first, t[1], t[2], media);
      press(first, t[2], last, media);
    }
    const double size = glm::length(area);
    resist(t, area, size > 0.0 ? std::min((out_.wetted_m2 - before) / size, 1.0) : 0.0, head_m3_ - head_before, pose);
  }
  out_.resists = drag_.resists(), out_.carried = drag_.carried;
  if (out_.submerged_m3 > 0.0) out_.submerged_centre_m = moment_ / out_.submerged_m3;
  return out_;
}

}  // namespace seascape
