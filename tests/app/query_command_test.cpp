// The command query: fixed columns, whole files or none, and the surface of the wave field.
#include "app/query_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "app/commands.h"
#include "app/csv.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"
#include "ocean/sea/query.h"
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
  const auto rows = rows_of(query_csv(scene, 12.5, points));
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
  const auto without = rows_of(query_csv(scene, 12.5, points));
  scene.effects = {"waves", "wave_particles"};
  scene.settings.wave_particles.height_m = 0.1;
  scene.settings.wave_particles.chop = 0.0;
  const auto with = rows_of(query_csv(scene, 12.5, points));
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
  EXPECT_NEAR(4.0 * std::sqrt(moved), 0.1, 0.03);
}

// Control: a query that takes its waves from scene.settings.sea in any case is not flat here.
TEST(Query, ASceneWithoutWavesIsFlat) {
  Scene scene = small_scene();
  scene.effects.clear();
  const std::vector<glm::dvec2> points{{0, 0}, {1e6, -3}};
  for (const auto& row : rows_of(query_csv(scene, 3.0, points))) {
    EXPECT_EQ(row[2], 0.0);
    EXPECT_EQ(row[4], 1.0);
    EXPECT_EQ(row[7], 0.0);
    EXPECT_EQ(row[9], 1.0);
  }
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
