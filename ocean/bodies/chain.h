// Chains and lines that hang: the pull of a chain that lies on the ground as far as it may, what its anchor holds, and
// the shape of either for whoever draws it. Pure.
#pragma once
#include <glm/glm.hpp>
#include <span>

namespace seascape {

struct Chain {
  double weight_n_m = 20.0;  // in water, above 0
  double length_m = 20.0;    // above 0
  double stiff_n = 5e6;      // EA: N for a stretch of its own length
};

struct ChainPull {
  double across_n = 0.0;       // on the upper end, towards the anchor; and on the anchor, towards the upper end
  double down_n = 0.0;         // on the upper end
  double lifts_n = 0.0;        // up, on the anchor; 0 while a part of the chain lies
  double lies_m = 0.0;         // of its length
  double stiffness_n_m = 0.0;  // by how much `across_n` grows over a metre more
};
// The elastic catenary of a chain from an anchor on level ground to a place so far across and up from there, m
// (Faltinsen 1990, "Sea Loads on Ships and Offshore Structures", section 8.2; stretched evenly, by the pull across). A
// chain that is shorter than it has to be is stretched. 0 for what is no number.
ChainPull chain_pull(const Chain& chain, double across_m, double up_m);
// How far across a place so high over the anchor lies from it with this pull (N), m: what chain_pull() inverts.
double chain_reach(const Chain& chain, double across_n, double up_m);

// What an anchor holds of `holds_n` where its chain lifts it: nothing at 40 degrees, from none in proportion to the
// tangent. An estimate: taut at a scope of 5 some eight tenths are left, at 3 some six.
double anchor_hold(double holds_n, double across_n, double lifts_n);

// Places along a line of that length from a to b, evenly along it: straight where it is no longer than the way, and
// else a catenary (y = k cosh(x / k)). One place at least.
void hang_line(const glm::dvec3& a, const glm::dvec3& b, double length_m, std::span<glm::dvec3> places);
// The same of a chain from its anchor `a` on level ground to `b`: first along the ground, and then up.
void hang_chain(const Chain& chain, const glm::dvec3& a, const glm::dvec3& b, std::span<glm::dvec3> places);

}  // namespace seascape
