// Spray as it is drawn: seen where it flies, hidden by the crests before it in every shape of the frame, and no draw
// where there is none.
#include <algorithm>
#include <cmath>

#include "engine/view.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using Set = std::vector<std::pair<std::string, std::string>>;

class DrawnSprayPuffs : public test::GpuTest {
 protected:
  static std::size_t draws(SeaShot& shot) {
    const DrawnSpray* spray = shot.experience().spray();
    std::size_t count = 0;
    for (const PipelineWork& work : shot.experience().frame().work())
      if (spray && work.pipeline == spray->pipeline().get()) count += work.draws;
    return count;
  }
};

// Each puff is projected by hand. Where none lies that may be seen, nothing is drawn over the sea, though many lie
// there behind a crest that stands half a metre and more before them; elsewhere there is spray. In either shape of the
// frame, of one sample and four, forward and deferred. Controls seen: no depth test in the forward pass, and none in
// the fragment shader.
TEST_F(DrawnSprayPuffs, AreHiddenBehindCrests) {
  constexpr int width = 240, height = 136;
  struct Shape {
    const char *msaa, *shape, *lighting;
  };
  for (const Shape& shape : {Shape{"1", "tile", "forward"},
                             {"4", "desktop", "forward"},
                             {"1", "tile", "deferred"},
                             {"1", "desktop", "deferred"}}) {
    SCOPED_TRACE(std::string(shape.msaa) + " " + shape.shape + " " + shape.lighting);
    const Set set{{"msaa", shape.msaa},  {"frame.shape", shape.shape}, {"frame.lighting", shape.lighting},
                  {"spray.amount", "2"}, {"spray.range_m", "200"},     {"spray.most", "8000"}};
    const auto shot_of = [&](std::vector<std::string> effects) {
      return SeaShot({.scene = "storm",
                      .preset = "medium",
                      .width = width,
                      .height = height,
                      .set = set,
                      .effects = std::move(effects)});
    };
    SeaShot with = shot_of({"waves", "spray"}), without = shot_of({"waves"});
    EXPECT_EQ(with.experience().deferred(), std::string(shape.lighting) == "deferred");
    int hidden_pixels = 0, seen = 0;
    const WaveField field(with.scene().settings.sea, with.scene().settings.waves);
    WaveTiles tiles;
    // From the deepest troughs of a minute and a half.
    const glm::dvec2 here(0.0);
    std::vector<std::pair<double, double>> troughs;
    for (double t = 20.0; t < 110.0; t += 3.0) {
      field.evaluate(ticks_from_seconds(t), tiles);
      QueryAnswer water;
      query(field, tiles, {&here, 1}, {&water, 1});
      troughs.emplace_back(water.height_m, t);
    }
    std::sort(troughs.begin(), troughs.end());
    for (int moment = 0; moment < 2; ++moment) {
      const auto [height_m, time_s] = troughs[std::size_t(moment)];
      const Viewpoint view = with.viewpoint(pose({0.0, height_m + 1.5, 0.0}, moment == 0 ? 20.0 : 200.0, 0.0));
      const Image8 a = with.picture(view, time_s), b = without.picture(view, time_s);
      EXPECT_EQ(draws(with), 1u);
      field.evaluate(ticks_from_seconds(time_s), tiles);
      const View& eye = view.eyes[0];
      const glm::dmat4 clip = projection(eye.fov, 0.1) * eye_from_relative(eye.pose, view.viewer.position_m);
      std::vector<gpu::SprayPuff> puffs(with.scene().settings.spray.most);
      puffs.resize(with.experience().ocean().spray()->drawn(time_s, view.viewer.position_m, puffs));
      std::vector<char> may(std::size_t(width * height)), behind(may.size());
      for (const gpu::SprayPuff& puff : puffs) {
        const glm::dvec3 relative(puff.place.x, double(puff.place.y) - view.viewer.position_m.y, puff.place.z);
        const glm::dvec4 at = clip * glm::dvec4(relative, 1.0);
        if (at.w < 0.5) continue;
        bool hidden = false;
        for (double s = 0.05; s < 0.96 && !hidden; s += 0.01) {
          const glm::dvec3 on = view.viewer.position_m + s * relative;
          const glm::dvec2 place(on.x, on.z);
          QueryAnswer water;
          query(field, tiles, {&place, 1}, {&water, 1}, {.footprint_m = 0.5, .most_iterations = 12});
          hidden = water.height_m - on.y > 0.5 && glm::length(s * relative) > 2.0;
        }
        const double pixels = 0.5 * height / eye.fov.up / at.w,
                     around = hidden ? 0.4 * pixels * double(puff.place.w)
                                     : pixels * double(puff.place.w + glm::length(glm::vec3(puff.streak))) + 1.5;
        const double x = (0.5 + 0.5 * at.x / at.w) * width, y = (0.5 + 0.5 * at.y / at.w) * height;
        for (int j = std::max(int(y - around), 0); j <= std::min(int(y + around), height - 1); ++j)
          for (int i = std::max(int(x - around), 0); i <= std::min(int(x + around), width - 1); ++i)
            (hidden ? behind : may)[std::size_t(j * width + i)] = 1;
      }
      for (std::size_t i = 0; i < may.size(); ++i) {
        const bool same = test::light_at(a, i) == test::light_at(b, i);
        seen += may[i] && !same;
        if (may[i]) continue;
        hidden_pixels += behind[i];
        EXPECT_TRUE(same) << time_s << " s, pixel " << int(i) % width << " " << int(i) / width
                          << (behind[i] ? ", behind a crest" : "") << test::leave(a, "spray_hidden");
        if (!same) break;
      }
    }
    RecordProperty(std::string("hidden_") + shape.msaa + shape.shape + shape.lighting, hidden_pixels);
    EXPECT_GT(hidden_pixels, 40);
    EXPECT_GT(seen, 400);
  }
}

// Where no wind tears anything off there is no draw more than without the effect, nor from high above; down again, or
// once it blows, the first frame has it.
TEST_F(DrawnSprayPuffs, CostNoDrawWhereNoneFly) {
  const Set set{{"waves.resolution", "64"}, {"waves.wind_speed_mps", "6"}, {"waves.change_s", "0"}};
  const auto shot_of = [&](std::vector<std::string> effects) {
    return SeaShot(
        {.scene = "storm", .preset = "medium", .width = 64, .height = 36, .set = set, .effects = std::move(effects)});
  };
  SeaShot with = shot_of({"waves", "spray"}), without = shot_of({"waves"});
  const Pose low = pose({0.0, 6.0, 0.0}, 330.0, -5.0), high = pose({0.0, 400.0, 0.0}, 330.0, -45.0);
  for (int i = 0; i < 4; ++i) {
    with.draw(low, 1.0 + 0.1 * i);
    without.draw(low, 1.0 + 0.1 * i);
    EXPECT_EQ(with.counts().hash, without.counts().hash);
  }
  with.set("waves.wind_speed_mps", "23");
  with.draw(low, 10.0);
  EXPECT_EQ(draws(with), 1u);
  with.draw(high, 10.1);
  EXPECT_EQ(draws(with), 0u);
  with.draw(low, 10.2);
  EXPECT_EQ(draws(with), 1u);
}

}  // namespace
}  // namespace seascape
