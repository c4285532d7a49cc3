// The command query: fixed columns, whole files or none, and the surface of the wave field.
#include "app/query_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "app/commands.h"
#include "app/csv.h"
#include "app/sea_spec.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"
#include "ocean/sea/query.h"
#include "ocean/sea/sea.h"
#include "ocean/waves/wave_particles.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

constexpr const char* header = "x,z,height_m,normal_x,normal_y,normal_z,velocity_x,velocity_y,velocity_z,converged";

std::vector<std::vector<double>> rows_of(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, header);
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) {
      const auto number = real_from(cell);
      EXPECT_TRUE(number.has_value()) << cell;
      rows.back().push_back(number.value_or(std::nan("")));
    }
    EXPECT_EQ(rows.back().size(), 10u);
  }
  return rows;
}

Scene small_scene() {
  Scene scene = load_scene("open_sea", "low");
  scene.settings.waves.resolution = 64;
  return scene;
}

// Control: writing velocity_x twice instead of velocity_y fails here.
TEST(Query, RowsAreTheAnswersOfTheWaveField) {
  const Scene scene = small_scene();
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 9000; ++i) points.emplace_back(0.37 * i - 900.0, -1.9 * i + 33.0);
  const auto rows = rows_of(query_csv(scene, {.times_s = {12.5}}, points));
  ASSERT_EQ(rows.size(), points.size());

  const WaveField field(scene.settings.sea, scene.settings.waves);
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(12.5), tiles);
  for (std::size_t i = 0; i < points.size(); i += 101) {
    QueryAnswer answer;
    query(field, tiles, {&points[i], 1}, {&answer, 1});
    EXPECT_EQ(rows[i],
              (std::vector<double>{points[i].x, points[i].y, answer.height_m, answer.normal.x, answer.normal.y,
                                   answer.normal.z, answer.orbital_velocity_mps.x, answer.orbital_velocity_mps.y,
                                   answer.orbital_velocity_mps.z, answer.converged ? 1.0 : 0.0}));
  }
}

// A scene's wave particles are in its answers. Control seen: the field made without tile_sources().
TEST(Query, WaveParticlesAreInTheAnswers) {
  Scene scene = small_scene();
  scene.effects = {"waves"};
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 50; ++i) points.emplace_back(0.7 * i, -0.3 * i);
  const auto without = rows_of(query_csv(scene, {.times_s = {12.5}}, points));
  scene.effects = {"waves", "wave_particles"};
  scene.settings.wave_particles.height_m = 0.02;
  scene.settings.wave_particles.chop = 0.0;
  const auto with = rows_of(query_csv(scene, {.times_s = {12.5}}, points));
  const WaveField field(scene.settings.sea, scene.settings.waves,
                        {std::make_shared<WaveParticles>(scene.settings.wave_particles)});
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(12.5), tiles);
  double moved = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    QueryAnswer answer;
    query(field, tiles, {&points[i], 1}, {&answer, 1});
    EXPECT_EQ(with[i][2], answer.height_m);
    EXPECT_EQ(with[i][7], answer.orbital_velocity_mps.y);
    moved += std::pow(with[i][2] - without[i][2], 2) / 50.0;
  }
  EXPECT_NEAR(4.0 * std::sqrt(moved), 0.02, 0.006);
}

// Control: a query that takes its waves from scene.settings.sea in any case is not flat here.
TEST(Query, ASceneWithoutWavesIsFlat) {
  Scene scene = small_scene();
  scene.effects.clear();
  const std::vector<glm::dvec2> points{{0, 0}, {1e6, -3}};
  for (const auto& row : rows_of(query_csv(scene, {.times_s = {3.0}}, points))) {
    EXPECT_EQ(row[2], 0.0);
    EXPECT_EQ(row[4], 1.0);
    EXPECT_EQ(row[7], 0.0);
    EXPECT_EQ(row[9], 1.0);
  }
}

// A table without regard to its columns: name by name.
std::map<std::string, std::vector<double>> columns_of(const std::string& text) {
  std::istringstream lines(text);
  std::string line, cell;
  std::getline(lines, line);
  std::vector<std::string> names;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::size_t i = 0;
    for (; std::getline(cells, cell, ','); ++i) columns[names.at(i)].push_back(real_from(cell).value());
    EXPECT_EQ(i, names.size());
  }
  return columns;
}

// Every column in its place, at several times, for an object of a size. Controls seen: flow_z written for flow_x; the
// footprint not handed on.
TEST(Query, AllColumnsAreTheAnswersOfAView) {
  const Scene scene = load_scene("rivers", "low");
  const std::vector<glm::dvec2> points{{20.0, -120.0}, {12.0, -60.0}, {-60.0, -270.0}, {40.0, 10.0}};
  const std::vector<double> times{3.0, 3.5, 9.25};
  const auto table = columns_of(
      query_csv(scene, {.times_s = times, .time_column = true, .all_columns = true, .footprint_m = 1.5}, points));
  EXPECT_EQ(table.size(), 25u);
  SeaSpec spec = sea_spec(scene);
  spec.drawn_velocity = true;
  Sea sea(std::move(spec));
  std::size_t row = 0;
  for (const double time_s : times)
    for (const glm::dvec2& point : points) {
      const QueryAnswer a = sea.view_at(time_s, SeaDetail::drawn).query(point, {.footprint_m = 1.5});
      const std::map<std::string, double> want = {{"time_s", time_s},
                                                  {"x", point.x},
                                                  {"z", point.y},
                                                  {"height_m", a.height_m},
                                                  {"normal_y", a.normal.y},
                                                  {"velocity_z", a.orbital_velocity_mps.z},
                                                  {"converged", double(a.converged)},
                                                  {"displacement_x", a.displacement.x},
                                                  {"displacement_y", a.displacement.y},
                                                  {"displacement_z", a.displacement.z},
                                                  {"eulerian_x", a.eulerian_velocity_mps.x},
                                                  {"eulerian_y", a.eulerian_velocity_mps.y},
                                                  {"eulerian_z", a.eulerian_velocity_mps.z},
                                                  {"flow_x", a.flow_mps.x},
                                                  {"flow_z", a.flow_mps.y},
                                                  {"depth_m", a.depth_m},
                                                  {"still_m", a.still_m},
                                                  {"clipped", double(a.clipped)},
                                                  {"contraction", a.contraction},
                                                  {"residual_m", a.residual_m},
                                                  {"left_out_m", a.left_out_m}};
      for (const auto& [name, value] : want) EXPECT_EQ(table.at(name)[row], value) << name << " " << row;
      ++row;
    }
  EXPECT_GT(std::abs(table.at("flow_x")[0]) + std::abs(table.at("flow_z")[0]), 0.1) << "in the river";
  EXPECT_GT(table.at("still_m")[2], 5.0) << "in the lake";
}

// Dynamic waves are those that frames come to that begin where replay begins, whatever their rate, at every time asked.
// Controls seen: the sea left at its beginning; a viewer elsewhere.
TEST(Query, DynamicWavesAreAsReplayHasThem) {
  Scene scene = load_scene("rain_pool", "low");
  scene.settings.time_start_s = 2.0;
  const std::vector<glm::dvec2> points{{0.0, 0.0}, {0.4, -0.7}, {1.3, 1.0}, {-0.2, 0.5}};
  const auto table = columns_of(query_csv(scene, {.times_s = {3.0, 9.5}, .all_columns = true}, points));
  SeaSpec spec = sea_spec(scene);
  spec.drawn_velocity = true;
  Sea sea(std::move(spec));
  std::size_t row = 0;
  for (int frame = 0; frame <= 225; ++frame) {
    const double time_s = 2.0 + frame / 30.0;
    sea.advance(time_s, scene.start.position_m);
    if (time_s != 3.0 && time_s != 9.5) continue;
    for (const glm::dvec2& point : points) {
      const QueryAnswer a = sea.view_at(time_s, SeaDetail::drawn).query(point),
                        calm = sea.view_at(time_s, SeaDetail::drawn).query(point, {.history = false});
      EXPECT_EQ(table.at("height_m")[row], a.height_m);
      EXPECT_EQ(table.at("eulerian_y")[row], a.eulerian_velocity_mps.y);
      EXPECT_NE(a.height_m, calm.height_m);
      ++row;
    }
  }
  EXPECT_EQ(row, 8u);
}

TEST(Query, DynamicWavesOfOverAnHourAreRefused) {
  const Scene scene = load_scene("rain_pool", "low");
  const std::vector<glm::dvec2> points{{0.0, 0.0}};
  try {
    query_csv(scene, {.times_s = {1.0, 3601.0}}, points);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "rain_pool: dynamic_waves at 3601 s come of more than an hour of steps; ask for times up to 3600 s, set "
              "time.start_s nearer, or leave dynamic_waves out of the scene's effects");
  }
  EXPECT_NO_THROW(query_csv(load_scene("open_sea", "low"), {.times_s = {1e6}}, points));
}

// Control seen: the distance of the ray that ends counted as a meeting.
TEST(Query, RaysMeetTheSurface) {
  const Scene scene = load_scene("lagoon", "low");
  const std::vector<QueryRay> rays{{{-64.0, 7.0, -218.0}, {0.3, -1.0, 0.2}}, {{-64.0, 7.0, -218.0}, {0.3, 1.0, 0.2}}};
  const auto table = columns_of(query_csv(scene, {.times_s = {4.0}}, rays));
  const double distance = table.at("distance_m")[0];
  const glm::dvec3 met = rays[0].origin_m + distance * glm::normalize(rays[0].direction);
  EXPECT_GT(distance, 1.0);
  EXPECT_NEAR(table.at("height_m")[0], met.y, 2e-3);
  EXPECT_NEAR(table.at("x")[0], met.x, 1e-9);
  EXPECT_EQ(table.at("distance_m")[1], -1.0);
}

class QueryFiles : public testing::Test {
 protected:
  QueryFiles() {
    arguments_.command = Command::query;
    arguments_.preset = "low";
    arguments_.overrides = {{"--set", "waves.resolution", "16"}};
    arguments_.points = folder_ / "in.csv";
    arguments_.out = folder_ / "out.csv";
  }
  void points(const std::string& text) { std::ofstream(arguments_.points, std::ios::binary) << text; }
  test::TemporaryFolder folder_;
  Arguments arguments_;
};

TEST_F(QueryFiles, ReadsPointsAndWritesResults) {
  points("x,z\n0,0\n5.5,-2\n");
  EXPECT_EQ(run_query(arguments_), 0);
  const auto rows = rows_of(read_text(arguments_.out));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1][0], 5.5);
  EXPECT_NEAR(std::hypot(rows[1][3], rows[1][4], rows[1][5]), 1.0, 1e-12);
}

TEST_F(QueryFiles, ReadsTimesAndRays) {
  arguments_.times = TimeSpan{0.0, 1.0, 0.25};
  points("x,z\n0,0\n5.5,-2\n");
  EXPECT_EQ(run_query(arguments_), 0);
  EXPECT_EQ(columns_of(read_text(arguments_.out)).at("time_s"),
            (std::vector<double>{0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0}));
  arguments_.times.reset();
  arguments_.ray = true;
  points("x,y,z,direction_x,direction_y,direction_z\n0,30,0,0,-2,0\n");
  EXPECT_EQ(run_query(arguments_), 0);
  EXPECT_NEAR(columns_of(read_text(arguments_.out)).at("distance_m").at(0), 30.0, 5.0);
  points("x,y,z,direction_x,direction_y,direction_z\n0,30,0,0,0,0\n");
  EXPECT_THROW(run_query(arguments_), Error);
  arguments_.ray = false;
  points("x,z\n0,0\n1,1\n");
  arguments_.times = TimeSpan{0.0, 1e6, 0.1};
  EXPECT_THROW(run_query(arguments_), Error) << "too many rows";
}

// Control: writing the header before the points are read leaves an out.csv here.
TEST_F(QueryFiles, AFaultLeavesNoFile) {
  points("x,z\n0,0\n1,nan\n");
  try {
    run_query(arguments_);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              arguments_.points + ":3: z: 'nan' is not a number; give a number from -10000000 to 10000000 m");
  }
  EXPECT_THAT(folder_.names(), testing::ElementsAre("in.csv"));
  points("x,z\n0,0\n");
  arguments_.out = folder_ / "no/out.csv";
  EXPECT_THROW(run_query(arguments_), Error);
  EXPECT_THAT(folder_.names(), testing::ElementsAre("in.csv"));
  arguments_.points = folder_ / "missing.csv";
  EXPECT_THROW(run_query(arguments_), Error);
}

}  // namespace
}  // namespace seascape
