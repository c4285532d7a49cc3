#include "ocean/sea/water_side.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ocean/sea/query.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {

// Where a vertical line meets the surface.
struct Crossing {
  double height_m;
  int sign;  // 1; -1 where the surface is turned over
};

// Rest positions on a lattice about the place, in squares that are quartered as long as what lies in them may stand
// over the place, and then in two triangles each.
class Search {
 public:
  static constexpr int first_squares = 16, deepest = 10;

  // Rest positions up to `reach_m` away, along x and along z, down to squares of `least_m`; `spread`: how far within a
  // square water may stand beside its corners' bounds, of its side.
  Search(const WaveField& field, const WaveTiles& tiles, const glm::dvec2& place, double reach_m, double least_m,
         double spread)
      : field_(field), tiles_(tiles), filter_(field.filter(0.0)), place_(place), spread_(spread) {
    int halvings = 0;
    for (double side = 2.0 * reach_m / first_squares; side > least_m && halvings < deepest; side *= 0.5) ++halvings;
    const int side = 1 << halvings;
    step_m_ = 2.0 * reach_m / (first_squares * side);
    first_ = place - reach_m;
    std::array<Corner, first_squares + 1> row, next;
    for (int z = 0; z <= first_squares; ++z, row = next) {
      for (int x = 0; x <= first_squares; ++x) next[std::size_t(x)] = corner({x * side, z * side});
      if (z > 0)
        for (std::size_t x = 0; x < first_squares; ++x) square({row[x], row[x + 1], next[x], next[x + 1]}, side);
    }
    std::sort(crossings_.begin(), crossings_.begin() + count_,
              [](const Crossing& a, const Crossing& b) { return a.height_m < b.height_m; });
  }

  int count() const { return count_; }
  const Crossing& operator[](int n) const { return crossings_[std::size_t(n)]; }
  bool whole() const {
    int sum = 0;
    for (int n = 0; n < count_; ++n) sum += crossings_[std::size_t(n)].sign;
    return !too_many_ && sum == 1;
  }

 private:
  struct Corner {
    glm::ivec2 at;   // on the lattice
    glm::dvec2 off;  // where it stands, from the place
    double height_m;
  };

  // The same numbers for whichever square asks.
  Corner corner(const glm::ivec2& at) const {
    const glm::dvec2 rest = first_ + step_m_ * glm::dvec2(at);
    const glm::dvec3 d = field_.displacement(tiles_, rest, filter_);
    return {at, rest + glm::dvec2(d.x, d.z) - place_, d.y};
  }

  // Corners in the order (x, z), (x + 1, z), (x, z + 1), (x + 1, z + 1).
  void square(const std::array<Corner, 4>& c, int side) {
    const glm::dvec2 low = glm::min(glm::min(c[0].off, c[1].off), glm::min(c[2].off, c[3].off));
    const glm::dvec2 high = glm::max(glm::max(c[0].off, c[1].off), glm::max(c[2].off, c[3].off));
    const double grown = side > 1 ? spread_ * side * step_m_ : 0.0;
    if (low.x > grown || low.y > grown || high.x < -grown || high.y < -grown) return;
    if (side == 1) {
      triangle(c[0], c[1], c[3]);
      triangle(c[0], c[3], c[2]);
      return;
    }
    const int half = side / 2;
    const Corner south = corner(c[0].at + glm::ivec2(half, 0)), west = corner(c[0].at + glm::ivec2(0, half)),
                 middle = corner(c[0].at + half), east = corner(c[1].at + glm::ivec2(0, half)),
                 north = corner(c[2].at + glm::ivec2(half, 0));
    square({c[0], south, west, middle}, half);
    square({south, c[1], middle, east}, half);
    square({west, middle, c[2], north}, half);
    square({middle, east, north, c[3]}, half);
  }

  // Twice the area of the place and an edge: positive where it lies to the edge's left, in the sense of x towards z.
  // Two triangles that share the edge get opposite numbers, and none gets nothing, so that the place lies in one of
  // them.
  static double beside(const Corner& from, const Corner& to) {
    const bool turned = to.at.y < from.at.y || (to.at.y == from.at.y && to.at.x < from.at.x);
    const glm::dvec2 a = turned ? to.off : from.off, b = turned ? from.off : to.off;
    const double area = a.x * b.y - a.y * b.x, kept = area != 0.0 ? area : 1e-300;
    return turned ? -kept : kept;
  }

  void triangle(const Corner& a, const Corner& b, const Corner& c) {
    const double ab = beside(a, b), bc = beside(b, c), ca = beside(c, a);
    if (!((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0))) return;
    if (count_ == int(crossings_.size())) {
      too_many_ = true;
      return;
    }
    crossings_[std::size_t(count_++)] = {(bc * a.height_m + ca * b.height_m + ab * c.height_m) / (ab + bc + ca),
                                         ab > 0.0 ? 1 : -1};
  }

  const WaveField& field_;
  const WaveTiles& tiles_;
  WaveField::Filter filter_;
  glm::dvec2 place_, first_{0.0};
  double spread_, step_m_ = 0.0;
  std::array<Crossing, 64> crossings_{};
  int count_ = 0;
  bool too_many_ = false;
};

// Less than a float's last place of a metre; and where doubles still lie closer than a tenth of a millimetre.
constexpr double least_reach_m = 1e-7, farthest_m = 1e11;

WaterSide by_query(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& at_m) {
  const glm::dvec2 place(at_m.x, at_m.z);
  QueryAnswer answer;
  query(field, tiles, {&place, 1}, {&answer, 1}, {.most_iterations = 30});
  return {at_m.y < answer.height_m, answer.height_m, 1, false};
}

}  // namespace

WaterSide water_side(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& at_m) {
  WaterSide side;
  if (!std::isfinite(at_m.x + at_m.y + at_m.z)) {
    side.certain = false;
    return side;
  }
  const SeaStatistics& sea = field.statistics();
  double height_m = sea.largest_height_m, reach_m = sea.largest_shift_m, finest_m = 1e9;
  for (const auto& source : field.others()) {
    height_m += source->statistics().largest_height_m;
    reach_m += source->statistics().largest_shift_m;
  }
  for (const WaveField::Place& place : field.places()) finest_m = std::min(finest_m, place.texel_m);
  // Both bounds hold but for one wave in a million.
  height_m *= 1.5;
  reach_m *= 1.5;
  const glm::dvec2 place(at_m.x, at_m.z);
  if (std::abs(at_m.y) >= height_m) {
    side.in_water = at_m.y < 0.0;
    return side;
  }
  // Water that moves straight up and down, or by less than a lattice could tell, stands over its place at rest.
  if (!(reach_m > least_reach_m)) {
    side.height_m = field.displacement(tiles, place, 0.0).y;
    side.in_water = at_m.y < side.height_m;
    return side;
  }
  if (std::abs(place.x) + std::abs(place.y) > farthest_m) return by_query(field, tiles, at_m);
  // Between corners the water is straight but for waves shorter than the square; the slope of their shift is chop times
  // that of their height.
  const double shear = field.state().chop * std::sqrt(sea.slope_moments.x + sea.slope_moments.y);
  for (double spread = 0.5 + 2.0 * shear; spread < 8.0 * (0.5 + 2.0 * shear); spread *= 2.0) {
    const Search search(field, tiles, place, reach_m, 0.5 * finest_m, spread);
    if (!search.whole()) continue;
    side.sheets = search.count();
    int winding = 0, first_above = 0;
    while (first_above < search.count() && !(at_m.y < search[first_above].height_m)) ++first_above;
    for (int n = first_above; n < search.count(); ++n) winding += search[n].sign;
    side.in_water = winding != 0;
    if (side.in_water) {  // upwards to the first sheet above which is air
      int n = first_above;
      for (; (winding -= search[n].sign) != 0; ++n) {
      }
      side.height_m = search[n].height_m;
    } else {  // downwards to the first below which is water
      int n = first_above - 1;
      for (; n > 0 && (winding + search[n].sign) == 0; --n) winding += search[n].sign;
      side.height_m = search[std::max(n, 0)].height_m;
    }
    return side;
  }
  return by_query(field, tiles, at_m);
}

}  // namespace seascape
