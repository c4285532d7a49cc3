#include "ocean/bodies/chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seascape {

namespace {

constexpr double most_n = 1e12;
constexpr int halvings = 80;

// Of a chain whose upper end stands that high, hung with this pull.
struct Hung {
  double reach_m = 0.0, down_n = 0.0, lifts_n = 0.0, lies_m = 0.0;
};

Hung hung(const Chain& chain, double across_n, double up_m) {
  const double w = chain.weight_n_m, length = chain.length_m, h = std::max(up_m, 0.0);
  const double a = across_n / w;  // the catenary's parameter, m
  const double stretch_m = across_n * length / chain.stiff_n;
  Hung out;
  const double lifted_m = std::sqrt(h * h + 2.0 * h * a);
  if (lifted_m <= length) {  // it leaves the ground level
    out.lies_m = length - lifted_m;
    out.down_n = w * lifted_m;
    out.reach_m = out.lies_m + (a > 0.0 ? a * std::asinh(lifted_m / a) : 0.0) + stretch_m;
    return out;
  }
  const double span = std::sqrt(std::max(length * length - h * h, 0.0));
  const double half = std::asinh(span / (2.0 * a));
  out.reach_m = 2.0 * a * half + stretch_m;
  out.down_n = 0.5 * w * (length + h / std::max(std::tanh(half), 1e-12));
  out.lifts_n = out.down_n - w * length;
  return out;
}

}  // namespace

double chain_reach(const Chain& chain, double across_n, double up_m) { return hung(chain, across_n, up_m).reach_m; }

ChainPull chain_pull(const Chain& chain, double across_m, double up_m) {
  ChainPull pull;
  if (!(std::isfinite(across_m) && std::isfinite(up_m))) return pull;
  // Straight up there is no catenary any more: what is too high hangs on the stretched chain.
  const double tallest = 0.999 * chain.length_m, up = std::clamp(up_m, 0.0, tallest);
  const double torn_m = std::max(up_m - tallest, 0.0), pulled_n = torn_m * chain.stiff_n / chain.length_m;
  double low = 0.0, high = most_n;
  if (across_m > hung(chain, 1e-6, up).reach_m) {
    low = 1e-6;
    for (int n = 0; n < halvings; ++n) {
      const double middle = std::sqrt(low * high);
      (hung(chain, middle, up).reach_m < across_m ? low : high) = middle;
    }
  }
  pull.across_n = low;
  const Hung at = hung(chain, low, up);
  pull.down_n = std::min(at.down_n + pulled_n, most_n);
  pull.lifts_n = std::max(at.lifts_n + pulled_n, 0.0);
  pull.lies_m = at.lies_m;
  const double more = 1e-4 * low + 1e-3;
  pull.stiffness_n_m = more / std::max(hung(chain, low + more, up).reach_m - at.reach_m, more / 1e12);
  return pull;
}

double anchor_hold(double holds_n, double across_n, double lifts_n) {
  const double none = std::tan(40.0 * std::numbers::pi / 180.0);
  return lifts_n > 0.0 ? holds_n * std::clamp(1.0 - lifts_n / (none * std::max(across_n, 1e-9)), 0.0, 1.0) : holds_n;
}

void hang_line(const glm::dvec3& a, const glm::dvec3& b, double length_m, std::span<glm::dvec3> places) {
  const std::size_t last = std::max<std::size_t>(places.size() - 1, 1);
  const double rise = b.y - a.y;
  // Plumb there is no catenary: its two parts then hang a little apart.
  const double across = std::max(std::hypot(b.x - a.x, b.z - a.z), 0.02 * length_m);
  const double most = length_m * length_m - rise * rise;
  if (!(most > 1.0001 * across * across)) {
    for (std::size_t n = 0; n < places.size(); ++n) places[n] = a + double(n) / double(last) * (b - a);
    return;
  }
  // sqrt(L^2 - rise^2) = 2 k sinh(across / 2 k), whose u = across / 2 k lies below 6 for the least `across`.
  const double wanted = std::sqrt(most) / across;
  double low = 0.0, high = 8.0;
  for (int n = 0; n < 50; ++n) {
    const double u = 0.5 * (low + high);
    (std::sinh(u) < wanted * u ? low : high) = u;
  }
  const double k = across / (2.0 * std::max(low, 1e-9));
  const double lowest = 0.5 * across - k * std::atanh(rise / length_m);  // from a
  const double from = std::sinh(-lowest / k);                            // of the length to the lowest place, over k
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double along = double(n) / double(last) * length_m;
    const double x = lowest + k * std::asinh(from + along / k), t = std::clamp(x / across, 0.0, 1.0);
    places[n] = {a.x + t * (b.x - a.x), a.y + k * (std::cosh((x - lowest) / k) - std::cosh(lowest / k)),
                 a.z + t * (b.z - a.z)};
  }
  places.back() = b;
}

void hang_chain(const Chain& chain, const glm::dvec3& a, const glm::dvec3& b, std::span<glm::dvec3> places) {
  const double across = std::hypot(b.x - a.x, b.z - a.z), up = b.y - a.y;
  const ChainPull pull = chain_pull(chain, across, up);
  if (pull.lies_m <= 0.0) return hang_line(a, b, chain.length_m, places);
  // Of what lies more than the way needs, nobody knows where: it is left out.
  const double lifted_m = chain.length_m - pull.lies_m, k = pull.across_n / chain.weight_n_m;
  const double hangs_m = k > 0.0 ? k * std::asinh(lifted_m / k) : 0.0, lies_m = std::max(across - hangs_m, 0.0);
  const glm::dvec3 ahead = across > 1e-9 ? glm::dvec3(b.x - a.x, 0.0, b.z - a.z) / across : glm::dvec3(0.0);
  const std::size_t last = std::max<std::size_t>(places.size() - 1, 1);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double along = double(n) / double(last) * (lies_m + lifted_m);
    const double rises_m = std::max(along - lies_m, 0.0);
    if (rises_m <= 0.0)
      places[n] = a + ahead * along;
    else if (k > 1e-6)
      places[n] = a + ahead * (lies_m + k * std::asinh(rises_m / k)) +
                  glm::dvec3(0.0, std::sqrt(k * k + rises_m * rises_m) - k, 0.0);
    else
      places[n] = a + ahead * lies_m + glm::dvec3(0.0, rises_m, 0.0);
  }
  places.back() = b;
}

}  // namespace seascape
