// How far around the viewer vertices have to be how dense for waves that lie in windows, each in its part of the sea.
// Pure.
#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "ocean/mesh/surface_selection.h"

namespace seascape {

class NearReaches {
 public:
  // Windows that share the water are missed most at few places, by a hull: of some thousand places the sea is missed
  // most by 3.7 deviations, of the million that its error speaks of by 5.4 (sqrt(2 ln N)).
  static constexpr double sea_beside = 0.7;

  // For a viewer that high over the water, m.
  void set(std::span<const NearMeshError> near, double over_m);

  // The distance, m, from which vertices `spacing_m` apart will do where the sea alone is missed by `error_m`.
  // `reach_of(error)`: from where an error of so many metres is allowed; it grows with the error. Between two ends of
  // windows the same of them count: finer vertices are needed there as far as their errors ask for, and none where
  // these are allowed before any of that begins.
  template <class ReachOf>
  double operator()(double spacing_m, double error_m, const ReachOf& reach_of) {
    double reach_m = reach_of(error_m), begins_m = 0.0;
    for (One& one : near_) one.missed_m = one.error(spacing_m);
    for (const double end_m : ends_) {
      double sum = error_m;
      std::array<double, NearMeshError::most_shared> shared{};
      for (const One& one : near_) {
        if (!(one.from_m < end_m && one.reach_m >= end_m)) continue;
        if (one.shares < 0)
          sum += one.missed_m;
        else
          shared[std::size_t(one.shares)] = std::max(shared[std::size_t(one.shares)], one.missed_m);
      }
      double most = 0.0;
      for (const double one : shared) most += one;
      const double wanted_m = reach_of(std::max(sum, sum - (1.0 - sea_beside) * error_m + most));
      if (wanted_m > begins_m) reach_m = std::max(reach_m, std::min(wanted_m, end_m));
      begins_m = end_m;
    }
    return reach_m;
  }

 private:
  struct One {
    MeshError error;
    double from_m, reach_m;  // in space
    int shares;
    double missed_m;  // by the spacing that is asked for
  };
  std::vector<One> near_;
  std::vector<double> ends_;  // where they begin and end, in order
};

}  // namespace seascape
