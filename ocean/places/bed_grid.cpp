#include "ocean/places/bed_grid.h"

#include <algorithm>

namespace seascape {

double BedGrid::bilinear(std::span<const float> values, glm::dvec2 place_m) const {
  const glm::dvec2 at = glm::clamp((place_m - least) / cell_m, glm::dvec2(0.0), glm::dvec2(nx - 1, nz - 1));
  const int i = std::min(int(at.x), nx - 2), j = std::min(int(at.y), nz - 2);
  const glm::dvec2 f = at - glm::dvec2(i, j);
  const double low = values[node(i, j)] + (double(values[node(i + 1, j)]) - values[node(i, j)]) * f.x;
  const double high = values[node(i, j + 1)] + (double(values[node(i + 1, j + 1)]) - values[node(i, j + 1)]) * f.x;
  return low + (high - low) * f.y;
}

std::vector<float> sheltered(const BedGrid& grid, std::span<const float> left, glm::dvec2 direction) {
  // Rows are crossed one after the other along the axis that the direction is nearer to.
  const bool along_x = std::abs(direction.x) >= std::abs(direction.y);
  const double main = along_x ? direction.x : direction.y, cross = along_x ? direction.y : direction.x;
  const int rows = along_x ? grid.nx : grid.nz, columns = along_x ? grid.nz : grid.nx, side = cross > 0.0 ? 1 : -1;
  const float aslant = float(std::abs(cross / main));
  std::vector<float> result(grid.size()), before(std::size_t(columns), 1.0f), now(before);
  for (int row = 0; row < rows; ++row) {
    const int r = main > 0.0 ? row : rows - 1 - row;
    for (int c = 0; c < columns; ++c) {
      const int from = c - side;
      const float straight = before[std::size_t(c)],
                  skew = from >= 0 && from < columns ? before[std::size_t(from)] : 1.0f;
      const float comes = row == 0 ? 1.0f : straight + (skew - straight) * aslant;
      const std::size_t node = along_x ? grid.node(r, c) : grid.node(c, r);
      now[std::size_t(c)] = std::min(comes, left[node]);
      result[node] = left[node] > 0.0f ? std::min(comes / left[node], 1.0f) : 0.0f;
    }
    before.swap(now);
  }
  return result;
}

void fill_unknown(const BedGrid& grid, std::span<float> values, std::vector<std::uint8_t> known, float otherwise) {
  std::vector<std::size_t> edge, next;
  const auto each_neighbour = [&](std::size_t node, const auto& work) {
    const int i = int(node % std::size_t(grid.nx)), j = int(node / std::size_t(grid.nx));
    for (int z = std::max(j - 1, 0); z <= std::min(j + 1, grid.nz - 1); ++z)
      for (int x = std::max(i - 1, 0); x <= std::min(i + 1, grid.nx - 1); ++x) work(grid.node(x, z));
  };
  for (std::size_t node = 0; node < known.size(); ++node) {
    if (known[node]) continue;
    values[node] = otherwise;
    bool beside = false;
    each_neighbour(node, [&](std::size_t n) { beside = beside || known[n] == 1; });
    if (beside) edge.push_back(node);
  }
  // Each round takes from earlier ones alone, so the order within it does not matter. 2: waits in an edge.
  for (std::size_t node : edge) known[node] = 2;
  while (!edge.empty()) {
    for (std::size_t node : edge) {
      double sum = 0.0;
      int count = 0;
      each_neighbour(node, [&](std::size_t n) {
        if (known[n] == 1) sum += values[n], ++count;
      });
      values[node] = float(sum / count);
    }
    for (std::size_t node : edge) known[node] = 1;
    next.clear();
    for (std::size_t node : edge)
      each_neighbour(node, [&](std::size_t n) {
        if (known[n] == 0) known[n] = 2, next.push_back(n);
      });
    edge.swap(next);
  }
}

void smooth(const BedGrid& grid, std::span<float> values) {
  std::vector<float> along(values.begin(), values.end());
  for (int j = 0; j < grid.nz; ++j)
    for (int i = 1; i + 1 < grid.nx; ++i)
      along[grid.node(i, j)] =
          0.25f * (values[grid.node(i - 1, j)] + values[grid.node(i + 1, j)]) + 0.5f * values[grid.node(i, j)];
  for (int j = 1; j + 1 < grid.nz; ++j)
    for (int i = 1; i + 1 < grid.nx; ++i)
      values[grid.node(i, j)] =
          0.25f * (along[grid.node(i, j - 1)] + along[grid.node(i, j + 1)]) + 0.5f * along[grid.node(i, j)];
}

}  // namespace seascape
