// `seascape lab`: measures every curve that is asked for, in every sea, and writes what they come to.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "app/commands.h"
#include "app/lab/adaptive_report.h"
#include "app/lab/drawn_curves.h"
#include "app/lab/lab_report.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/svg.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/output_folder.h"

namespace seascape {

namespace {

namespace fs = std::filesystem;

bool needs_device(const std::string& curve) {
  return curve == "all" || curve == "mesh" || curve == "compute" || curve == "levers" || curve == "frame";
}

// One curve in one sea is a part: kept in a file of its own until all are there, so that a run that is stopped goes on
// where it was.
fs::path part_file(const fs::path& out, const std::string& curve, double wind_mps) {
  return out / fmt::format("part_{}_{}.csv", curve, sea_name(wind_mps));
}

std::optional<std::vector<LabPoint>> kept_part(const fs::path& file, const LabOrigin& origin) {
  if (!fs::exists(file)) return std::nullopt;
  std::error_code unknown, absent;
  const auto built = fs::last_write_time("/proc/self/exe", unknown), measured = fs::last_write_time(file, absent);
  if (!unknown && !absent && measured < built) {
    spdlog::info("{} is older than this program, and is measured anew", file.string());
    return std::nullopt;
  }
  try {
    LabRows rows = parse_curves_csv(read_text(file), file.string());
    if (!rows.points.empty() && same_origin(rows.origin, origin)) return std::move(rows.points);
    spdlog::info("{} is of another machine, build, seed or mode, and is measured anew", file.string());
  } catch (const Error& fault) {
    spdlog::warn("{}; it is measured anew", fault.what());
  }
  return std::nullopt;
}

std::vector<LabPoint> measured(const std::vector<LabCurve>& curves, const LabOptions& options, const LabOrigin& origin,
                               const fs::path& out) {
  const double seconds = options.quick ? 1.5 : 20.0;
  std::vector<LabPoint> points;
  std::vector<fs::path> parts;
  for (const LabCurve& curve : curves) {
    const std::vector<double> winds = curve.at_sea
                                          ? std::vector<double>(std::begin(lab_winds_mps), std::end(lab_winds_mps))
                                          : std::vector<double>{0.0};
    for (const double wind_mps : winds) {
      parts.push_back(part_file(out, curve.name, wind_mps));
      std::optional<std::vector<LabPoint>> part = kept_part(parts.back(), origin);
      if (!part) {
        Progress progress(fmt::format("lab: {} at {}, per cent", curve.name, sea_name(wind_mps)), 100);
        const auto step = [&](double share) { progress.step(std::size_t(100.0 * share)); };
        part = curve.points ? curve.points(wind_mps, options, step)
                            : measure(curve.name, wind_mps, curve.tasks(wind_mps, options), options, seconds, step);
        write_atomically(parts.back(), curves_csv(*part, origin));
      }
      points.insert(points.end(), part->begin(), part->end());
    }
  }
  write_atomically(out / "curves.csv", curves_csv(points, origin));
  for (const LabCurve& curve : curves) {
    const std::vector<std::string> units = error_units(curve.name, points);
    for (std::size_t u = 0; u < units.size(); ++u)
      write_atomically(out / (u == 0 ? curve.name + ".svg" : fmt::format("{}_{}.svg", curve.name, u + 1)),
                       standalone_svg(curve_plot(curve, points, units[u])));
  }
  write_atomically(out / "report.html", lab_html(curves, points, origin));
  for (const fs::path& part : parts) fs::remove(part);
  return points;
}

// A plot a trace and the table of all, in a folder of their own: the curve alone shows families, not frames.
void write_traces(const LabOptions& options, const fs::path& out) {
  const std::vector<LoadTrace> traces = lab_traces(options.seed, options.quick ? 1 : 5);
  Progress progress("lab: traces of adaptive quality", traces.size());
  fs::create_directories(out / "adaptive");
  std::vector<JudgedTrace> judged;
  for (const LoadTrace& trace : traces) {
    judged.push_back(judge(trace));
    write_atomically(out / "adaptive" / trace_file_name(trace), trace_svg(trace));
    progress.step(judged.size());
  }
  write_atomically(out / "adaptive.csv", adaptive_csv(judged));
  fmt::print("{}", adaptive_table(judged));
}

int recommend(const std::vector<LabPoint>& points, double budget_ms) {
  bool all_fit = true;
  for (const double wind_mps : lab_winds_mps) {
    const std::string sea = sea_name(wind_mps);
    const std::vector<LabPoint> fit = recommended(points, 1e3 * budget_ms, sea);
    if (fit.empty()) {
      all_fit = false;
      const std::vector<LabPoint> any = recommended(points, 1e300, sea);
      if (any.empty())
        throw Error("curves.csv", "it has no curve frame at " + sea, "measure it: seascape lab --curve frame");
      fmt::print("{}: nothing fits {:.3g} ms; the quickest takes {:.3g} ms: {}\n", sea, budget_ms,
                 1e-3 * any.back().time_us.median, any.back().settings);
      continue;
    }
    fmt::print("{}: {:.3g} of {:.3g} ms, an error of {:.3g} {}{}\n ", sea, 1e-3 * fit[0].time_us.median, budget_ms,
               fit[0].error.value, fit[0].error.unit, fit[0].preset.empty() ? "" : ": preset " + fit[0].preset);
    for (std::size_t at = 0; at < fit[0].settings.size();) {
      const std::size_t end = std::min(fit[0].settings.find(' ', at), fit[0].settings.size());
      fmt::print(" --set {}", fit[0].settings.substr(at, end - at));
      at = end + 1;
    }
    fmt::print("\n");
  }
  return all_fit ? 0 : 1;
}

}  // namespace

int run_lab(const Arguments& arguments) {
  Settings settings;
  for (const Override& one : arguments.overrides) set_from_text(settings, one.key, one.value, one.option, 2);
  const fs::path out = arguments.out;
  const std::string curve = arguments.recommend && arguments.curve == "all" ? "frame" : arguments.curve;
  if (arguments.recommend && fs::exists(out / "curves.csv")) {
    const fs::path file = out / "curves.csv";
    const LabRows rows = parse_curves_csv(read_text(file), file.string());
    if (!points_of(rows.points, "frame").empty()) {
      fmt::print("from {}, measured {} with {}\n", file.string(), rows.origin.machine.date, rows.origin.machine.device);
      return recommend(rows.points, arguments.budget_ms);
    }
  }
  const OutputFolder held(out);
  LabOptions options;
  options.quick = arguments.quick;
  options.seed = settings.sea.seed;
  std::optional<Device> device;
  ShaderLibrary shaders{ShaderLibrary::default_directory(), DiskCache::of_user()};
  if (needs_device(curve)) device.emplace(device_options());
  LabOrigin origin{machine_of(device ? device->facts() : DeviceFacts{}, options.seed), options.quick};

  std::vector<LabCurve> curves = cpu_curves();
  if (device)
    for (LabCurve& one : drawn_curves(*device, shaders)) curves.push_back(std::move(one));
  if (curve != "all") std::erase_if(curves, [&](const LabCurve& one) { return one.name != curve; });
  const std::vector<LabPoint> points = measured(curves, options, origin, out);
  if (device) expect_no_validation_messages(*device);
  fmt::print("{}", lab_table(curves, points));
  if (std::any_of(curves.begin(), curves.end(), [](const LabCurve& one) { return one.name == "adaptive"; }))
    write_traces(options, out);
  fmt::print("{}: curves.csv, report.html and a plot a curve\n", out.string());
  return arguments.recommend ? recommend(points, arguments.budget_ms) : 0;
}

}  // namespace seascape
