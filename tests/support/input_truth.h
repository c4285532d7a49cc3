// What inputs are to give, written once more in plain double and in another way: nothing here comes from ocean/.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace seascape::test {

struct Flat {
  double x = 0.0, z = 0.0;
};

// The centripetal Catmull-Rom curve between b and c, at the share s of its knots, by Barry and Goldman's pyramid of
// straight lines.
inline Flat pyramid(Flat a, Flat b, Flat c, Flat d, double s) {
  const auto far = [](Flat p, Flat q) { return std::sqrt(std::hypot(q.x - p.x, q.z - p.z)); };
  const double ta = 0.0, tb = ta + far(a, b), tc = tb + far(b, c), td = tc + far(c, d), t = tb + s * (tc - tb);
  const auto line = [&](Flat p, Flat q, double from, double to) {
    const double u = (t - from) / (to - from);
    return Flat{p.x * (1.0 - u) + q.x * u, p.z * (1.0 - u) + q.z * u};
  };
  const Flat ab = line(a, b, ta, tb), bc = line(b, c, tb, tc), cd = line(c, d, tc, td);
  return line(line(ab, bc, ta, tc), line(bc, cd, tb, td), tb, tc);
}

inline double polygon_area(const std::vector<Flat>& p) {
  double twice = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Flat& q = p[(i + 1) % p.size()];
    twice += p[i].x * q.z - q.x * p[i].z;
  }
  return std::abs(twice) / 2.0;
}

// By angles: the sum of those that the sides are seen under is a whole turn within, and none outside.
inline bool polygon_holds(const std::vector<Flat>& p, Flat at) {
  double turned = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Flat a{p[i].x - at.x, p[i].z - at.z}, b{p[(i + 1) % p.size()].x - at.x, p[(i + 1) % p.size()].z - at.z};
    turned += std::atan2(a.x * b.z - a.z * b.x, a.x * b.x + a.z * b.z);
  }
  return std::abs(turned) > 3.0;
}

// Rankine's vortex, clockwise seen from above with x to the east and z to the south.
inline Flat rankine(Flat p, double core, double swirl) {
  const double r = std::hypot(p.x, p.z);
  if (r == 0.0) return {};
  const double speed = r < core ? swirl * r / core : swirl * core / r;
  return {-p.z / r * speed, p.x / r * speed};
}

inline double smooth(double u) { return u <= 0.0 ? 0.0 : u >= 1.0 ? 1.0 : u * u * (3.0 - 2.0 * u); }

inline double joined(std::string_view blend, double base, double value, double share) {
  double whole = value;  // what a share of 1 gives
  if (blend == "add") whole = base + value;
  if (blend == "scale") whole = base * value;
  if (blend == "min") whole = value < base ? value : base;
  if (blend == "max") whole = value > base ? value : base;
  return (1.0 - share) * base + share * whole;
}

}  // namespace seascape::test
