// A regular grid over a bed, and what is done on all of it when a scene loads: bent fronts (eikonal.cpp) and shelter
// (shelter.cpp).
#pragma once
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace seascape {

// Nodes of square cells, node (i, j) at j * nx + i.
struct BedGrid {
  glm::dvec2 least{0.0};  // of node (0, 0): x and z, m
  double cell_m = 1.0;
  int nx = 0, nz = 0;  // nodes

  std::size_t size() const { return std::size_t(nx) * std::size_t(nz); }
  std::size_t node(int i, int j) const { return std::size_t(j) * std::size_t(nx) + std::size_t(i); }
  glm::dvec2 place(int i, int j) const { return least + cell_m * glm::dvec2(i, j); }
  glm::dvec2 most() const { return place(nx - 1, nz - 1); }
  // Between the four nodes around a place; outside of the grid what its nearest edge has.
  double bilinear(std::span<const float> values, glm::dvec2 place_m) const;
};

// Plane waves come in from outside the grid along `direction` (a unit vector). S, the way they have gone in metres of
// outside water, has |grad S| = slowness, 1 outside (the eikonal equation: Dean and Dalrymple 1991, eq. 4.89). Gives S
// - direction . x, 0 on the edges that the waves come in over, infinity where they never come: at obstacles, whose
// slowness is infinite, and at what these enclose. Where several waves meet it is the first one's. By fast sweeping
// (Zhao 2005) with Godunov's differences, which are of the first order, and then some rounds with those of the second
// order that fast marching has (Sethian 1999, section 8.5), for it is S's gradient that bends the crests.
std::vector<double> bent_fronts(const BedGrid& grid, std::span<const double> slowness, glm::dvec2 direction);

// The share of the energy of waves along `direction` (a unit vector) that has come to each node, of what the node's own
// depth lets stand: `left` is the share that breaking leaves at each node (0 on land). Along a straight line energy
// that has broken does not come back: with e the least share on the way, a node gets min(e, left) / left. 0 on land.
// Lines are followed from node to node between the two that are nearest upwind (short characteristics: Kunasz and Auer
// 1988), which blurs a shadow's edge by the root of its length in cells.
std::vector<float> sheltered(const BedGrid& grid, std::span<const float> left, glm::dvec2 direction);

// Gives the nodes that are marked unknown the mean of their known neighbours, from the known ones' edges on outwards;
// `otherwise` where none is known.
void fill_unknown(const BedGrid& grid, std::span<float> values, std::vector<std::uint8_t> known, float otherwise);

// One pass of the weights 1/4, 1/2, 1/4 along both axes; the grid's edges stay.
void smooth(const BedGrid& grid, std::span<float> values);

}  // namespace seascape
