#include "app/trace.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/report_plots.h"
#include "engine/files.h"

namespace seascape {

namespace {

// A JSON string with its quotes; bytes that are not UTF-8 become U+FFFD.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

double finite(double value) { return std::isfinite(value) ? value : 0.0; }

double finite_length(double value) { return std::max(0.0, finite(value)); }

}  // namespace

std::string trace_json(const std::vector<TraceEvent>& events) {
  std::map<std::string, int> processes;
  std::map<std::pair<int, std::string>, int> tracks;
  std::string names, text;  // names of processes and tracks, then the events
  const auto begin = [](std::string& out) {
    if (!out.empty()) out += ",\n";
  };
  for (const TraceEvent& event : events) {
    const auto [process, new_process] = processes.try_emplace(event.process, static_cast<int>(processes.size()) + 1);
    const int pid = process->second;
    if (new_process) {
      begin(names);
      names += fmt::format(R"({{"ph":"M","name":"process_name","pid":{},"tid":0,"args":{{"name":{}}}}})", pid,
                           quoted(event.process));
    }
    const bool slice = event.kind == TraceEvent::Kind::slice;
    int tid = 0;
    if (slice) {
      const auto [track, new_track] = tracks.try_emplace({pid, event.track}, static_cast<int>(tracks.size()) + 1);
      tid = track->second;
      if (new_track) {
        begin(names);
        names +=
            fmt::format(R"({{"ph":"M","name":"thread_name","pid":{0},"tid":{1},"args":{{"name":{2}}}}},)"
                        R"({{"ph":"M","name":"thread_sort_index","pid":{0},"tid":{1},"args":{{"sort_index":{1}}}}})",
                        pid, tid, quoted(event.track));
      }
    }
    begin(text);
    fmt::format_to(std::back_inserter(text), R"({{"ph":"{}","pid":{},"tid":{},"ts":{:.3f})", slice ? 'X' : 'C', pid,
                   tid, finite(event.start_us));
    if (slice) fmt::format_to(std::back_inserter(text), R"(,"dur":{:.3f})", finite_length(event.duration_us));
    text += ",\"name\":" + quoted(event.name) + ",\"args\":{";
    for (std::size_t i = 0; i < event.values.size(); ++i) {
      const auto& [name, value] = event.values[i];
      text += (i ? "," : "") + quoted(name) + ":" + (std::isfinite(value) ? fmt::format("{}", value) : "null");
    }
    text += "}}";
  }
  if (!names.empty() && !text.empty()) names += ",\n";
  return "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n" + names + text + "\n]}\n";
}

std::vector<TraceEvent> trace_of(const std::vector<CaptureRun>& runs) {
  std::vector<TraceEvent> events;
  for (const CaptureRun& run : runs) {
    const std::string process = run_label(run, runs);
    double now = 0.0;
    const auto slice = [&](const char* track, const std::string& name, double start, double us) {
      events.push_back({TraceEvent::Kind::slice, process, track, name, start, us, {}});
    };
    const auto counter = [&](const char* name, double value) {
      events.push_back({TraceEvent::Kind::counter, process, "", name, now, 0.0, {{name, value}}});
    };
    if (!run.memory.empty()) {
      events.push_back({TraceEvent::Kind::counter, process, "", "memory MiB", 0.0, 0.0, {}});
      for (const MemoryUse& use : run.memory)
        events.back().values.emplace_back(use.tag, static_cast<double>(use.bytes) / 1048576.0);
    }
    for (const CaptureFrame& frame : run.frames) {
      const std::string name = fmt::format("frame {}", frame.frame);
      slice("CPU", name, now, 1000.0 * frame.cpu_ms);
      events.back().values = {{"path time s", frame.time_s}};
      slice("GPU", name, now, 1000.0 * frame.gpu_ms);
      const auto slices = [&](const char* track, const CaptureTimes& kind) {
        double passed = 0.0;
        for (const std::string& part : run.*kind.names) {
          const double us = 1000.0 * finite_length(named_time_ms(run, frame, kind, part));
          if (us > 0.0) slice(track, part, now + passed, us);
          passed += us;
        }
        return passed;
      };
      const double passes_us = slices("GPU passes", gpu_passes), stages_us = slices("CPU stages", cpu_stages);
      if (run.kept_ms > 0.0) {
        slice("quality", frame.decision, now, 1000.0 * finite_length(frame_ms(frame)));
        counter("quality", frame.quality);
        counter("picture scale", frame.picture_scale);
      }
      counter("draws", static_cast<double>(frame.draws));
      counter("triangles", static_cast<double>(frame.triangles));
      counter("dispatches", static_cast<double>(frame.dispatches));
      // Timers of passes or stages may add up to more than the frame's own; slices of one track must not overlap.
      now +=
          std::max({1000.0 * finite_length(frame.cpu_ms), 1000.0 * finite_length(frame.gpu_ms), passes_us, stages_us});
    }
  }
  return events;
}

void write_trace(const std::filesystem::path& file, const std::vector<CaptureRun>& runs) {
  write_atomically(file, trace_json(trace_of(runs)));
}

}  // namespace seascape
