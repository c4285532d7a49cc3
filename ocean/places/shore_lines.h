// Curves along which waves run as they do along a shore: where a place lies along them and across, and how much of the
// waves there is.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "ocean/inputs/bounds_tree.h"
#include "ocean/inputs/curve.h"
#include "ocean/inputs/input_spec.h"
#include "ocean/waves/tile_source.h"

namespace seascape {

// A place as the waves along a curve have it. The pattern that covers the plane is laid with its x along the curve and
// its -z across it towards the left, where the shore is: a curve that begins at the origin and goes straight to +x
// leaves it as it is.
struct ShorePlace {
  glm::dvec2 bent_m{0.0};  // of the pattern; along a closed curve counted so that it closes
  float share = 0.0f;      // of the waves that there are, 0 to 1
  float stretch = 1.0f;    // what the pattern's x grows by in a metre along the curve, 0 to some 3
  glm::dvec2 forward{
      1.0, 0.0};  // along the curve, where it is nearest; the pattern's z grows by 1 in a metre to the right of it
  double turning_per_m = 0.0;  // of `forward`, to its right, in a metre along it at this place
  glm::dvec2 right() const { return {-forward.y, forward.x}; }
};

// Each place has to itself the waves of one part of one curve: the strongest there, where strength is the waves' height
// without the soft edges beside it, and falls evenly to nothing there. What comes next to it takes from it, from three
// tenths of its strength on, and where it comes to eight there are no waves: patterns of other phase never meet, and
// where one place of a curve gives way to another as the nearest the sea lies level. So it does towards the centre of a
// bend, on whose inner side waves fade from its rim to seven tenths of its radius. The pattern is stretched by at most
// 40 % to close along a closed curve; one that is shorter than 0.7 patterns has waves that are alike all along their
// crests. Ends are cut straight, feather within. Immutable; any thread.
class ShoreLines {
 public:
  // Takes the splines to gerstner among `specs`. `period_m`: after which the pattern repeats along x. Throws Error as
  // validate() does.
  ShoreLines(std::span<const InputSpec> specs, double period_m);

  // Of nothing that has waves.
  bool empty() const { return chords_.empty(); }
  double period_m() const { return period_m_; }
  // Seen with a footprint (m): no edge is sharper. Within three footprints beyond the waves coordinates are those of
  // the curve too, so that one may read between places. A place that is no number has none.
  ShorePlace at(glm::dvec2 place_m, double footprint_m) const;
  // What the waves of a tile come to at most along these curves, of what they come to on the plane.
  SourceStatistics bent(SourceStatistics statistics) const;

 private:
  struct Vertex {                    // of a chord
    glm::dvec2 at, tangent;          // a unit vector
    double along_m;                  // of the curve
    double left = 0.0, right = 0.0;  // no less than the curve's bend to either side between here and the vertices
                                     // around, 1/m; 0 or more
  };
  struct Chord {
    std::uint32_t line, span;
    double u, v;         // where it begins and ends on the span
    std::uint32_t from;  // its first vertex; the second follows
    bool first, last;    // of an open curve
  };
  struct Numbers {
    double half_m, value, half_slope, value_slope;  // slopes by the knots' unit
  };
  struct Line {
    Curve curve;
    std::vector<Numbers> numbers;               // at the points
    double feather_m, weight, length_m, scale;  // scale: of the pattern's x to the way along the curve
    bool closed;
  };
  // A place of a curve that is nearer than those around it.
  struct Foot {
    double right_m, along_m, half_m, strength = 0.0, beyond_m = 0.0;  // beyond_m: an open end
    ShorePlace place;
  };
  void add(const InputSpec& spec, const std::vector<SplinePoint>& points);
  bool foot(const Chord& chord, glm::dvec2 place_m, double footprint_m, Foot& foot) const;

  std::vector<Line> lines_;
  std::vector<Vertex> vertices_;
  std::vector<Chord> chords_;
  BoundsTree tree_;
  double widest_m_ = 0.0, off_m_ = 0.0;  // half the greatest width; no chord is farther from its curve
  double feather_m_ = 1e6;               // the least
  double period_m_;
};

}  // namespace seascape
