#include "app/query_command.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/commands.h"
#include "app/csv.h"
#include "app/progress.h"
#include "app/sea_spec.h"
#include "app/sea_time.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"
#include "ocean/sea/sea.h"

namespace seascape {

namespace {

constexpr std::size_t block = 4096;         // points that one core answers at a time
constexpr double longest_steps_s = 3600.0;  // that dynamic waves are stepped for
constexpr const char* fixed_columns =
    "x,z,height_m,normal_x,normal_y,normal_z,velocity_x,velocity_y,velocity_z,converged";
constexpr const char* further_columns =
    ",displacement_x,displacement_y,displacement_z,eulerian_x,eulerian_y,eulerian_z,flow_x,flow_z,depth_m,still_m,"
    "clipped,contraction,residual_m,left_out_m";

void append_answer(std::string& text, const QueryRequest& request, double time_s, const glm::dvec2& place,
                   const QueryAnswer& a, const double* distance_m) {
  std::array<double, 26> row;
  std::size_t count = 0;
  const auto add = [&](std::initializer_list<double> numbers) {
    for (const double number : numbers) row[count++] = number;
  };
  if (request.time_column) add({time_s});
  add({place.x, place.y, a.height_m, a.normal.x, a.normal.y, a.normal.z, a.orbital_velocity_mps.x,
       a.orbital_velocity_mps.y, a.orbital_velocity_mps.z, a.converged ? 1.0 : 0.0});
  if (request.all_columns)
    add({a.displacement.x, a.displacement.y, a.displacement.z, a.eulerian_velocity_mps.x, a.eulerian_velocity_mps.y,
         a.eulerian_velocity_mps.z, a.flow_mps.x, a.flow_mps.y, a.depth_m, a.still_m, a.clipped ? 1.0 : 0.0,
         a.contraction, a.residual_m, a.left_out_m});
  if (distance_m != nullptr) add({*distance_m});
  append_csv_row(text, std::span(row).first(count));
}

std::string header_of(const QueryRequest& request, bool rays) {
  return std::string(request.time_column ? "time_s," : "") + fixed_columns +
         (request.all_columns ? further_columns : "") + (rays ? ",distance_m" : "") + "\n";
}

// The sea of a scene at one time after another.
class SeaAt {
 public:
  SeaAt(const Scene& scene, std::span<const double> times_s)
      : scene_(scene), begin_s_(sea_time_s(scene.settings, 0.0)), sea_(spec_of(scene)) {
    if (sea_.dynamic_waves() == nullptr) return;
    const auto far = std::find_if(times_s.begin(), times_s.end(),
                                  [&](double time_s) { return time_s - begin_s_ > longest_steps_s; });
    if (far != times_s.end())
      throw Error(scene.name, "dynamic_waves at " + text_from(*far) + " s come of more than an hour of steps",
                  "ask for times up to " + text_from(begin_s_ + longest_steps_s) +
                      " s, set time.start_s nearer, or leave dynamic_waves out of the scene's effects");
  }
  SeaView view(double time_s) {
    if (sea_.dynamic_waves() != nullptr) step(time_s);
    return sea_.view_at(time_s, SeaDetail::drawn);
  }

 private:
  static SeaSpec spec_of(const Scene& scene) {
    SeaSpec spec = sea_spec(scene);
    spec.drawn_velocity = true;
    return spec;
  }
  // As replay comes to it; before its beginning, and backwards, dynamic waves begin anew.
  void step(double time_s) {
    const glm::dvec3 eye = scene_.start.position_m;
    constexpr double frame_s = 1.0;
    if (!begun_ && time_s >= begin_s_) sea_.advance(begin_s_, eye);
    const double from_s = begun_ || time_s >= begin_s_ ? std::max(sea_.time_s(), begin_s_) : time_s;
    const auto frames = std::size_t(std::max(0.0, std::ceil((time_s - from_s) / frame_s)));
    Progress progress("query: seconds of dynamic waves", frames);
    for (std::size_t i = 1; i < frames; ++i) {
      sea_.advance(from_s + double(i) * frame_s, eye);
      progress.step(i);
    }
    sea_.advance(time_s, eye);
    begun_ = begun_ || time_s >= begin_s_;
  }
  const Scene& scene_;
  double begin_s_;
  Sea sea_;
  bool begun_ = false;
};

// Rows of `count` points or rays at each time: row(view, time, i, text) adds one.
template <class Rows>
std::string table(const Scene& scene, const QueryRequest& request, bool rays, std::size_t count, const Rows& rows_of) {
  std::string text = header_of(request, rays);
  SeaAt sea(scene, request.times_s);
  Progress progress(rays ? "query: rays" : "query: points", count * request.times_s.size());
  constexpr std::size_t blocks_at_once = 64;
  std::array<std::string, blocks_at_once> rows;
  std::size_t done = 0;
  for (const double time_s : request.times_s) {
    const SeaView view = sea.view(time_s);
    for (std::size_t begin = 0; begin < count; begin += block * blocks_at_once) {
      tbb::parallel_for(std::size_t{0}, blocks_at_once, [&](std::size_t i) {
        rows[i].clear();
        const std::size_t first = std::min(count, begin + i * block);
        rows_of(view, time_s, first, std::min(block, count - first), rows[i]);
      });
      for (const std::string& part : rows) text += part;
      progress.step(done + begin);
    }
    done += count;
  }
  return text;
}

}  // namespace

std::string query_csv(const Scene& scene, const QueryRequest& request, std::span<const glm::dvec2> points) {
  return table(scene, request, false, points.size(),
               [&](const SeaView& view, double time_s, std::size_t first, std::size_t count, std::string& text) {
                 std::vector<QueryAnswer> answers(count);
                 view.query(points.subspan(first, count), answers, {.footprint_m = request.footprint_m});
                 for (std::size_t i = 0; i < count; ++i)
                   append_answer(text, request, time_s, points[first + i], answers[i], nullptr);
               });
}

std::string query_csv(const Scene& scene, const QueryRequest& request, std::span<const QueryRay> rays) {
  return table(scene, request, true, rays.size(),
               [&](const SeaView& view, double time_s, std::size_t first, std::size_t count, std::string& text) {
                 for (std::size_t i = 0; i < count; ++i) {
                   const QueryRay& ray = rays[first + i];
                   const RayAnswer met = view.ray(ray.origin_m, ray.direction, {.footprint_m = request.footprint_m});
                   const glm::dvec3 at = ray.origin_m + met.distance_m * glm::normalize(ray.direction);
                   const double distance_m = met.hit ? met.distance_m : -1.0;
                   append_answer(text, request, time_s, {at.x, at.z}, met.water, &distance_m);
                 }
               });
}

namespace {
// A table in the place of what it is made from cannot be made again.
void refuse_to_replace(const Arguments& arguments, const Scene& scene) {
  std::vector<std::filesystem::path> read{arguments.points, scene.file};
  for (const InputSpec& input : scene.inputs) {
    if (const auto* shape = std::get_if<ShapeInput>(&input.shape))
      read.push_back(scene.file.parent_path() / shape->file);
    if (const auto* texture = std::get_if<TextureInput>(&input.shape))
      read.push_back(scene.file.parent_path() / texture->file);
  }
  for (const std::filesystem::path& file : read)
    if (same_file(file, arguments.out))
      throw Error(
          "--out",
          in_quotes(arguments.out, 400) + " is the file " + in_quotes(file.string(), 400) + " that the query reads",
          "name another file", 2);
}

std::vector<QueryRay> parse_rays(const std::string& file) {
  constexpr std::array<std::string_view, 6> columns{"x", "y", "z", "direction_x", "direction_y", "direction_z"};
  const std::vector<double> numbers = parse_table(read_text(file), file, columns);
  std::vector<QueryRay> rays(numbers.size() / 6);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double* n = &numbers[6 * i];
    rays[i] = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    if (!(glm::length(rays[i].direction) > 1e-9))
      throw Error(file, "ray " + std::to_string(i + 1) + " has no direction", "give a direction longer than 1e-9");
  }
  return rays;
}
}  // namespace

int run_query(const Arguments& arguments) {
  const Scene scene = scene_from(arguments, arguments.preset);
  tell_remarks(scene);
  refuse_to_replace(arguments, scene);
  QueryRequest request{.times_s = {arguments.time_s},
                       .time_column = arguments.times.has_value(),
                       .all_columns = arguments.all_columns,
                       .footprint_m = arguments.footprint_m};
  if (arguments.times) request.times_s = arguments.times->all();
  const auto fits = [&](std::size_t count) {
    if (count * request.times_s.size() > most_csv_rows)
      throw Error("--times",
                  std::to_string(request.times_s.size()) + " times and " + std::to_string(count) +
                      " points make more than " + std::to_string(most_csv_rows) + " rows",
                  "give fewer times or points");
  };
  std::string text;
  if (arguments.ray) {
    const std::vector<QueryRay> rays = parse_rays(arguments.points);
    fits(rays.size());
    text = query_csv(scene, request, rays);
  } else {
    const std::vector<glm::dvec2> points = parse_points(read_text(arguments.points), arguments.points);
    fits(points.size());
    text = query_csv(scene, request, points);
  }
  write_atomically(arguments.out, text);
  return 0;
}

}  // namespace seascape
