#include "app/arguments.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "app/command_options.h"
#include "app/lab/lab.h"
#include "app/picture_size.h"
#include "app/quality.h"
#include "app/sea_remarks.h"

namespace seascape {

namespace {

constexpr std::array<std::string_view, 9> command_names{"explore", "replay", "capture",  "lab",   "bake",
                                                        "plan",    "query",  "validate", "doctor"};

constexpr std::string_view overview = R"(Seascape: an ocean for virtual reality

Usage: seascape [COMMAND] [OPTIONS]

Commands:
  explore    Fly, walk and ride over the sea, in a window or without a display (the default)
  replay     Draw a camera path to numbered pictures, the same bits every time
  capture    Measure frame times along a camera path: capture.csv, trace.json, report.html
  lab        Measure what accuracy costs in time: curves.csv, plots, report.html
  bake       Record the waves of a scene as a loop of EXR pictures, for the effect baked
  plan       Say what a scene would build and run, why, its memory and its cost
  query      The surface's height, normal and velocity at points of a CSV file; needs no GPU
  validate   Check scenes, paths, input scripts, models and images: every fault with file and place
  doctor     Say which devices there are, what is missing and how to get it

Options of every command: --help, --seed, --set key=value, --log-level. Settings: docs/settings.md
Exit status: 0 done, 1 a fault, 2 wrong usage; a signal ends it as that signal does, with a line.

Examples:
  seascape
  seascape --scene storm --preset low
  seascape replay --scene open_sea --frames 60 --out out
  seascape replay --help
)";

void add_common(Options& options, Arguments& arguments) {
  options.option("--seed", "N", "the scene's", "Which sea of the same statistics (0 to 4294967295)",
                 [&](const std::string& text) {
                   arguments.overrides.push_back({"--seed", "waves.seed", text});
                 });
  std::vector<std::string_view> levels{"trace", "debug", "info", "warn", "error", "off"};
  options.choice("--log-level", levels, "info", "What is told on stderr",
                 [&arguments, levels](int i) { arguments.log_level = levels[static_cast<std::size_t>(i)]; });
  options.app()
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&](const std::vector<std::string>& pairs) {
            for (const std::string& pair : pairs) {
              const std::size_t equals = pair.find('=');
              if (equals == std::string::npos || equals == 0)
                refuse("--set", in_quotes(pair) + " has no key and value", "write --set key=value");
              arguments.overrides.push_back({"--set", pair.substr(0, equals), pair.substr(equals + 1)});
            }
          },
          "Any setting of docs/settings.md; may be repeated")
      ->type_name("key=value")
      ->allow_extra_args(false);
}

void add_scene(Options& options, Arguments& arguments, bool all_presets = false) {
  options.text("--scene", "S", arguments.scene, "A scene file, or the name of one in content/scenes");
  std::vector<std::string_view> presets(preset_names().begin(), preset_names().end());
  presets.push_back("auto");
  if (all_presets) presets.push_back("all");
  options.choice("--preset", presets, "auto", "Quality; auto suits the device",
                 [&arguments, presets](int i) { arguments.preset = presets[static_cast<std::size_t>(i)]; });
}

void add_display(Options& options, Arguments& arguments) {
  options.choice("--display", {"auto", "window", "headset", "simulated", "headless"}, "auto", "Where frames go",
                 [&](int i) { arguments.display = static_cast<DisplayKind>(i); });
}

void add_size(Options& options, Arguments& arguments, const std::string& fallback) {
  options.option("--size", "WxH", fallback, "Pixels of one eye, 1x1 to 16384x16384", [&](const std::string& text) {
    std::string fault;
    const auto size = picture_size_from(text, fault);
    if (!size) refuse("--size", in_quotes(text) + " " + fault, "give two whole numbers from 1 to 16384, as 1280x720");
    arguments.width = (*size)[0];
    arguments.height = (*size)[1];
  });
}

// --stereo and --debug stand for settings.
void add_stereo(Options& options, Arguments& arguments) {
  std::vector<std::string_view> modes{"auto", "single", "per-eye"};
  options.choice("--stereo", modes, "auto", "One pass for both eyes, or a pass per eye", [&arguments, modes](int i) {
    arguments.overrides.push_back({"--stereo", "stereo.mode", std::string(modes[static_cast<std::size_t>(i)])});
  });
}

void add_debug(Options& options, Arguments& arguments) {
  const std::vector<std::string_view> views = find_setting("debug.view")->choices;
  options.choice(
      "--debug", views, "none", "Paints holes in magenta, levels, wires, normals or slices",
      [&arguments, views](int i) {
        arguments.overrides.push_back({"--debug", "debug.view", std::string(views[static_cast<std::size_t>(i)])});
      });
}

void add_views(Options& options, Arguments& arguments) {
  options.whole("--views", arguments.views, 1, 2, "One picture, or left and right");
  options.choice("--eye", {"left", "right", "centre"}, "centre", "Which eye the one picture of --views 1 is",
                 [&](int i) { arguments.eye = static_cast<Eye>(i); });
}

void add_path(Options& options, Arguments& arguments, const std::string& use = "") {
  options.option("--path", "P", "the scene's name", use + "A camera path file, or the name of one in content/paths",
                 [&](const std::string& text) {
                   if (text.empty()) refuse("--path", "the value is empty", "leave --path out or give it one");
                   arguments.path = text;
                 });
}

void add_explore(Options& options, Arguments& arguments) {
  arguments.out = "out";
  add_scene(options, arguments);
  add_display(options, arguments);
  add_size(options, arguments, "1280x720");
  arguments.views = 1;
  options.whole("--views", arguments.views, 1, 2, "One picture, or left and right side by side");
  add_stereo(options, arguments);
  add_debug(options, arguments);
  options.whole("--frames", arguments.frames, 0, 1'000'000,
                "Closes after so many frames; 0 runs until it is closed, or draws one headless");
  options.option("--input", "FILE", "",
                 "What the simulated headset is told: a file, or the name of one in content/inputs",
                 [&](const std::string& text) {
                   if (text.empty()) refuse("--input", "the value is empty", "leave --input out or give it one");
                   arguments.input = text;
                 });
  options.whole("--every", arguments.every, 0, 1'000'000,
                "Keeps the simulated headset's pictures of every Nth frame in --out; 0 keeps none");
  options.text("--out", "DIR", arguments.out, "Folder of screenshots, recorded paths and headless pictures");
}

void add_replay(Options& options, Arguments& arguments) {
  arguments.out = "out";
  add_scene(options, arguments);
  add_path(options, arguments);
  add_size(options, arguments, "1280x720");
  add_views(options, arguments);
  add_stereo(options, arguments);
  add_debug(options, arguments);
  options.number("--fps", "1/s", arguments.fps, 0.1, 1000.0, "Frames a second of the path's time");
  options.whole("--frames", arguments.frames, 0, 1'000'000, "How many frames; 0 goes to the path's end");
  options.whole("--start", arguments.start, 0, 100'000'000, "Number of the first frame");
  options.text("--out", "DIR", arguments.out, "Folder of the pictures and replay.json");
  options.choice("--format", {"png", "exr"}, "png", "png as seen, exr in linear light",
                 [&](int i) { arguments.format = static_cast<PictureFormat>(i); });
}

void add_capture(Options& options, Arguments& arguments) {
  arguments.out = "out";
  add_scene(options, arguments, true);
  add_path(options, arguments);
  add_size(options, arguments, "1280x720");
  add_views(options, arguments);
  add_display(options, arguments);
  add_stereo(options, arguments);
  options.number("--fps", "1/s", arguments.fps, 0.1, 1000.0, "Frames a second of the path's time");
  options.whole("--warmup", arguments.warmup, 0, 100'000, "Frames drawn before measuring");
  options.whole("--frames", arguments.frames, 0, 1'000'000, "Frames measured; 0 goes to the path's end");
  options.whole("--repeat", arguments.repeat, 1, 1000,
                "How often the path is measured; from 2 on CPU and GPU take turns, so that neither disturbs the other");
  options.text("--out", "DIR", arguments.out, "Folder of capture.csv, trace.json and report.html");
  options.text("--against", "FILE", arguments.against,
               "The capture.csv of another build, of the same path: says which stage has changed; with --repeat 16");
}

void add_lab(Options& options, Arguments& arguments) {
  arguments.out = "out/lab";
  std::vector<std::string_view> curves(std::begin(lab_curve_names), std::end(lab_curve_names));
  curves.push_back("all");
  options.choice("--curve", curves, "all", "One curve, or all of them",
                 [&arguments, curves](int i) { arguments.curve = curves[static_cast<std::size_t>(i)]; });
  options.flag("--quick", arguments.quick,
               "Fewer settings and rounds: all curves in five minutes on two cores, instead of forty");
  options.flag("--recommend", arguments.recommend,
               "Names the quality settings on the front of the curve frame that fit --budget, from DIR/curves.csv "
               "where it is there");
  options.option("--budget", "MS", "", "Milliseconds of a frame that --recommend may spend, as 4ms (0.01 to 10000)",
                 [&arguments](const std::string& text) {
                   const std::string_view number = text.ends_with("ms")
                                                       ? std::string_view(text).substr(0, text.size() - 2)
                                                       : std::string_view(text);
                   const auto value = real_from(number);
                   if (!value || !(*value >= 0.01 && *value <= 10000.0))
                     refuse("--budget", in_quotes(text) + (value ? " is out of range" : " is not a time"),
                            "give milliseconds from 0.01 to 10000, as 4ms");
                   arguments.budget_ms = *value;
                 });
  options.text("--out", "DIR", arguments.out,
               "Folder of curves.csv, an SVG a plot and report.html; a run that was stopped goes on there");
}

void add_bake(Options& options, Arguments& arguments) {
  arguments.out = "out";
  arguments.fps = 4.0;
  arguments.frames = 48;
  arguments.width = 128;
  options.text("--scene", "S", arguments.scene, "A scene file, or the name of one in content/scenes");
  options.whole("--frames", arguments.frames, 8, 1000, "Frames of the loop");
  options.number("--fps", "1/s", arguments.fps, 0.1, 240.0, "Frames a second: the loop takes frames / fps seconds");
  options.choice("--size", {"64", "128", "256", "512"}, "128", "Texels a side; waves down to four texels are in it",
                 [&](int i) { arguments.width = 64 << i; });
  options.number("--tile", "m", arguments.tile_m, 0.0, 20000.0,
                 "Side of the loop's tile; 0 takes three peak waves at 64 texels, and more with more");
  options.text("--out", "DIR", arguments.out, "Folder of loop.json and frame_0000.exr and on");
}

void add_plan(Options& options, Arguments& arguments) {
  add_scene(options, arguments);
  add_size(options, arguments, "1280x720");
  add_views(options, arguments);
  options.flag("--json", arguments.json, "Prints JSON");
  options.text("--matrix", "DIR", arguments.matrix,
               "Folder of what each effect costs beside each other, matrix_SCENE_PRESET.csv and .svg, and of the plan "
               "of every preset");
  options.text("--presets", "FILE", arguments.presets,
               "CSV file of what each preset costs: this scene's rows are measured, and put in place of older ones");
  add_path(options, arguments, "Of --presets. ");
  options.whole("--frames", arguments.frames, 0, 100'000,
                "Frames that --matrix times of each two scenes in turn, and --presets of each preset; 0: 24");
}

TimeSpan time_span(const std::string& text) {
  std::array<double, 3> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t colon = rest.find(':');
    const auto number = real_from(rest.substr(0, colon));
    if (!number || (colon == std::string_view::npos) != (i == 2))
      refuse("--times", in_quotes(text) + " is not three numbers with colons between", "write A:B:STEP, as 0:10:0.5");
    numbers[i] = *number;
    rest = colon == std::string_view::npos ? std::string_view() : rest.substr(colon + 1);
  }
  const TimeSpan span{numbers[0], numbers[1], numbers[2]};
  if (!(std::abs(span.from_s) <= 1e9 && std::abs(span.to_s) <= 1e9 && span.from_s <= span.to_s))
    refuse("--times", in_quotes(text) + " is no span of time", "give A and B from -1e9 to 1e9 s, A no later than B");
  if (!(span.step_s > 0.0) || (span.to_s - span.from_s) / span.step_s > 1e6)
    refuse("--times", in_quotes(text) + " has no step or more than a million",
           "give a STEP above 0, (B - A) / 1e6 or more");
  return span;
}

void add_query(Options& options, Arguments& arguments) {
  add_scene(options, arguments);
  options.number("--time", "s", arguments.time_s, -1e9, 1e9, "The sea's time");
  options.option("--times", "A:B:STEP", "", "Times from A to B s instead; rows then begin with time_s",
                 [&](const std::string& text) { arguments.times = time_span(text); });
  options.text("--points", "IN.csv", arguments.points, "Points, with the header x,z in metres");
  options.flag(
      "--ray", arguments.ray,
      "The points are rays, with the header x,y,z,direction_x,direction_y,direction_z; the answers are where they "
      "first meet the surface, with distance_m in the last column (-1: nowhere within 10 km)");
  options.number("--footprint", "m", arguments.footprint_m, 0.0, 1e6,
                 "Size of the object that asks: shorter waves are left out");
  options.choice(
      "--columns", {"basic", "all"}, "basic",
      "all adds displacement_x,_y,_z, eulerian_x,_y,_z (how fast the displacement changes at the fixed place), "
      "flow_x,flow_z, depth_m, still_m, clipped, contraction, residual_m, left_out_m",
      [&](int i) { arguments.all_columns = i == 1; });
  options.text("--out", "OUT.csv", arguments.out,
               "Results: x,z,height_m,normal_x,normal_y,normal_z,velocity_x,velocity_y,velocity_z,converged; the "
               "velocity is the water's (orbital)");
}

void add_validate(Options& options, Arguments& arguments) {
  options.app()
      .add_option("FILE", arguments.files,
                  "Scenes, paths and input scripts (.json), models (.gltf, .glb), images (.png, .exr)")
      ->type_name("");
}

void add_doctor(Options& options, Arguments& arguments) {
  options.flag("--json", arguments.json, "Prints JSON");
  options.flag("--calibrate", arguments.calibrate,
               "Measures anew what a frame takes at each preset, which --preset auto goes by");
}

struct CommandRow {
  Command command;
  const char* sentence;
  const char* examples;
  void (*add)(Options&, Arguments&);
};

constexpr CommandRow commands[] = {
    {Command::explore, "Fly, walk and ride over the sea, in a window or without a display.",
     "  seascape\n  seascape explore --scene storm --preset low\n  seascape --display headless --size 960x540 --out "
     "out",
     add_explore},
    {Command::replay, "Draw a camera path to numbered pictures: the same command gives the same bits.",
     "  seascape replay --scene open_sea --frames 60 --out out\n"
     "  seascape replay --scene storm --views 1 --eye left --format exr --out out",
     add_replay},
    {Command::capture, "Measure frame times along a camera path.",
     "  seascape capture --preset all --views 2 --frames 300 --out out\n"
     "  seascape capture --scene swell --size 1280x720 --views 1 --set msaa=1\n"
     "  seascape capture --scene storm --repeat 16 --against before/capture.csv",
     add_capture},
    {Command::lab,
     "Measure what accuracy costs in time: errors against references in double precision, beside the time they take, "
     "for seas of 3, 10 and 25 m/s of wind.",
     "  seascape lab --quick\n  seascape lab --curve query --out out/lab\n  seascape lab --recommend --budget 30ms",
     add_lab},
    {Command::bake,
     "Record the waves of a scene as a loop of EXR pictures of displacement, which the effect baked plays.",
     "  seascape bake --scene storm --frames 64 --fps 4 --size 128 --out loops/storm\n"
     "  seascape --scene baked --set baked.loop=loops/storm",
     add_bake},
    {Command::plan, "Say what a scene would build and run, why, its memory and its cost.",
     "  seascape plan --scene storm --preset high\n  seascape plan --json\n"
     "  seascape plan --scene storm --presets out/presets.csv",
     add_plan},
    {Command::query, "The surface at points of a CSV file, without a GPU.",
     "  seascape query --scene swell --time 12.5 --points points.csv --out surface.csv\n"
     "  seascape query --scene rain_pool --times 0:10:0.1 --columns all --points points.csv --out surface.csv\n"
     "  seascape query --scene lagoon --ray --points rays.csv --out met.csv",
     add_query},
    {Command::validate, "Check files and tell every fault with file and place; exit status 1 if there is any.",
     "  seascape validate content/scenes/*.json content/paths/*.json\n  seascape validate boat.glb sky.exr",
     add_validate},
    {Command::doctor, "Say which devices there are, what is missing and how to get it.",
     "  seascape doctor\n  seascape doctor --json", add_doctor},
};

}  // namespace

std::vector<double> TimeSpan::all() const {
  std::vector<double> times;
  const auto steps = std::int64_t(std::floor((to_s - from_s) / step_s + 1e-9));
  for (std::int64_t i = 0; i <= steps; ++i) times.push_back(from_s + double(i) * step_s);
  return times;
}

Arguments parse_arguments(std::span<const std::string> words) {
  Arguments arguments;
  std::size_t row = 0;  // explore
  if (!words.empty() && (words[0] == "--help" || words[0] == "-h" || words[0] == "help" || words[0] == "--version")) {
    arguments.command = Command::text;
    arguments.text = words[0] == "--version" ? "seascape " SEASCAPE_VERSION "\n" : std::string(overview);
    return arguments;
  }
  if (!words.empty() && (words[0].empty() || words[0][0] != '-')) {
    row = static_cast<std::size_t>(std::find(command_names.begin(), command_names.end(), words[0]) -
                                   command_names.begin());
    if (row == command_names.size())
      refuse("", "unknown command " + in_quotes(words[0]) + did_you_mean(words[0], command_names),
             "take " + listed(command_names) + "; see seascape --help");
    words = words.subspan(1);
  }
  const CommandRow& command = commands[row];
  arguments.command = command.command;
  Options options(command_names[row], command.sentence, command.examples);
  command.add(options, arguments);
  add_common(options, arguments);
  if (std::string help = options.parse(words); !help.empty()) {
    arguments.command = Command::text;
    arguments.text = std::move(help);
    return arguments;
  }
  if (arguments.command == Command::query && (arguments.points.empty() || arguments.out.empty()))
    refuse(arguments.points.empty() ? "--points" : "--out", "a file is needed",
           "give both, as seascape query --points points.csv --out surface.csv");
  if (arguments.times && options.app().count("--time") > 0)
    refuse("--times", "it and --time are given", "leave one of them out");
  if (arguments.recommend != (arguments.budget_ms > 0.0))
    refuse(arguments.recommend ? "--budget" : "--recommend",
           arguments.recommend ? "a budget is needed" : "a budget needs it",
           "give both, as seascape lab --recommend --budget 30ms");
  if (arguments.command == Command::validate && arguments.files.empty())
    refuse("", "no file to validate", "give one or more, as seascape validate scene.json");
  if (arguments.command == Command::explore && arguments.display != DisplayKind::simulated)
    for (const char* option : {"--input", "--every"})
      if (options.app().count(option) > 0)
        refuse(option, "it is for the simulated headset alone", "add --display simulated, or leave it out");
  if (arguments.views == 2 && arguments.eye != Eye::centre) refuse("--eye", "one eye needs one view", "add --views 1");
  Settings scratch;  // a wrong override is wrong usage, told before anything is opened
  for (const Override& one : arguments.overrides) set_from_text(scratch, one.key, one.value, one.option, 2);
  if (arguments.command == Command::lab)
    for (const Override& one : arguments.overrides)
      if (one.key != "waves.seed")
        refuse("--set", "the lab sets " + one.key + " itself",
               "leave it out; of the sea's settings it takes --seed alone");
  return arguments;
}

Scene scene_from(const Arguments& arguments, std::string_view preset, std::optional<DeviceClass> device) {
  Scene scene = load_scene(arguments.scene, preset);
  if (device) suit_device(scene.settings, preset, *device);
  for (const Override& one : arguments.overrides) set_over_file(scene, one.option, one.key, one.value);
  return scene;
}

void tell_remarks(const Scene& scene) {
  for (const std::string& remark : remarks_of(scene)) spdlog::warn("{}", remark);
}

CameraPath path_from(const Arguments& arguments, const Scene& scene) {
  return load_camera_path(arguments.path.empty() ? scene.name : arguments.path);
}

}  // namespace seascape
