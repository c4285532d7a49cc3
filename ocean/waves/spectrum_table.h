// A sea's spectrum tabulated over wave number and angle, so that the hundred thousand places at which its waves are
// integrated cost a look-up each.
#pragma once
#include <array>
#include <vector>

#include "ocean/waves/ladder.h"
#include "ocean/waves/spectrum.h"

namespace seascape {

// Straight lines between nodes of ln k. Spreadings keep their integral of 1 exactly, shares of neighbouring cascades
// their sum of 1.
class SpectrumTable {
 public:
  // For wave numbers from `k_least` to `k_most` (rad/m) of one sea.
  SpectrumTable(const Spectrum& spectrum, double k_least, double k_most);

  // The densities of each component times the share that cascade `index` carries, over the table's nodes of ln k; made
  // once a cascade.
  struct Band {
    struct Train {
      int component;
      double to_rad;                // mean direction
      std::vector<double> density;  // m^4 rad, a node each
    };
    std::vector<Train> trains;
  };
  Band band(const Ladder& ladder, int index) const;

  // Variance density over the wave vector (m^4) of a band at ln k and a direction (rad clockwise from -z, -2 pi to 2
  // pi).
  double operator()(const Band& band, double log_k, double to_rad) const;

 private:
  static constexpr double step = 0.005;   // of ln k: k^-4 is off by 5e-5 between nodes, a swell's peak by 1e-4
  static constexpr int nodes_a_row = 16;  // spreadings vary slowly: a row of angles every so many nodes
  static constexpr int angles = 129;      // from 0 to pi
  double first_ = 0.0;                    // ln k of node 0
  int nodes_ = 0;
  std::array<std::vector<double>, Spectrum::components> radial_;
  std::array<std::vector<double>, Spectrum::components> spread_;  // [row][angle]
  std::array<double, Spectrum::components> to_rad_{};
};

}  // namespace seascape
