#include "app/lab/load_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/csv.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"
#include "ocean/waves/split_mix.h"

namespace seascape {

namespace {

// Numbers that follow from a seed and the order of the calls.
class Chance {
 public:
  Chance(std::uint64_t seed, std::uint64_t stream) : key_(split_mix(seed * split_mix_step + stream)) {}
  double share() { return share_of(split_mix(key_ += split_mix_step)); }
  double between(double a, double b) { return a + (b - a) * share(); }
  // Box and Muller 1958.
  double normal() {
    const double u = 1.0 - share(), v = share();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

 private:
  std::uint64_t key_;
};

constexpr std::size_t usual_frames = 1800;

LoadTrace steady(std::string_view family, int index, Chance& chance, std::size_t frames = usual_frames) {
  LoadTrace trace;
  trace.family = family;
  trace.name = fmt::format("{} {}", family, index + 1);
  constexpr double fixed[] = {0.3, 0.15, 0.45, 0.0, 0.6};
  trace.fixed_share = fixed[index % 5];
  trace.mean.assign(frames, chance.between(0.55, 0.75));
  trace.period_ms.assign(frames, load_unit_ms);
  return trace;
}

// The load is the mean with lognormal noise; timings arrive after the dead time.
void finish(LoadTrace& trace, double noise, Chance& chance) {
  trace.load = trace.mean;
  for (double& load : trace.load) load *= std::exp(noise * chance.normal());
  trace.arrivals.assign(trace.frames(), {trace.dead_frames + 1, false, 1.0});
}

void scale(LoadTrace& trace, std::size_t from, std::size_t to, double factor) {
  for (std::size_t t = from; t < std::min(to, trace.mean.size()); ++t) trace.mean[t] *= factor;
}

LoadTrace step_trace(bool up, int index, Chance& chance) {
  LoadTrace trace = steady(up ? "step up" : "step down", index, chance);
  const double factor = chance.between(1.25, 1.6);
  const auto at = std::size_t(chance.between(500.0, 700.0));
  if (up)
    scale(trace, at, usual_frames, factor);
  else
    scale(trace, 0, at, factor);
  finish(trace, 0.03, chance);
  return trace;
}

LoadTrace ramp_trace(int index, Chance& chance) {
  LoadTrace trace = steady("ramp", index, chance);
  const double most = chance.between(1.3, 1.7), long_s = chance.between(60.0, 500.0);
  for (std::size_t t = 0; t < usual_frames; ++t) {  // up, stays, down
    const double up = std::clamp((double(t) - 300.0) / long_s, 0.0, 1.0);
    const double down = std::clamp((double(t) - 1100.0) / long_s, 0.0, 1.0);
    trace.mean[t] *= 1.0 + (most - 1.0) * (up - down);
  }
  finish(trace, 0.03, chance);
  return trace;
}

LoadTrace spike_trace(int index, Chance& chance) {
  LoadTrace trace = steady("spike", index, chance);
  const double factor = chance.between(1.6, 2.4);
  const bool regular = index % 2 == 0;
  finish(trace, 0.03, chance);
  const auto every = std::size_t(chance.between(60.0, 120.0));
  for (std::size_t t = every / 2; t < usual_frames;
       t += regular ? every : std::size_t(chance.between(0.4, 1.6) * double(every)))
    trace.load[t] *= factor;
  return trace;
}

// Water is dearer than land, or land than water.
LoadTrace look_trace(std::string_view family, int index, int dead_frames, Chance& chance) {
  LoadTrace trace = steady(family, index, chance);
  trace.dead_frames = dead_frames;
  const double factor = chance.between(1.25, 1.45);
  bool sea = false;
  for (std::size_t t = 0; t < usual_frames; sea = !sea) {
    const std::size_t stays = index % 2 == 0 ? 45 : std::size_t(chance.between(25.0, 90.0));
    if (sea) scale(trace, t, t + stays, factor);
    t += stays;
  }
  finish(trace, 0.03, chance);
  return trace;
}

// Grows over ten seconds; on it gusts that come and go (an autoregression of first order, 20 frames long).
LoadTrace storm_trace(int index, Chance& chance) {
  LoadTrace trace = steady("storm", index, chance);
  const double most = chance.between(1.3, 1.6);
  double gust = 0.0;
  for (std::size_t t = 0; t < usual_frames; ++t) {
    const double grown = std::clamp((double(t) - 300.0) / 900.0, 0.0, 1.0);
    gust = 0.95 * gust + 0.05 * std::sqrt(1.0 - 0.95 * 0.95) * chance.normal();
    trace.mean[t] *= (1.0 + (most - 1.0) * grown) * std::exp(grown * gust);
  }
  finish(trace, 0.03, chance);
  return trace;
}

// The processor slows by a quarter: over ten minutes, or in steps as a driver takes them.
LoadTrace thermal_trace(int index, Chance& chance) {
  const bool whole = index == 4;
  LoadTrace trace = steady("thermal", index, chance, whole ? 54000 : 5400);
  const double frames = double(trace.mean.size());
  for (std::size_t t = 0; t < trace.mean.size(); ++t) {
    double slower = 0.25 * double(t) / frames;
    if (index % 2 == 1) slower = std::floor(slower / 0.05) * 0.05;
    trace.mean[t] /= 1.0 - slower;
  }
  finish(trace, 0.03, chance);
  return trace;
}

LoadTrace noise_trace(std::string_view family, double noise, int index, Chance& chance) {
  LoadTrace trace = steady(family, index, chance);
  finish(trace, noise, chance);
  return trace;
}

LoadTrace refresh_trace(int index, Chance& chance) {
  LoadTrace trace = steady("refresh", index, chance);
  constexpr double rates[][3] = {{72.0, 90.0, 120.0}, {120.0, 90.0, 72.0}, {90.0, 120.0, 72.0}};
  for (std::size_t t = 0; t < usual_frames; ++t) trace.period_ms[t] = 1000.0 / rates[index % 3][t / 600];
  finish(trace, 0.03, chance);
  return trace;
}

LoadTrace governor_trace(int index, Chance& chance) {
  LoadTrace trace = steady("governor", index, chance);
  trace.governed = true;
  trace.clock_told = index % 2 == 0;
  const auto at = std::size_t(chance.between(500.0, 700.0));
  scale(trace, at, at + 600, chance.between(1.15, 1.4));
  finish(trace, 0.03, chance);
  return trace;
}

// One timing of a hundred is wrong: too long by a compositor's work, or too short.
LoadTrace outlier_trace(int index, Chance& chance) {
  LoadTrace trace = steady("outliers", index, chance);
  const auto at = std::size_t(chance.between(500.0, 700.0));
  scale(trace, at, at + 600, chance.between(1.1, 1.4));
  finish(trace, 0.03, chance);
  for (Arrival& one : trace.arrivals)
    if (chance.share() < 0.01) one.factor = chance.share() < 0.7 ? chance.between(1.5, 5.0) : chance.between(0.1, 0.6);
  return trace;
}

LoadTrace lossy_trace(int index, Chance& chance) {
  LoadTrace trace = steady("lost timings", index, chance);
  const auto at = std::size_t(chance.between(500.0, 700.0));
  scale(trace, at, at + 600, chance.between(1.1, 1.4));
  finish(trace, 0.03, chance);
  const double lost = chance.between(0.2, 0.6);
  for (Arrival& one : trace.arrivals) {
    one.lost = chance.share() < lost;
    if (chance.share() < 0.2) one.age += int(chance.between(1.0, 5.0));
    if (chance.share() < 0.1) one.factor = 0.0;
  }
  return trace;
}

// Other programs, or a scene's own work now and then: dearer for 2 to 20 frames, at random.
LoadTrace burst_trace(int index, Chance& chance) {
  LoadTrace trace = steady("bursts", index, chance);
  const double seldom = chance.between(20.0, 120.0);
  for (std::size_t t = 0; t < usual_frames;) {
    t += 5 + std::size_t(-seldom * std::log(1.0 - chance.share()));
    const auto lasts = std::size_t(chance.between(2.0, 20.0));
    scale(trace, t, t + lasts, chance.between(1.3, 2.0));
    t += lasts;
  }
  finish(trace, 0.03, chance);
  return trace;
}

struct Family {
  std::string_view name;
  LoadTrace (*make)(int index, Chance& chance);
};
constexpr Family made_families[] = {
    {"step up", [](int i, Chance& c) { return step_trace(true, i, c); }},
    {"step down", [](int i, Chance& c) { return step_trace(false, i, c); }},
    {"ramp", ramp_trace},
    {"spike", spike_trace},
    {"look", [](int i, Chance& c) { return look_trace("look", i, 2, c); }},
    {"storm", storm_trace},
    {"thermal", thermal_trace},
    {"noise 0", [](int i, Chance& c) { return noise_trace("noise 0", 0.0, i, c); }},
    {"noise 3 %", [](int i, Chance& c) { return noise_trace("noise 3 %", 0.03, i, c); }},
    {"noise 10 %", [](int i, Chance& c) { return noise_trace("noise 10 %", 0.1, i, c); }},
    {"dead time", [](int i, Chance& c) { return look_trace("dead time", i, i % 4 + 1, c); }},
    {"refresh", refresh_trace},
    {"governor", governor_trace},
    {"outliers", outlier_trace},
    {"lost timings", lossy_trace},
    {"bursts", burst_trace},
};

}  // namespace

std::size_t next_clock(std::size_t clock, std::size_t frame, double busy_share) {
  if (frame % clock_frames != clock_frames - 1) return clock;
  if (busy_share > 0.9) return std::min(clock + 1, std::size(clock_levels) - 1);
  return busy_share < 0.7 && clock > 0 ? clock - 1 : clock;
}

std::span<const std::string_view> trace_families() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Family& family : made_families) all.push_back(family.name);
    all.push_back("recorded");
    return all;
  }();
  return names;
}

std::vector<LoadTrace> made_traces(std::uint64_t seed, int each) {
  std::vector<LoadTrace> traces;
  for (std::size_t f = 0; f < std::size(made_families); ++f)
    for (int i = 0; i < each; ++i) {
      Chance chance(seed, 64 * f + std::uint64_t(i));
      traces.push_back(made_families[f].make(i, chance));
    }
  return traces;
}

std::vector<LoadTrace> parse_recorded(std::string_view text, const std::string& where, std::uint64_t seed) {
  const std::string_view first = text.substr(0, text.find_first_of("\r\n"));
  const std::vector<std::string> names = csv_cells(first);
  const std::vector<std::string_view> columns(names.begin(), names.end());
  const std::vector<double> cells = parse_table(text, where, columns);
  const std::size_t rows = cells.size() / names.size();
  std::vector<LoadTrace> traces;
  for (std::size_t c = 0; c < names.size(); ++c) {
    Chance chance(seed, 4096 + c);
    LoadTrace trace = steady("recorded", int(c), chance, usual_frames);
    trace.name = "recorded " + names[c];
    // There and back, so that no jump is made where the path ends; the seed chooses where it begins.
    const auto start = std::size_t(chance.share() * double(rows));
    std::vector<double> cost(rows);
    for (std::size_t r = 0; r < rows; ++r) {
      cost[r] = cells[r * names.size() + c];
      if (!(cost[r] > 0.0))
        throw Error(fmt::format("{}:{}", where, r + 2), names[c] + " is not over 0", "record the table anew");
    }
    trace.load.resize(usual_frames);
    const std::vector<double> base = trace.mean;
    for (std::size_t t = 0; t < usual_frames; ++t) {
      const std::size_t at = (start + t) % (2 * rows);
      trace.load[t] = base[t] * cost[at < rows ? at : 2 * rows - 1 - at];
    }
    for (std::size_t t = 0; t < usual_frames; ++t) {  // a median of nine is the mean without noise
      std::vector<double> near;
      for (std::size_t u = t < 4 ? 0 : t - 4; u < std::min(usual_frames, t + 5); ++u) near.push_back(trace.load[u]);
      std::nth_element(near.begin(), near.begin() + std::ptrdiff_t(near.size() / 2), near.end());
      trace.mean[t] = near[near.size() / 2];
    }
    trace.arrivals.assign(usual_frames, {trace.dead_frames + 1, false, 1.0});
    traces.push_back(std::move(trace));
  }
  return traces;
}

std::vector<LoadTrace> recorded_traces(const std::filesystem::path& file, std::uint64_t seed) {
  return parse_recorded(read_text(file), file.string(), seed);
}

LoadTrace reference_trace(ReferenceRun run, std::uint64_t seed) {
  Chance chance(seed, 8192 + std::uint64_t(run));
  LoadTrace trace = steady("reference", 0, chance);
  trace.mean.assign(usual_frames, 0.62);
  if (run == ReferenceRun::step) scale(trace, 600, 1200, 1.45);
  if (run == ReferenceRun::look)
    for (std::size_t t = 45; t < usual_frames; t += 90) scale(trace, t, t + 45, 1.35);
  finish(trace, 0.03, chance);
  if (run == ReferenceRun::spike)
    for (std::size_t t = 89; t < usual_frames; t += 90) trace.load[t] *= 2.2;
  return trace;
}

}  // namespace seascape
