// Spray as it is drawn: seen where it flies, hidden by the crests before it in every shape of the frame, and no draw
// where there is none.
#include <algorithm>
#include <cmath>

#include "engine/multiview_check.h"
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

// Where spray may be seen from an eye and where some lies behind a crest, each puff projected by hand.
struct SprayPixels {
  std::vector<char> may, behind;
};

constexpr int width = 240, height = 136;

// Two shots of a storm, one of them with spray, and the waves of both.
struct Storm {
  Storm(const Set& set, int views, bool per_eye)
      : with(options(set, views, per_eye, {"waves", "spray"})),
        without(options(set, views, per_eye, {"waves"})),
        field(with.scene().settings.sea, with.scene().settings.waves) {}

  static test::ShotOptions options(const Set& set, int views, bool per_eye, std::vector<std::string> effects) {
    return {.scene = "storm",
            .preset = "medium",
            .width = width,
            .height = height,
            .views = views,
            .per_eye = per_eye,
            .set = set,
            .effects = std::move(effects)};
  }
  // Heights at the origin with their times: the deepest troughs of a minute and a half come first.
  std::vector<std::pair<double, double>> troughs() {
    const glm::dvec2 here(0.0);
    std::vector<std::pair<double, double>> found;
    for (double t = 20.0; t < 110.0; t += 3.0) {
      field.evaluate(ticks_from_seconds(t), tiles);
      QueryAnswer water;
      query(field, tiles, {&here, 1}, {&water, 1});
      found.emplace_back(water.height_m, t);
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  double water_m(const glm::dvec3& at) const {
    const glm::dvec2 place(at.x, at.z);
    QueryAnswer water;
    query(field, tiles, {&place, 1}, {&water, 1}, {.footprint_m = 0.5, .most_iterations = 12});
    return water.height_m;
  }
  // Of what `with` drew last, for a viewer at `viewer`.
  SprayPixels seen_from(const View& eye, const glm::dvec3& viewer, double time_s) {
    field.evaluate(ticks_from_seconds(time_s), tiles);
    const glm::dmat4 clip = projection(eye.fov, 0.1) * eye_from_relative(eye.pose, viewer);
    const glm::dvec3 from = eye.pose.position_m - viewer;
    std::vector<gpu::SprayPuff> puffs(with.scene().settings.spray.most);
    puffs.resize(with.experience().ocean().spray()->drawn(time_s, viewer, puffs));
    SprayPixels pixels{std::vector<char>(std::size_t(width * height)), std::vector<char>(std::size_t(width * height))};
    for (const gpu::SprayPuff& puff : puffs) {
      const glm::dvec3 relative(puff.place.x, double(puff.place.y) - viewer.y, puff.place.z), way = relative - from;
      const glm::dvec4 at = clip * glm::dvec4(relative, 1.0);
      if (at.w < 0.5) continue;
      bool hidden = false;
      for (double s = 0.05; s < 0.96 && !hidden; s += 0.01) {
        const glm::dvec3 on = eye.pose.position_m + s * way;
        hidden = water_m(on) - on.y > 0.5 && glm::length(s * way) > 2.0;
      }
      const double scale = 0.5 * height / eye.fov.up / at.w,
                   around = hidden ? 0.4 * scale * double(puff.place.w)
                                   : scale * double(puff.place.w + glm::length(glm::vec3(puff.streak))) + 1.5;
      const double x = (0.5 + 0.5 * at.x / at.w) * width, y = (0.5 + 0.5 * at.y / at.w) * height;
      for (int j = std::max(int(y - around), 0); j <= std::min(int(y + around), height - 1); ++j)
        for (int i = std::max(int(x - around), 0); i <= std::min(int(x + around), width - 1); ++i)
          (hidden ? pixels.behind : pixels.may)[std::size_t(j * width + i)] = 1;
    }
    return pixels;
  }

  SeaShot with, without;
  WaveField field;
  WaveTiles tiles;
};

Set shape_of(const char* msaa, const char* shape, const char* lighting) {
  return {{"msaa", msaa},        {"frame.shape", shape},   {"frame.lighting", lighting},
          {"spray.amount", "2"}, {"spray.range_m", "200"}, {"spray.most", "8000"}};
}

struct SprayCounts {
  int hidden = 0, seen = 0;
};

// No pixel where none of it may be seen is another than without spray.
void expect_hidden(const SprayPixels& where, const Image8& with, const Image8& without, const std::string& what,
                   SprayCounts& counts) {
  for (std::size_t i = 0; i < where.may.size(); ++i) {
    const bool same = test::light_at(with, i) == test::light_at(without, i);
    counts.seen += where.may[i] && !same;
    if (where.may[i]) continue;
    counts.hidden += where.behind[i];
    EXPECT_TRUE(same) << what << ", pixel " << int(i) % width << " " << int(i) / width
                      << (where.behind[i] ? ", behind a crest " : " ") << test::leave(with, "spray_hidden");
    if (!same) break;
  }
}

// Where no puff lies that may be seen, nothing is drawn over the sea, though many lie there behind a crest that stands
// half a metre and more before them; elsewhere there is spray. In either shape of the frame, of one sample and four,
// forward and deferred. Controls seen: no depth test in the forward pass, and none in the fragment shader.
TEST_F(DrawnSprayPuffs, AreHiddenBehindCrests) {
  struct Shape {
    const char *msaa, *shape, *lighting;
  };
  for (const Shape& shape : {Shape{"1", "tile", "forward"},
                             {"4", "desktop", "forward"},
                             {"1", "tile", "deferred"},
                             {"1", "desktop", "deferred"}}) {
    const std::string what = std::string(shape.msaa) + " " + shape.shape + " " + shape.lighting;
    Storm storm(shape_of(shape.msaa, shape.shape, shape.lighting), 1, false);
    EXPECT_EQ(storm.with.experience().deferred(), std::string(shape.lighting) == "deferred");
    SprayCounts counts;
    const auto troughs = storm.troughs();
    for (int moment = 0; moment < 2; ++moment) {
      const auto [height_m, time_s] = troughs[std::size_t(moment)];
      const Viewpoint view = storm.with.viewpoint(pose({0.0, height_m + 1.5, 0.0}, moment == 0 ? 20.0 : 200.0, 0.0));
      const Image8 a = storm.with.picture(view, time_s), b = storm.without.picture(view, time_s);
      EXPECT_EQ(draws(storm.with), 1u);
      expect_hidden(storm.seen_from(view.eyes[0], view.viewer.position_m, time_s), a, b,
                    what + " " + std::to_string(time_s) + " s", counts);
    }
    RecordProperty("hidden_" + what, counts.hidden);
    EXPECT_GT(counts.hidden, 40);
    EXPECT_GT(counts.seen, 400);
  }
}

// Of two eyes far apart each has crests of its own before its spray: the left one stands 9 m higher and looks over what
// hides it from the right one. One sample a pixel, by the depth that was drawn for that eye, in one pass for both and
// in a pass each. Control seen: the left eye's depth for both (the planted fault spray_left_depth).
TEST_F(DrawnSprayPuffs, AreHiddenFromEachEyeByItsOwnCrests) {
  const bool together = multiview_works(test::device(), test::shaders());
  for (const bool per_eye : {false, true}) {
    if (!per_eye && !together) continue;
    Storm storm(shape_of("1", per_eye ? "desktop" : "tile", "deferred"), 2, per_eye);
    ASSERT_TRUE(storm.with.experience().deferred());
    const auto [height_m, time_s] = storm.troughs().front();
    const Pose head = pose({0.0, height_m + 1.5, 0.0}, 20.0, 0.0);
    std::vector<View> eyes = stereo_views(head, symmetric_fov(60.0, double(width) / height), 5.0);
    eyes[0].pose.position_m.y += 9.0;
    const Viewpoint view{head, eyes};
    const auto a = storm.with.pictures(view, time_s), b = storm.without.pictures(view, time_s);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      SprayCounts counts;
      expect_hidden(storm.seen_from(view.eyes[eye], head.position_m, time_s), a[eye], b[eye],
                    std::string(per_eye ? "a pass an eye, " : "one pass, ") + (eye == 0 ? "left" : "right"), counts);
      RecordProperty("hidden_" + std::to_string(per_eye) + std::to_string(eye), counts.hidden);
      if (eye == 1) {
        EXPECT_GT(counts.hidden, 20);
      }
      EXPECT_GT(counts.seen, 100) << eye;
    }
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
