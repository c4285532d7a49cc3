// A lamp's light in even water: its beam, and what a line of sight that passes through it scatters to the eye. Shared
// by C++ and GLSL.
#ifndef SEASCAPE_LAMP_LIGHT_H
#define SEASCAPE_LAMP_LIGHT_H
#include "gpu_types.h"
#include "water_volume.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::clamp;
using glm::exp;
using glm::log;
using glm::max;
using glm::min;
using glm::sqrt;
#endif

// Radius of its window, m: nothing is nearer to the light.
SEASCAPE_CONST float lamp_radius_m = 0.02f;

// The beam falls off as exp(-narrowness (1 - cosine)) about its middle, and to half at half of the beam's angle.
// `half_cosine`: the cosine of that half.
SEASCAPE_REAL_FUNCTION Real lamp_narrowness(Real half_cosine) {
  return Real(0.6931471805599453) / max(Real(1.0) - half_cosine, Real(1e-5));
}

// Share of the middle's intensity in a direction of this cosine to it.
SEASCAPE_REAL_FUNCTION Real lamp_beam(Real cosine, Real narrowness) {
  return exp(narrowness * (min(cosine, Real(1.0)) - Real(1.0)));
}

// A line of sight comes nearest to the lamp at `passes` metres from the eye, and is `apart` metres from it there;
// `along` is the cosine between line and beam, and the lamp is `ahead` metres ahead of the eye in the beam's direction.
// Where on the first `way` metres there is light worth a sum: in the beam down to a thousandth of its middle, and no
// farther on than where all but 0.25 % has been lost at the least attenuation `dims` (1/m). x: from, y: to, m; x = y:
// nowhere.
SEASCAPE_REAL_FUNCTION SEASCAPE_REAL2 lamp_reach(Real passes, Real apart, Real along, Real ahead, Real narrowness,
                                                 Real dims, Real way) {
  Real from = Real(0.0), to = way;
  Real cut = Real(1.0) - Real(6.9) / narrowness;
  if (cut > Real(0.1)) {
    // The cone's edge: (t along - ahead)^2 = cut^2 ((t - passes)^2 + apart^2), on its forward side.
    Real a = along * along - cut * cut, b = cut * cut * passes - along * ahead,
         c = ahead * ahead - cut * cut * (passes * passes + apart * apart), root = b * b - a * c;
    if (root <= Real(0.0)) {
      if (a <= Real(0.0)) return SEASCAPE_REAL2(Real(0.0), Real(0.0));
    } else {
      Real q = -b - (b < Real(0.0) ? -sqrt(root) : sqrt(root));
      Real first = abs(a) > Real(1e-9) ? q / a : Real(1e9), second = c / (q == Real(0.0) ? Real(1e-9) : q);
      Real near = min(first, second), far = max(first, second);
      if (a < Real(0.0)) {  // inside between the edges, of the cone ahead or of the one behind
        if (Real(0.5) * (near + far) * along < ahead) return SEASCAPE_REAL2(Real(0.0), Real(0.0));
        from = max(from, near);
        to = min(to, far);
      } else if (along > Real(0.0)) {  // from the edge that is ahead on
        from = max(from, far);
      } else {
        to = min(to, near);
      }
    }
  }
  to = min(to, from + Real(6.0) / dims);
  return to > from ? SEASCAPE_REAL2(from, to) : SEASCAPE_REAL2(Real(0.0), Real(0.0));
}

// `scale` times a node and its share. The sum over the line is taken by Gauss and Legendre's nodes in s, t = passes +
// apart sinh(s): steps are short where the lamp is near (as equiangular ones, Kulla and Fajardo 2012), and grow with
// the distance as light falls off.
SEASCAPE_CONST int lamp_nodes = 12;
SEASCAPE_REAL_FUNCTION Real lamp_node(int i, Real scale) {
  int k = i < 6 ? i : 11 - i;
  Real n = k == 0   ? Real(0.9815606342467192)
           : k == 1 ? Real(0.9041172563704748)
           : k == 2 ? Real(0.7699026741943047)
           : k == 3 ? Real(0.5873179542866175)
           : k == 4 ? Real(0.3678314989981802)
                    : Real(0.1252334085114689);
  return i < 6 ? -scale * n : scale * n;
}
SEASCAPE_REAL_FUNCTION Real lamp_node_share(int i, Real scale) {
  int k = i < 6 ? i : 11 - i;
  return scale * (k == 0   ? Real(0.0471753363865118)
                  : k == 1 ? Real(0.1069393259953182)
                  : k == 2 ? Real(0.1600783285433463)
                  : k == 3 ? Real(0.2031674267230658)
                  : k == 4 ? Real(0.2334925365383548)
                           : Real(0.2491470458134029));
}

// Inverse of sinh(), exact to rounding for either sign.
SEASCAPE_REAL_FUNCTION Real lamp_asinh(Real x) {
  Real s = log(abs(x) + sqrt(x * x + Real(1.0)));
  return x < Real(0.0) ? -s : s;
}

// One node of the sum between `from` and `to` (lamp_reach()). x: what it adds for a lamp of intensity 1 that nothing
// dims, over the scattering coefficient, 1/m^2; y: metres of water that its light goes through, to there and to the
// eye.
SEASCAPE_REAL_FUNCTION SEASCAPE_REAL2 lamp_scattered(int i, Real passes, Real apart, Real along, Real ahead,
                                                     Real narrowness, Real from, Real to) {
  Real first = lamp_asinh((from - passes) / apart), last = lamp_asinh((to - passes) / apart);
  Real half_span = Real(0.5) * (last - first), s = Real(0.5) * (first + last) + lamp_node(i, half_span);
  Real grows = exp(s), off = Real(0.5) * apart * (grows - Real(1.0) / grows),
       range = Real(0.5) * apart * (grows + Real(1.0) / grows), t = passes + off;
  // dt = range ds, and the light falls off as 1 / range^2.
  return SEASCAPE_REAL2(lamp_node_share(i, half_span) / range * lamp_beam((t * along - ahead) / range, narrowness) *
                            henyey_greenstein(-off / range, Real(water_forward)),
                        range + t);
}

SEASCAPE_SHARED_END
#endif
