// Any bytes as an input script: read or refused; what is read is finite at any time, tells each press once, and
// survives being written.
#include "app/input_script_file.h"

#include <cmath>

#include "tests/fuzz/fuzz.h"

using namespace seascape;

namespace {

void check_frame(const InputTimeline& line, double time_s) {
  for (const Tracker tracker : {Tracker::head, Tracker::left, Tracker::right}) {
    const std::optional<Pose> pose = line.pose(tracker, time_s);
    if (!pose) continue;
    const glm::dvec3& p = pose->position_m;
    fuzz::require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "positions are finite");
    fuzz::require(std::abs(glm::length(pose->orientation) - 1.0) < 1e-9, "orientations have length 1");
  }
  const ActionValues values = line.values(time_s);
  for (const ActionRow& row : action_rows()) {
    const double value = values[std::size_t(row.action)];
    fuzz::require(value >= row.least() && value <= 1.0, "actions are in range");
  }
}

// In whatever spans a script is played, all happens, once.
void check_spans(const InputTimeline& line, double step_s) {
  std::size_t presses = 0, states = 0;
  double before_s = -1.0;
  for (int i = 0; i < 50; ++i) {
    const double now_s = i < 49 ? step_s * i : line.end_s();
    if (now_s < before_s) continue;
    presses += line.presses(before_s, now_s).size();
    states += line.states(before_s, now_s).size();
    before_s = now_s;
  }
  fuzz::require(presses == line.presses(-1.0, 1e10).size(), "no press is lost nor told twice");
  fuzz::require(states == line.states(-1.0, 1e10).size(), "no state is lost nor told twice");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  Faults faults(true);
  parse_input_script(text, "input.json", faults);
  const bool read = fuzz::reads([&] {
    const InputScript script = parse_input_script(text, "input.json");
    const InputTimeline line(script);
    double last_s = 0.0;
    for (const InputEvent& event : script.events) {
      fuzz::require(event.time_s >= last_s, "events are in order");
      check_frame(line, event.time_s);
      for (const double part : {1e-9, 0.3, 0.7}) check_frame(line, last_s + part * (event.time_s - last_s));
      last_s = event.time_s;
    }
    for (const double step_s : {script.end_s() / 30.0, 0.01, 1.0}) check_spans(line, step_s);
    const std::string written = input_script_text(script);
    const InputScript again = parse_input_script(written, "written.json");
    fuzz::require(again.events.size() == script.events.size(), "a written script has the same events");
    fuzz::require(input_script_text(again) == written, "a written script reads back to the bit");
  });
  fuzz::require(read == faults.list().empty(), "collecting and throwing agree on whether there is a fault");
  return 0;
}
