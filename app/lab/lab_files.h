// What the lab leaves on disk: curves.csv, written and read again.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/lab.h"
#include "app/report_page.h"

namespace seascape {

// What a measurement was taken with; rows of another are not gone on with.
struct LabOrigin {
  Machine machine;
  bool quick = false;
};

// A row a point: curve,knob,value,sea,time_us,time_p5_us,time_p95_us,error,error_unit,preset, and then
// settings,samples,mode,seed,cpu,device,driver,build,date. The time is the median of `samples`; mode is quick or full.
std::string curves_csv(const std::vector<LabPoint>& points, const LabOrigin& origin);

struct LabRows {
  std::vector<LabPoint> points;
  LabOrigin origin;  // of the first row; a table without rows has none
};
// The inverse. Throws Error("WHERE:LINE", ...) for another header, a wrong number of cells, quotes that do not end,
// what is not a finite number, a negative time or error, and a mode that is neither.
LabRows parse_curves_csv(std::string_view text, const std::string& where);

// Whether points of one may stand in a table beside those of the other: the same machine, device, driver, build, seed
// and mode. The date may differ.
bool same_origin(const LabOrigin& a, const LabOrigin& b);

}  // namespace seascape
