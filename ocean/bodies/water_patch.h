// The water around one hull in one step: heights on a grid that turns with it, asked once, and how the waves' pressure
// fades with depth.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "ocean/bodies/body_water.h"

namespace seascape {

// A rectangle of the still sea, and how deep below the surface pressures are wanted.
struct PatchBox {
  glm::dvec2 centre_m{0.0}, along{1.0, 0.0};  // `along`, of length 1: its first axis; the second is (-along.y, along.x)
  glm::dvec2 half_m{1.0};                     // above 0
  double deepest_m = 1.0;                     // above 0
};

// The dynamic pressure below waves is harmonic: each wave of number k fades as cosh k(h - d) / cosh kh with the depth d
// over a bed at h (Airy; Lamb 1932, article 229). The grid's heights without their mean plane are such waves by a
// cosine transform; the plane is of waves longer than the grid and fades by the sea's mean number, as far as that is of
// such waves.
class WaterPatch {
 public:
  // Asks for the heights and keeps them. What is asked has the grid's spacing as footprint. Heights that are no numbers
  // count as the still water.
  void ask(const BodyWater& water, double time_s, const PatchBox& box, int most_samples);

  // Places beyond the rectangle have its border's water. World (x, z), m.
  double height(const glm::dvec2& place) const { return head(place, 0.0); }
  // The height of still water whose pressure at this depth below the surface would be the same.
  double head(const glm::dvec2& place, double depth_m) const;
  // What a place in the world meets: how far it lies below the surface, and its head over it (m; both -1 where it is
  // dry), and the velocity of the water at the surface.
  struct Met {
    double depth_m, head_m;
    glm::dvec3 velocity_mps;
  };
  Met meets(const glm::dvec3& at) const;
  // Of the water at the surface.
  glm::dvec3 velocity(const glm::dvec2& place) const;
  // How fast the water rises, m/s2, averaged over the rectangle at a depth: -(1/rho) dp/dy - g.
  double rise(double depth_m, double gravity_mps2) const;
  // The plane nearest to the heights: at a place, and its normal (length 1).
  double plane(const glm::dvec2& place) const { return mean_ + glm::dot(slope_, from_centre(place)); }
  glm::dvec3 plane_normal() const;
  bool flat() const { return flat_; }
  bool dry() const { return dry_; }                           // no water anywhere in it
  bool any_dry() const { return any_dry_; }                   // somewhere
  bool dry(const glm::dvec2& place) const;                    // at the nearest sample
  const glm::dvec2& current_mps() const { return current_; }  // mean

 private:
  static constexpr int levels = 5;
  struct Cell {
    glm::dvec2 within;  // from the centre along the axes, m, no further than the border
    int i, j;
    double u, v;
  };
  // Which samples a smooth value is of, and how much of each.
  struct Taps {
    std::array<double, 4> x, z;
    std::array<std::size_t, 4> column, row;
  };
  Cell cell(const glm::dvec2& place) const;
  Taps taps(const Cell& c) const;
  glm::dvec2 from_centre(const glm::dvec2& place) const;
  double smooth(const std::vector<double>& grid, const Taps& taps) const;
  double faded(const Cell& c, const Taps& taps, double depth_m) const;
  bool dry(const Cell& c) const;
  glm::dvec3 velocity(const Cell& c) const;
  void fade(double depth_over_bed_m, double wave_number);
  std::array<double, levels> left(double wave_number, double bed_m) const;
  double plane_fades(double depth_m) const;
  void transform(const std::vector<double>& from, std::vector<double>& to);

  PatchBox box_;
  int columns_ = 0, rows_ = 0;
  glm::dvec2 step_m_{1.0}, per_step_{1.0};
  double mean_ = 0.0, still_ = 0.0, long_number_ = 0.0, bed_m_ = 1e6;
  glm::dvec2 slope_{0.0};                          // of the plane, along the rectangle's axes
  std::array<std::vector<double>, levels> heads_;  // less the plane, by depth
  std::array<double, levels> depths_m_{}, rises_{};
  std::array<std::vector<double>, levels> faded_waves_;
  std::vector<double> waves_, faded_;
  std::vector<double> cosines_x_, cosines_z_;
  std::vector<glm::dvec2> places_;
  std::vector<WaterHere> answers_;
  glm::dvec2 current_{0.0};
  bool flat_ = true, dry_ = false, any_dry_ = false;
};

}  // namespace seascape
