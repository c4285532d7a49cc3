// What each effect adds to a frame, alone and beside each other: as CSV, and as a heat map in SVG.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "app/statistics.h"

namespace seascape {

// What one frame, and what it was built from, has more than another. Differences: negative where it has less.
struct Cost {
  Interval ms;             // the median of the frames' differences in time, CPU and GPU together
  std::int64_t bytes = 0;  // device memory
  std::int64_t passes = 0, draws = 0, dispatches = 0;  // of a frame
  std::int64_t pipelines = 0, words = 0;               // of SPIR-V, as loaded
};

// `effect`, and what it needs, added to a scene that has `beside`, and what that needs.
struct CostCell {
  std::string effect, beside;  // an effect's name, beside_nothing or beside_all_others
  Cost cost;
};
inline constexpr const char *beside_nothing = "nothing", *beside_all_others = "all others";

struct CostMatrix {
  std::string scene, preset, device;
  int width = 0, height = 0, views = 0;
  int frames = 0;                    // of either scene, in turn
  std::vector<std::string> effects;  // rows and columns
  std::vector<CostCell> cells;       // any order; beside itself an effect has none
};

// "scene,preset,effect,beside,ms,ms_low,ms_high,bytes,passes,draws,dispatches,pipelines,words", a row a cell. The
// interval of `ms` holds the true median 95 times of 100.
std::string matrix_csv(const CostMatrix& matrix);

// Three heat maps, of milliseconds, MiB and dispatches: a row an effect, a column what it is added to. A time whose
// interval holds 0 is drawn as none.
std::string matrix_svg(const CostMatrix& matrix);

}  // namespace seascape
