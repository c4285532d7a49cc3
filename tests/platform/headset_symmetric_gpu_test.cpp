// Both eyes drawn with one field of view in a headset on the simulated runtime: what is shown is what each eye sees by
// itself, on the same grid of pixels. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/experience.h"
#include "app/frame.h"
#include "app/program.h"
#include "tests/support/gpu/headset_rig.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::HeadsetRig;
using test::HostileRuntime;

class HeadsetSymmetricTest : public test::GpuTest {};

constexpr int width = 96, height = 80;

// Eyes that see more outwards than inwards, one a little more than the other, and are turned outwards by 8 degrees.
SimulatedOptions canted(const std::filesystem::path& out = {}) {
  SimulatedOptions options = test::simulated();
  InputScript& script = options.script;
  script.width = width;
  script.height = height;
  script.eyes = {{{-52, 41, 44, -48}, {-40, 53, 43, -47}}};
  const auto head = [](double yaw, double roll) {
    return Pose{{0.4, 1.9, -0.3},
                glm::angleAxis(yaw, glm::dvec3(0.0, 1.0, 0.0)) * glm::angleAxis(roll, glm::dvec3(0.0, 0.0, 1.0))};
  };
  script.events = {test::tracked(0, Tracker::head, head(0.2, 0.3)), test::tracked(9, Tracker::head, head(0.9, -0.2))};
  if (!out.empty()) {
    options.out = out;
    options.every = 1;
  }
  return options;
}

void cant(HostileRuntime& calls) {
  calls.instead.LocateViews = [&calls](XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                                       std::uint32_t room, std::uint32_t* count, XrView* views) {
    const XrResult result = calls.real.LocateViews(session, info, state, room, count, views);
    for (std::uint32_t eye = 0; eye < std::min(room, 2u); ++eye) {
      Pose pose = pose_from(views[eye].pose);
      pose.orientation =
          pose.orientation * glm::angleAxis(glm::radians(eye == 0 ? 8.0 : -8.0), glm::dvec3(0.0, 1.0, 0.0));
      views[eye].pose = xr_pose(pose);
    }
    return result;
  };
}

HeadsetOptions symmetric() {
  HeadsetOptions options;
  options.symmetric = true;
  return options;
}

// Tangents of a pixel's middle, of a picture of a field.
glm::dvec2 tangents(const Fov& f, const glm::dvec2& pixel, const glm::dvec2& size) {
  return {f.left + (f.right - f.left) * (pixel.x + 0.5) / size.x, f.up + (f.down - f.up) * (pixel.y + 0.5) / size.y};
}

Fov of(const XrFovf& f) {
  return {std::tan(double(f.angleLeft)), std::tan(double(f.angleRight)), std::tan(double(f.angleUp)),
          std::tan(double(f.angleDown))};
}

bool is_hidden(const std::vector<glm::vec2>& corners, const glm::dvec2& at) {
  const auto side = [&](const glm::dvec2& a, const glm::dvec2& b) {
    return (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
  };
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const double ab = side(corners[i], corners[i + 1]), bc = side(corners[i + 1], corners[i + 2]),
                 ca = side(corners[i + 2], corners[i]);
    if ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0)) return true;
  }
  return false;
}

// At each size: the pose and field submitted are those located, to the bit; the part is of the size asked for, in the
// picture; a pixel of it looks along the ray that it would have in a picture of the eye alone; what is drawn beside it
// is hidden, and it is not. Controls: the field drawn submitted; the part's beginning left 0; show_only() left out; the
// other eye's field in it; no room beside the largest.
TEST_F(HeadsetSymmetricTest, ShowsWhatEachEyeSeesByItself) {
  HeadsetRig rig(canted(), symmetric(), cant);
  std::array<XrView, 2> located{};
  std::array<XrCompositionLayerProjectionView, 2> submitted{};
  rig.headset.report_to([&](const HeadsetCall& call) {
    if (call.kind == HeadsetCall::Kind::locate) std::copy_n(call.views.begin(), 2, located.begin());
  });
  rig.calls.instead.EndFrame = [&](XrSession session, const XrFrameEndInfo* info) {
    const auto& layer = *reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[0]);
    std::copy_n(layer.views, 2, submitted.begin());
    return rig.calls.real.EndFrame(session, info);
  };
  rig.step();  // before any field is known
  EXPECT_EQ(submitted[0].subImage.imageRect.extent.width, width);
  for (const double scale : {1.0, 0.37, 1.5}) {
    rig.headset.set_scale(scale);
    const DisplayFrame shown = rig.step();
    const glm::dvec2 drawn(shown.width, shown.height), asked(std::lround(scale * width), std::lround(scale * height));
    EXPECT_GT(drawn.x, 1.05 * asked.x) << scale;
    EXPECT_LT(drawn.x, 1.35 * asked.x) << scale;
    EXPECT_LE(shown.width, rig.headset.most_size().x);
    EXPECT_EQ(rig.headset.most_size(), glm::uvec2(shown.lent->width, shown.lent->height));
    for (std::size_t eye = 0; eye < 2; ++eye) {
      EXPECT_EQ(std::memcmp(&submitted[eye].pose, &located[eye].pose, sizeof(XrPosef)), 0);
      EXPECT_EQ(std::memcmp(&submitted[eye].fov, &located[eye].fov, sizeof(XrFovf)), 0);
      const XrRect2Di& rect = submitted[eye].subImage.imageRect;
      ASSERT_EQ(glm::dvec2(rect.extent.width, rect.extent.height), asked);
      ASSERT_GE(rect.offset.x, 0);
      ASSERT_LE(rect.offset.x + rect.extent.width, int(shown.width));
      ASSERT_LE(rect.offset.y + rect.extent.height, int(shown.height));
      const Fov own = of(located[eye].fov), whole = rig.viewpoint.eyes[eye].fov;
      const double pixel = (own.right - own.left) / asked.x;
      EXPECT_NEAR(whole.left, -whole.right, 1.01 * pixel) << scale;
      int wrong = 0, beside = 0;
      for (std::uint32_t y = 0; y < shown.height; ++y)
        for (std::uint32_t x = 0; x < shown.width; ++x) {
          const glm::dvec2 at = tangents(whole, {x, y}, drawn),
                           in_part = glm::dvec2(x, y) - glm::dvec2(rect.offset.x, rect.offset.y);
          const bool inside = in_part.x >= 0 && in_part.y >= 0 && in_part.x < asked.x && in_part.y < asked.y;
          if (inside) wrong += glm::length(at - tangents(own, in_part, asked)) > 1e-6;
          wrong += is_hidden(rig.headset.hidden()->corners[eye], at) == inside;
          beside += !inside;
        }
      EXPECT_EQ(wrong, 0) << scale << " " << eye;
      EXPECT_GT(beside, int(asked.y)) << scale;
    }
  }
  const std::uint64_t version = rig.headset.hidden()->version;
  rig.step();
  EXPECT_EQ(rig.headset.hidden()->version, version);  // nothing changes from frame to frame
}

// Control: set_scale()'s pictures made anew.
TEST_F(HeadsetSymmetricTest, AnotherScaleMakesNothing) {
  HeadsetRig rig(canted(), symmetric(), cant);
  rig.steps(2);
  const std::uint64_t made = test::device().objects_made();
  for (const double scale : {0.7, 1.5, 9.0, 0.01, 1.0}) {
    rig.headset.set_scale(scale);
    rig.steps(2);
  }
  EXPECT_EQ(test::device().objects_made(), made);
  EXPECT_EQ(rig.runtime.frames_shown(), 12u);
}

// A field of view that changes between two frames is shown as it is located, whatever was thought of before. Control:
// parts_ of begin().
TEST_F(HeadsetSymmetricTest, FieldsMayChangeInAnyFrame) {
  float farther = 0.0f;
  HeadsetRig rig(canted(), symmetric(), [&](HostileRuntime& calls) {
    calls.instead.LocateViews = [&](XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                                    std::uint32_t room, std::uint32_t* count, XrView* views) {
      const XrResult result = calls.real.LocateViews(session, info, state, room, count, views);
      views[0].fov.angleLeft -= farther;
      return result;
    };
  });
  XrCompositionLayerProjectionView view{};
  rig.calls.instead.EndFrame = [&](XrSession session, const XrFrameEndInfo* info) {
    view = reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[0])->views[0];
    return rig.calls.real.EndFrame(session, info);
  };
  for (const float by : {0.0f, 0.0f, 0.2f, 0.4f, -0.3f, 0.0f}) {
    farther = by;
    const DisplayFrame shown = rig.step();
    const auto& [offset, extent] = view.subImage.imageRect;
    EXPECT_EQ(extent.width, width);
    const glm::dvec2 drawn(shown.width, shown.height), asked(extent.width, extent.height);
    for (const double pixel : {0.0, double(width - 1)})
      EXPECT_NEAR(tangents(rig.viewpoint.eyes[0].fov, {pixel + offset.x, offset.y}, drawn).x,
                  tangents(of(view.fov), {pixel, 0.0}, asked).x, 1e-6)
          << by;
  }
  EXPECT_EQ(rig.runtime.frames_shown(), 6u);
}

// How far pictures are from each other where one is moved by so many pixels: the mean of the inner pixels' channels.
double apart(const Image8& a, const Image8& b, int x, int y) {
  double sum = 0.0;
  for (int row = 1; row + 1 < a.height; ++row)
    for (int column = 1; column + 1 < a.width; ++column)
      for (int c = 0; c < 3; ++c)
        sum += std::abs(int(a.pixels[std::size_t(4 * ((row + y) * a.width + column + x) + c)]) -
                        int(b.pixels[std::size_t(4 * (row * a.width + column) + c)]));
  return sum / (3.0 * (a.width - 2) * (a.height - 2));
}

// The sea, as the runtime shows it to each eye, against pictures of the eyes' own fields drawn without a headset: the
// same rays, so the same light but for what clipping at the picture's edge does to the far water's large triangles. A
// pixel beside it is another sea. Controls: a part that begins a pixel beside; the fields of view exchanged.
TEST_F(HeadsetSymmetricTest, TheSeaIsThatOfTheEyesOwnFields) {
  const test::TemporaryFolder folder;
  for (const auto& set : {std::vector<std::pair<std::string, std::string>>{{"frame.shape", "tile"}, {"msaa", "4"}},
                          {{"frame.shape", "tile"}, {"msaa", "1"}},
                          {{"frame.shape", "desktop"}, {"msaa", "1"}}}) {
    Scene scene = load_scene("calm", "low");
    set_from_text(scene.settings, "waves.cascades", "3", "test");
    for (const auto& [key, value] : set) set_from_text(scene.settings, key, value, "test");
    SimulatedRuntime runtime(canted(folder.path()));
    HostileRuntime calls(runtime);
    cant(calls);
    HeadsetSystem system(calls.get(), runtime.next());
    Headset headset(system, test::device(), symmetric());
    std::array<XrView, 2> located{};
    headset.report_to([&](const HeadsetCall& call) {
      if (call.kind == HeadsetCall::Kind::locate) std::copy_n(call.views.begin(), 2, located.begin());
    });
    ExperienceOptions options{width, height, 2};
    options.colour = headset.colour();
    Experience alone(test::device(), test::shaders(), scene, options);
    options.most_width = headset.most_size().x;
    options.most_height = headset.most_size().y;
    options.hidden = true;
    Experience worn(test::device(), test::shaders(), scene, options);
    for (int number = 0; number < 2; ++number) {
      const DisplayFrame shown = headset.begin();
      worn.resize(shown.width, shown.height);
      worn.draw_into(shown.lent);
      worn.choose(shown.colour, shown.depth);
      worn.frame().begin();
      Viewpoint viewpoint = headset.viewpoint(Pose{{12.0, 0.5, -7.0}});
      worn.hide(*headset.hidden());
      draw_frame(worn, worn.frame(), viewpoint, 3.0);
      headset.end(worn.frame(), &worn.picture(), nullptr);
      worn.frame().finish();
      for (std::size_t eye = 0; eye < 2; ++eye) viewpoint.eyes[eye].fov = of(located[eye].fov);
      viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, height);
      alone.frame().begin();
      draw_frame(alone, alone.frame(), viewpoint, 3.0);
      alone.frame().submit();
      alone.frame().finish();
      for (std::size_t eye = 0; eye < 2; ++eye) {
        const std::string what = set[0].second + set[1].second + " " + std::to_string(number) + std::to_string(eye);
        const Image8 seen =
            read_png(folder / ("frame_000" + std::to_string(number) + (eye == 0 ? "_left" : "_right") + ".png"));
        const Image8 own = picture_of(test::device(), alone, int(eye));
        ASSERT_EQ(seen.pixels.size(), own.pixels.size()) << what;
        std::size_t off = 0;
        double sum = 0.0;
        for (std::size_t i = 0; i < own.pixels.size(); ++i) {
          const int by = std::abs(int(seen.pixels[i]) - int(own.pixels[i]));
          off += by > 3;
          sum += by;
        }
        EXPECT_LT(double(off), 0.02 * double(own.pixels.size())) << what;
        EXPECT_LT(sum, 0.25 * double(own.pixels.size())) << what;
        for (const auto& [x, y] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
          EXPECT_GT(apart(seen, own, x, y), 3.0 * apart(seen, own, 0, 0) + 0.5) << what;
        EXPECT_GT(test::statistics(seen).deviation, 5.0) << what;
      }
    }
  }
}

}  // namespace
}  // namespace seascape
