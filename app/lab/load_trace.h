// Traces of a frame's load over time, made and recorded, by which controllers of picture scale are judged.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seascape {

// The picture's area relative to the display's own: scale 0.8 to 1.4 (Valve's range), its work, and quality.
inline constexpr double least_area = 0.64, most_area = 1.96;
inline constexpr double quality_of_area(double area) { return (area - least_area) / (most_area - least_area); }
// The load of 1 takes this long at area 1: the period of 90 Hz.
inline constexpr double load_unit_ms = 1000.0 / 90.0;

// When a frame's timing arrives, and what it says.
struct Arrival {
  int age = 1;          // known before the frame that is `age` later is decided
  bool lost = false;    // never
  double factor = 1.0;  // measured over true: 0 is a timing that says nothing, others are faults of measuring
};

// A frame takes load x (fixed + (1 - fixed) x area) x load_unit_ms / clock.
struct LoadTrace {
  std::string name, family;
  double fixed_share = 0.3;  // at area 1
  int dead_frames = 2;       // of the loop: decisions for frame t + 1 know frames to t - dead_frames
  std::vector<double> load;  // as it is
  std::vector<double> mean;  // without noise and single spikes
  std::vector<double> period_ms;
  std::vector<Arrival> arrivals;
  // The processor's clock follows its load, if so: levels and the busy share over and under which it moves by one
  // every `clock_frames`.
  bool governed = false, clock_told = false;

  std::size_t frames() const { return load.size(); }
  double cost_ms(std::size_t frame, double area, double clock = 1.0) const {
    return load[frame] * (fixed_share + (1.0 - fixed_share) * area) * load_unit_ms / clock;
  }
};

// A governor of the kind in mobile devices: one step up if a frame is busy for more than 0.9 of its period, one down
// under 0.7, looked at every 8 frames.
inline constexpr double clock_levels[] = {0.6, 0.75, 0.88, 1.0};
inline constexpr std::size_t clock_frames = 8;
std::size_t next_clock(std::size_t clock, std::size_t frame, double busy_share);

// The families of made traces, and the last, "recorded".
std::span<const std::string_view> trace_families();

// Made traces, `each` a family; others for another seed.
std::vector<LoadTrace> made_traces(std::uint64_t seed, int each);

// Traces of shipped scenes from the table content/traces/scenes.csv: a column a scene, rows of cost over the median.
// Throws Error for a file that is not such a table.
std::vector<LoadTrace> recorded_traces(const std::filesystem::path& file, std::uint64_t seed);
std::vector<LoadTrace> parse_recorded(std::string_view text, const std::string& where, std::uint64_t seed);

// The reference runs that docs/adaptive.md compares with: 1,800 frames at 90 Hz, load 0.62 with 3 % noise, dead time 2.
enum class ReferenceRun { step, look, spike };
LoadTrace reference_trace(ReferenceRun run, std::uint64_t seed);

}  // namespace seascape
