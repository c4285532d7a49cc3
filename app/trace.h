// Trace events in Chrome's JSON format, which Perfetto (ui.perfetto.dev) and chrome://tracing open.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/report.h"

namespace seascape {

struct TraceEvent {
  enum class Kind { slice, counter };
  Kind kind = Kind::slice;
  std::string process, track;  // a slice's row is the track of its process; a counter has a row of its own
  std::string name;
  double start_us = 0.0, duration_us = 0.0;            // a counter has no duration
  std::vector<std::pair<std::string, double>> values;  // a slice's arguments, a counter's series
};

// Any names are allowed; a number that is not finite is written as 0 in times and null in values. Events keep their
// order. Google, "Trace Event Format": complete events (X), counters (C) and metadata (M) that names processes and
// tracks.
std::string trace_json(const std::vector<TraceEvent>& events);

// One process a run, frames end to end: tracks "CPU" and "GPU" with a slice a frame, "GPU passes" with one a pass, "CPU
// stages" with one a stage, and counters of draws, triangles, dispatches and memory. Where a run holds a frame rate,
// its track "quality" has each frame's decision, and counters tell what it came to. Only lengths were measured: passes
// and stages follow one another without gaps, and "waiting" comes before the frame's own CPU time.
std::vector<TraceEvent> trace_of(const std::vector<CaptureRun>& runs);

void write_trace(const std::filesystem::path& file, const std::vector<CaptureRun>& runs);  // atomic; throws Error

}  // namespace seascape
