// What `seascape capture` measured, and the files it leaves: capture.csv and report.html (trace.json: trace.h).
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/report_page.h"

namespace seascape {

struct CaptureFrame {
  int frame = 0;        // of the path
  double time_s = 0.0;  // along the path
  double cpu_ms = 0.0, gpu_ms = 0.0;
  std::uint64_t draws = 0, triangles = 0, dispatches = 0;
  std::vector<double> pass_ms;   // GPU time, one for each of CaptureRun::pass_names
  std::vector<double> stage_ms;  // CPU time, one for each of CaptureRun::stage_names
  // Where the run holds a frame rate: what it is drawn at, and why.
  double picture_scale = 1.0, quality = 1.0;
  std::string decision;
};

struct MemoryUse {
  std::string tag;  // what the memory is for
  std::uint64_t bytes = 0;
};

// One scene at one preset.
struct CaptureRun {
  std::string scene, path, preset;
  int width = 0, height = 0;  // per view
  int views = 1, msaa = 1;
  int warmup = 0;        // frames drawn before the first that counts
  double kept_ms = 0.0;  // what a frame may take, where quality was lowered for it; 0: the preset was held
  std::vector<std::string> pass_names, stage_names;
  std::vector<CaptureFrame> frames;
  std::vector<MemoryUse> memory;
};

// The times that a run has by name: passes of the GPU, stages of the processor.
struct CaptureTimes {
  const char* of;       // what their columns begin with
  const char* title;    // whose they are
  const char* outside;  // what is left of the whole
  std::vector<std::string> CaptureRun::*names;
  std::vector<double> CaptureFrame::*ms;
  double (*whole_ms)(const CaptureRun& run, const CaptureFrame& frame);
};
extern const CaptureTimes gpu_passes;
extern const CaptureTimes cpu_stages;  // the whole: cpu_ms, and "waiting" for the GPU before it
// Of all runs, in the order in which they are first met.
std::vector<std::string> all_names(const std::vector<CaptureRun>& runs, const CaptureTimes& kind);
// 0 where the run has none of that name.
double named_time_ms(const CaptureRun& run, const CaptureFrame& frame, const CaptureTimes& kind,
                     const std::string& name);

// What a display waits for: the longer of CPU and GPU, which work on different frames at the same time. Milliseconds;
// NaN if either is.
double frame_ms(const CaptureFrame& frame);
std::vector<double> frame_times_ms(const CaptureRun& run);

// One row a frame; columns as DESIGN.md fixes them, then gpu_NAME_ms for each pass of any run and cpu_NAME_ms
// for each stage, 0 where a run has none of that name; and where a run holds a frame rate picture_scale, quality and
// decision. Numbers are locale-independent; a NaN is written as nan.
std::string capture_csv(const std::vector<CaptureRun>& runs);

// One sentence for a run: which display rates it holds (1 % of frames missed at most) and which it misses, with its
// median, p99 and longest frame.
std::string conclusion(const CaptureRun& run);

// The columns of capture.csv that tell how a frame rate was held; the last is text.
inline constexpr std::array<std::string_view, 3> kept_columns{"picture_scale", "quality", "decision"};

// One sentence for a run that holds a frame rate: how many frames took longer, and its mean quality.
std::string kept_text(const CaptureRun& run);

// One self-contained page: no script, no network, light and dark.
std::string report_html(const Machine& machine, const std::vector<CaptureRun>& runs);

// Atomic; throw Error.
void write_capture_csv(const std::filesystem::path& file, const std::vector<CaptureRun>& runs);
void write_report(const std::filesystem::path& file, const Machine& machine, const std::vector<CaptureRun>& runs);

}  // namespace seascape
