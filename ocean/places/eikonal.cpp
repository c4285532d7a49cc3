// Bent fronts: the eikonal equation by sweeps over a grid, as bed_grid.h has it.
#include <algorithm>
#include <limits>

#include "ocean/places/bed_grid.h"

namespace seascape {

namespace {
constexpr double never = std::numeric_limits<double>::infinity();
constexpr int most_rounds = 64, fine_rounds = 16;  // of four sweeps; an open bed takes 3 to 10

// Two nodes of `never` lie around the grid, so that no difference asks where it ends.
class Fronts {
 public:
  Fronts(const BedGrid& grid, std::span<const double> slowness, glm::dvec2 direction)
      : grid_(grid),
        pitch_(std::size_t(grid.nx) + 4),
        way_(pitch_ * (std::size_t(grid.nz) + 4), never),
        step_(way_.size(), never),
        held_(way_.size(), 0) {
    // What comes in nearly along an edge does not come in over it.
    constexpr double least = 1e-6;
    for (int j = 0; j < grid.nz; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const std::size_t at = place(i, j);
        step_[at] = slowness[grid.node(i, j)] * grid.cell_m;
        const bool in = (i == 0 && direction.x > least) || (i == grid.nx - 1 && direction.x < -least) ||
                        (j == 0 && direction.y > least) || (j == grid.nz - 1 && direction.y < -least);
        if (in) way_[at] = glm::dot(direction, grid.cell_m * glm::dvec2(i, j)), held_[at] = 1;
      }
  }

  // Until nothing changes.
  void sweep_first() {
    rounds(most_rounds, [&](std::size_t at) {
      const double found = first_order(at);
      return std::min(found, way_[at]);
    });
  }
  void sweep_second() {
    rounds(fine_rounds, [&](std::size_t at) { return second_order(at); });
  }
  double way(int i, int j) const { return way_[place(i, j)]; }
  bool open(int i, int j) const { return step_[place(i, j)] < never; }

 private:
  std::size_t place(int i, int j) const { return (std::size_t(j) + 2) * pitch_ + std::size_t(i) + 2; }

  template <class Update>
  void rounds(int most, const Update& update) {
    for (int round = 0; round < most; ++round) {
      double change = 0.0;
      for (const auto& [back_x, back_z] : {std::pair{false, false}, {true, false}, {true, true}, {false, true}})
        for (int row = 0; row < grid_.nz; ++row)
          for (int column = 0; column < grid_.nx; ++column) {
            const std::size_t at = place(back_x ? grid_.nx - 1 - column : column, back_z ? grid_.nz - 1 - row : row);
            if (held_[at] || !(step_[at] < never)) continue;
            const double found = update(at);
            if (!(found < never)) continue;
            change = std::max(change, way_[at] < never ? std::abs(way_[at] - found) : grid_.cell_m);
            way_[at] = found;
          }
      if (change < 1e-9 * grid_.cell_m) return;
    }
  }

  double first_order(std::size_t at) const {
    const double x = std::min(way_[at - 1], way_[at + 1]), z = std::min(way_[at - pitch_], way_[at + pitch_]),
                 f = step_[at];
    if (!(std::abs(x - z) < f)) return std::min(x, z) + f;
    return 0.5 * (x + z + std::sqrt(2.0 * f * f - (x - z) * (x - z)));
  }

  // The one-sided difference along an axis is share (S - from).
  struct Side {
    double nearest, from, share;
  };
  Side side(std::size_t at, std::size_t stride) const {
    const bool low = way_[at - stride] <= way_[at + stride];
    const double near = low ? way_[at - stride] : way_[at + stride],
                 far = low ? way_[at - 2 * stride] : way_[at + 2 * stride];
    return far <= near ? Side{near, (4.0 * near - far) / 3.0, 1.5} : Side{near, near, 1.0};
  }
  double second_order(std::size_t at) const {
    const double rough = first_order(at), f = step_[at];
    if (!(rough < never)) return never;
    const Side x = side(at, 1), z = side(at, pitch_);
    double found = never;
    if (x.nearest < never && z.nearest < never) {
      const double a = x.share * x.share, b = z.share * z.share, middle = (a * x.from + b * z.from) / (a + b),
                   apart = x.from - z.from;
      const double square = f * f / (a + b) - a * b * apart * apart / ((a + b) * (a + b));
      if (square >= 0.0) found = middle + std::sqrt(square);
      if (found < std::max(x.nearest, z.nearest)) found = never;  // a front that comes from ahead is none
    }
    if (!(found < never)) found = x.nearest < z.nearest ? x.from + f / x.share : z.from + f / z.share;
    // Where two fronts meet, differences of the second order reach across the crease.
    return std::abs(found - rough) < 0.5 * f ? found : rough;
  }

  const BedGrid& grid_;
  std::size_t pitch_;
  std::vector<double> way_, step_;  // S from node (0, 0) on; slowness times the cell
  std::vector<std::uint8_t> held_;
};
}  // namespace

std::vector<double> bent_fronts(const BedGrid& grid, std::span<const double> slowness, glm::dvec2 direction) {
  Fronts fronts(grid, slowness, direction);
  fronts.sweep_first();
  fronts.sweep_second();
  std::vector<double> result(grid.size());
  for (int j = 0; j < grid.nz; ++j)
    for (int i = 0; i < grid.nx; ++i)
      result[grid.node(i, j)] =
          fronts.open(i, j) ? fronts.way(i, j) - glm::dot(direction, grid.cell_m * glm::dvec2(i, j)) : never;
  return result;
}

}  // namespace seascape
