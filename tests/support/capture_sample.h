// A capture with figures that tests can work out by hand.
#pragma once
#include <string>
#include <vector>

#include "app/report.h"

namespace seascape::test {

// Frames 0 to `count` - 1 at 30 a second; GPU times `ms`, `ms` + 0.01 ... in two thirds and one third over two passes.
inline CaptureRun capture_run(const std::string& preset, double ms, int count, const std::vector<std::string>& passes) {
  CaptureRun run;
  run.scene = run.path = "open_sea";
  run.preset = preset;
  run.width = 1280;
  run.height = 720;
  run.views = 2;
  run.msaa = 4;
  run.pass_names = passes;
  run.stage_names = {"waiting", "sea", "recording"};
  run.memory = {{"textures", 3 << 20}, {"buffers", 1 << 19}};
  for (int i = 0; i < count; ++i) {
    const double gpu = ms + 0.01 * i;
    CaptureFrame frame{i, i / 30.0, 1.5, gpu, 7, 123456, 12, {}, {0.25, 0.5, 0.125}};
    for (std::size_t k = 0; k < passes.size(); ++k)
      frame.pass_ms.push_back(k == 0 ? gpu * 2.0 / 3.0 : gpu / 3.0 / static_cast<double>(passes.size() - 1));
    run.frames.push_back(frame);
  }
  return run;
}

inline Machine machine() { return {"Some GPU", "Some driver 1.2", "Some CPU", 2, "0.1 release", "2026-11-21", 42}; }

}  // namespace seascape::test
