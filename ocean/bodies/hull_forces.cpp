#include "ocean/bodies/hull_forces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ocean/bodies/rigid_body.h"

namespace seascape {

double friction_coefficient(double reynolds) {
  if (!(reynolds > 1000.0)) return 1.328 / std::sqrt(std::max(reynolds, 1.0));
  const double log = std::log(reynolds) * std::numbers::log10e - 2.0;
  return 0.075 / (log * log);
}

HullClip::HullClip(HullMesh mesh) : mesh_(std::move(mesh)), corners_(mesh_.vertices.size()) {
  for (std::size_t n = 0; n < corners_.size(); ++n) corners_[n].at = mesh_.vertices[n];
  faces_.reserve(mesh_.triangles.size());
  for (const auto& t : mesh_.triangles) {
    const glm::dvec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    Face& face = faces_.emplace_back();
    const glm::dvec3 area = 0.5 * glm::cross(b - a, c - a);
    face.size_m2 = glm::length(area), face.middle = (a + b + c) / 3.0;
    if (face.size_m2 > 0.0) face.normal = area / face.size_m2;
    face.turn = glm::cross(face.middle, face.normal);
  }
}

// Force -rho g A n mean(h), moment X x (-rho g n) with X = A / 12 (sum h sum x + sum h_i x_i): exact where the pressure
// head h is linear over the triangle.
void HullClip::Pressed::add(const Corner& a, const Corner& b, const Corner& c, const glm::dvec3& area, double size,
                            const glm::dvec3& up) {
  const glm::dvec3 corners = a.at + b.at + c.at;
  const double heads = a.head + b.head + c.head, mean = heads / 3.0;
  const glm::dvec3 arm = (heads * corners + a.head * a.at + b.head * b.at + c.head * c.at) / 12.0;  // X / A
  linear += mean * area, angular += glm::cross(arm, area);
  wetted_m2 += size, head_m3 += mean * size;
  const double down = -glm::dot(area, up);
  facing_down_m2 += std::max(down, 0.0);
  // The volume between the triangle and the surface above it; upper faces count negatively.
  const double depths = a.depth + b.depth + c.depth;
  submerged_m3 += down * depths / 3.0;
  // Of each column the middle lies half its depth higher than its foot.
  const double squares = a.depth * a.depth + b.depth * b.depth + c.depth * c.depth;
  const glm::dvec3 foot = (depths * corners + a.depth * a.at + b.depth * b.at + c.depth * c.at) / 12.0;
  moment += down * (foot + (depths * depths + squares) / 24.0 * up);
}

// The wetted part of a triangle of which one or two corners are wet: one triangle, or two.
void HullClip::clip(const Face& face, const std::array<const Corner*, 3>& t, int wet_corners, const glm::dvec3& up) {
  const auto cut = [](const Corner& wet, const Corner& dry) {  // where the depth is 0
    const double f = wet.depth / (wet.depth - dry.depth);
    return Corner{wet.at + f * (dry.at - wet.at), 0.0, 0.0, {}};
  };
  const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
    const glm::dvec3 area = 0.5 * glm::cross(b.at - a.at, c.at - a.at);
    pressed_.add(a, b, c, area, glm::dot(area, face.normal), up);
  };
  std::size_t odd = 0;  // the corner that is wet or dry alone
  while ((t[odd]->depth > 0.0) != (wet_corners == 1)) ++odd;
  const Corner &a = *t[odd], &b = *t[(odd + 1) % 3], &c = *t[(odd + 2) % 3];
  if (wet_corners == 1) {
    add(a, cut(a, b), cut(a, c));
  } else {
    const Corner first = cut(b, a), last = cut(c, a);
    add(first, b, c);
    add(first, c, last);
  }
}

void HullClip::DragSums::add_even(const glm::dvec3& r, double part, const glm::dvec3& carrier) {
  const glm::dvec3 pr = part * r, force = part * carrier;
  even_sum += part, even_r += pr;
  even_rr[0] += pr.x * r.x, even_rr[1] += pr.y * r.y, even_rr[2] += pr.z * r.z;
  even_rr[3] += pr.x * r.y, even_rr[4] += pr.y * r.z, even_rr[5] += pr.z * r.x;
  carried.linear += force, carried.angular += glm::cross(r, force);
}

// w w^T with w = J^T n.
void HullClip::DragSums::add_normal(const Face& face, double part, const glm::dvec3& carrier) {
  const glm::dvec3 &n = face.normal, &turn = face.turn;
  const std::array<double, 6> w{n.x, n.y, n.z, turn.x, turn.y, turn.z};
  std::size_t at = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const double row = part * w[i];
    for (std::size_t j = i; j < 6; ++j) along[at++] += row * w[j];
  }
  const double force = part * glm::dot(n, carrier);
  carried.linear += force * n, carried.angular += force * turn;
}

// J^T k J with J = (1, -[r]) and k = even 1 + normal_part n n^T, summed over the triangles.
Matrix6 HullClip::DragSums::resists() const {
  Matrix6 out;
  std::size_t n = 0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i; j < 6; ++j) out.rows[i][j] = out.rows[j][i] = along[n++];
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
void HullClip::resist(const Face& face, const Flow& flow, const glm::dvec3& carrier, double wet, double head_m3) {
  const HullMedia& media = *flow.media;
  const double own_ahead = glm::dot(flow.velocity.linear, face.normal) + glm::dot(flow.velocity.angular, face.turn);
  if (wet > 0.0) {
    const double ahead = own_ahead - glm::dot(carrier, face.normal),
                 half = 0.5 * media.density_kg_m3 * face.size_m2 * wet;
    const double form = ahead > 0.0
                            ? half * flow.drag->form * ahead
                            : std::min(half * flow.drag->suction * -ahead,
                                       media.density_kg_m3 * media.gravity_mps2 * head_m3 / std::max(-ahead, 1e-9));
    double skin = 0.0;
    if (flow.drag->friction) {
      const glm::dvec3 own = flow.velocity.linear + glm::cross(flow.velocity.angular, face.middle);
      const double speed = glm::length(own - carrier);
      skin = half * friction_coefficient(speed * flow.length_m / media.viscosity_m2_s) * speed;
      drag_.add_even(face.middle, skin, carrier);
    }
    drag_.add_normal(face, form - skin, carrier);
  }
  if (wet < 1.0 && flow.drag->wind > 0.0) {
    const double ahead = own_ahead - glm::dot(flow.wind_mps, face.normal);
    if (!(ahead > 0.0)) return;  // in the lee
    drag_.add_even(face.middle, 0.5 * media.air_kg_m3 * face.size_m2 * (1.0 - wet) * flow.drag->wind * ahead,
                   flow.wind_mps);
  }
}

const HullForces& HullClip::forces(const BodyPose& pose, const Vector6& velocity, const WaterPatch& water,
                                   const HullMedia& media, const HullDrag& drag, double length_m) {
  pressed_ = {};
  drag_ = {};
  const glm::dmat3 to_body = glm::transpose(pose.to_world);
  const glm::dvec3 up = to_body[1];
  const Flow flow{
      {to_body * velocity.linear, to_body * velocity.angular}, to_body * media.wind_mps, &media, &drag, length_m};
  for (Corner& c : corners_) {
    const WaterPatch::Met met = water.meets(pose.centre_m + pose.to_world * c.at);
    c.depth = met.depth_m, c.head = met.head_m, c.carrier = to_body * met.velocity_mps;
  }
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    const Face& face = faces_[n];
    if (!(face.size_m2 > 0.0)) continue;
    const auto& indices = mesh_.triangles[n];
    const Corner &a = corners_[indices[0]], &b = corners_[indices[1]], &c = corners_[indices[2]];
    const int wet_corners = (a.depth > 0.0) + (b.depth > 0.0) + (c.depth > 0.0);
    const double before = pressed_.wetted_m2, head_before = pressed_.head_m3;
    double wet = wet_corners == 3 ? 1.0 : 0.0;
    if (wet_corners == 3) {
      pressed_.add(a, b, c, face.size_m2 * face.normal, face.size_m2, up);
    } else if (wet_corners > 0) {
      clip(face, {&a, &b, &c}, wet_corners, up);
      wet = std::clamp((pressed_.wetted_m2 - before) / face.size_m2, 0.0, 1.0);
    }
    resist(face, flow, (a.carrier + b.carrier + c.carrier) / 3.0, wet, pressed_.head_m3 - head_before);
  }
  const double weight = media.gravity_mps2 * media.density_kg_m3;
  out_.pressure = {pose.to_world * (-weight * pressed_.linear), pose.to_world * (-weight * pressed_.angular)};
  out_.resists = turned(drag_.resists(), pose.to_world);
  out_.carried = {pose.to_world * drag_.carried.linear, pose.to_world * drag_.carried.angular};
  out_.wetted_m2 = pressed_.wetted_m2, out_.submerged_m3 = pressed_.submerged_m3;
  out_.facing_down_m2 = pressed_.facing_down_m2;
  out_.submerged_centre_m =
      out_.submerged_m3 > 0.0 ? pose.to_world * (pressed_.moment / out_.submerged_m3) : glm::dvec3(0.0);
  return out_;
}

}  // namespace seascape
