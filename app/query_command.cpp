#include "app/query_command.h"

#include <spdlog/spdlog.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "app/commands.h"
#include "app/csv.h"
#include "app/progress.h"
#include "app/sea_spec.h"
#include "engine/files.h"
#include "ocean/effects.h"
#include "ocean/sea/sea.h"

namespace seascape {

namespace {

constexpr std::size_t block = 4096;  // points that one core answers at a time

void append_answer(std::string& text, const glm::dvec2& point, const QueryAnswer& answer) {
  append_csv_row(text, std::array{point.x, point.y, answer.height_m, answer.normal.x, answer.normal.y, answer.normal.z,
                                  answer.orbital_velocity_mps.x, answer.orbital_velocity_mps.y,
                                  answer.orbital_velocity_mps.z, answer.converged ? 1.0 : 0.0});
}

}  // namespace

std::string query_csv(const Scene& scene, double time_s, std::span<const glm::dvec2> points) {
  SeaSpec spec = sea_spec(scene);
  spec.drawn_velocity = true;
  Sea sea(std::move(spec));
  const SeaView view = sea.view_at(time_s, SeaDetail::drawn);

  std::string text = "x,z,height_m,normal_x,normal_y,normal_z,velocity_x,velocity_y,velocity_z,converged\n";
  Progress progress("query: points", points.size());
  constexpr std::size_t blocks_at_once = 64;
  std::array<std::string, blocks_at_once> rows;
  for (std::size_t begin = 0; begin < points.size(); begin += block * blocks_at_once) {
    tbb::parallel_for(std::size_t{0}, blocks_at_once, [&](std::size_t i) {
      rows[i].clear();
      const std::size_t first = std::min(points.size(), begin + i * block);
      const auto asked = points.subspan(first, std::min(block, points.size() - first));
      std::vector<QueryAnswer> answers(asked.size());
      view.query(asked, answers);
      for (std::size_t p = 0; p < asked.size(); ++p) append_answer(rows[i], asked[p], answers[p]);
    });
    for (const std::string& part : rows) text += part;
    progress.step(begin);
  }
  return text;
}

int run_query(const Arguments& arguments) {
  const Scene scene = scene_from(arguments, arguments.preset);
  tell_remarks(scene);
  if (calls_for(scene.effects, "dynamic_waves"))
    spdlog::warn("query: the answers leave out {}'s dynamic_waves, which depend on what came before", scene.name);
  const std::vector<glm::dvec2> points = parse_points(read_text(arguments.points), arguments.points);
  write_atomically(arguments.out, query_csv(scene, arguments.time_s, points));
  return 0;
}

}  // namespace seascape
