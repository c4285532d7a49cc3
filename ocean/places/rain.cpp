#include "ocean/places/rain.h"

#include <algorithm>
#include <cmath>

#include "engine/require.h"
#include "ocean/waves/gaussian.h"

namespace seascape {

void validate(const RainSettings& s) {
  require(s.drops_per_m2_s >= 0.0 && s.drops_per_m2_s <= 100.0, s.drops_per_m2_s, "drops_per_m2_s", "from 0 to 100");
  require(s.drop_length_m > 0.0, s.drop_length_m, "drop_length_m", "above 0");
  require(true, s.drop_height_m, "drop_height_m", "finite");
}

void add_rain(const RainSettings& s, std::int64_t first, std::int64_t count, double rate_hz, glm::dvec2 place,
              double reach, std::vector<WaveSource>& sources) {
  if (!(s.drops_per_m2_s > 0.0) || s.drop_height_m == 0.0 || count <= 0) return;
  constexpr double most_expected = 0.05;
  const double a_tick = s.drops_per_m2_s / rate_hz;  // expected on a square metre
  const double side = std::min(1.0, std::sqrt(most_expected / a_tick)), expected = a_tick * side * side;
  const double rise = s.drop_height_m * rate_hz / double(count);
  const glm::dvec2 low = glm::floor((place - reach) / side), high = glm::floor((place + reach) / side);
  const double farthest = std::max(std::max(-low.x, -low.y), std::max(high.x, high.y));
  if (!(farthest < 0x1p52)) return;  // out there a double is no whole cell, and counting would not go on
  for (std::int64_t tick = first; tick < first + count; ++tick)
    for (double z = low.y; z <= high.y; ++z)
      for (double x = low.x; x <= high.x; ++x) {
        // Exact for every cell, however far: a double's whole numbers.
        const auto key = [](double cell) { return std::uint32_t(std::uint64_t(std::int64_t(cell))); };
        const std::uint32_t row =
            std::uint32_t(uniform_number(s.seed ^ std::uint32_t(std::uint64_t(tick) >> 32), std::uint32_t(tick)) *
                          0x1p32) ^
            key(z);
        const std::uint32_t cell = std::uint32_t(uniform_number(row, key(x)) * 0x1p32);
        if (uniform_number(cell, 0u) >= expected) continue;
        WaveSource drop;
        drop.place_m = (glm::dvec2(x, z) + glm::dvec2(uniform_number(cell, 1u), uniform_number(cell, 2u))) * side;
        if (std::abs(drop.place_m.x - place.x) > reach || std::abs(drop.place_m.y - place.y) > reach) continue;
        drop.length_m = s.drop_length_m;
        drop.rise_mps = rise;
        sources.push_back(drop);
      }
}

}  // namespace seascape
