// Images of what belongs to places hold the same whichever way the viewer came.
#include "ocean/drawn/drawn_place.h"

#include <random>

#include "app/scene.h"
#include "app/sea_spec.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape {
namespace {

class DrawnPlaceImages : public test::GpuTest {};

std::vector<std::vector<std::uint8_t>> bytes_of(const DrawnPlace& place) {
  std::vector<std::vector<std::uint8_t>> bytes;
  Uses uses{};
  place.add_uses(uses);
  for (const Use& use : uses)
    if (use.image != nullptr)
      for (std::uint32_t layer = 0; layer < use.image->spec().layers; ++layer)
        bytes.push_back(read_image(test::device(), *use.image, layer));
  return bytes;
}

// To the bit as if made where he is, after steps of all sizes, up and down too: levels and currents of rivers; a
// lagoon's bed and the waves along its shore. Only what has come in is copied. Controls seen: slices copied whole;
// columns that came in not copied; slopes beside them left as they were.
TEST_F(DrawnPlaceImages, AreTheSameWhicheverWayTheViewerCame) {
  for (const char* name : {"rivers", "lagoon"}) {
    const Scene scene = load_scene(name, "low");
    SeaSpec spec = sea_spec(scene);
    spec.place.settings.windows = {.resolution = 64, .slices = 4, .texel_m = 0.5};
    Sea sea(std::move(spec));
    DrawnPlace walked(test::device(), sea);
    Frame frame(test::device(), 4096);
    const SeaView view = sea.view(0, SeaDetail::felt);
    const auto draw = [&](DrawnPlace& place, glm::dvec3 viewer) {
      frame.begin();
      place.update(frame, {sea, view, 0.0, viewer});
      frame.submit();
      return frame.counts().moved.copied;
    };
    std::mt19937 random(5);
    const auto next = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
    glm::dvec3 viewer = scene.start.position_m;
    viewer.y = 2.0;
    const std::uint64_t all = draw(walked, viewer);
    EXPECT_EQ(draw(walked, viewer), 0u) << "nothing has moved";
    EXPECT_LT(draw(walked, viewer += glm::dvec3(0.5, 0.0, 0.0)), all / 8) << "a texel of the finest";
    for (int n = 1; n <= 60; ++n) {
      viewer += glm::dvec3(next(2.0), 0.0, next(2.0));
      if (n % 15 == 0) viewer += glm::dvec3(next(60.0), 0.0, next(60.0));
      viewer.y = n > 30 && n < 45 ? 20.0 : 2.0;
      draw(walked, viewer);
      if (n % 6 != 0) continue;
      DrawnPlace anew(test::device(), sea);
      draw(anew, viewer);
      frame.finish();
      const auto want = bytes_of(anew), got = bytes_of(walked);
      ASSERT_EQ(want.size(), got.size());
      ASSERT_GE(want.size(), 8u);
      for (std::size_t i = 0; i < want.size(); ++i) EXPECT_EQ(want[i], got[i]) << name << ' ' << n << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace seascape
