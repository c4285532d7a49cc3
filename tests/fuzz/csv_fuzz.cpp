// Any bytes as points: read or refused; what is read is finite and survives being written.
#include "app/csv.h"

#include <array>
#include <cmath>

#include "tests/fuzz/fuzz.h"

using namespace seascape;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::reads([&] {
    const auto points = parse_points(fuzz::text_of(data, size), "points.csv");
    std::string text = "x,z\n";
    for (const glm::dvec2& point : points) {
      fuzz::require(std::abs(point.x) <= 1e7 && std::abs(point.y) <= 1e7, "points are near");
      append_csv_row(text, std::array{point.x, point.y});
    }
    fuzz::require(parse_points(text, "written.csv") == points, "written points read back the same");
  });
  return 0;
}
