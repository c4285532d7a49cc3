// The sea in a headset on the simulated runtime: to the bit what is drawn of the same viewpoints without a headset, in
// the images that the runtime lends, and their depths. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/gpu/headset_pictures.h"
#include "tests/support/gpu/headset_rig.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::drawn_without;
using test::HeadsetLook;
using test::HeadsetPicture;
using test::HeadsetScene;
using test::options_of;
using test::scene_of;
using test::TemporaryFolder;

constexpr int width = 96, height = 80;

const HeadsetLook looks[] = {
    {"tile, 4 samples", {{"frame.shape", "tile"}, {"msaa", "4"}}},
    {"tile, deferred", {{"frame.shape", "tile"}, {"msaa", "1"}}, {{"frame.lighting", "forward"}}},
    {"tile, forward", {{"frame.shape", "tile"}, {"msaa", "1"}, {"frame.lighting", "forward"}}},
    {"desktop, deferred", {{"frame.shape", "desktop"}, {"msaa", "1"}}, {{"frame.lighting", "forward"}}},
    {"desktop, 4 samples", {{"frame.shape", "desktop"}, {"msaa", "4"}}},
    {"tile, 4 samples, underwater", {{"frame.shape", "tile"}, {"msaa", "4"}}, {{"msaa", "4"}}, "low", true},
    {"tile, deferred, underwater",
     {{"frame.shape", "tile"}, {"msaa", "1"}},
     {{"frame.lighting", "forward"}},
     "low",
     true},
    {"tile, forward, underwater",
     {{"frame.shape", "tile"}, {"msaa", "1"}, {"frame.lighting", "forward"}},
     {{"msaa", "1"}},
     "low",
     true},
};

// A rolled head that turns, with eyes far apart that see more to one side than to the other.
SimulatedOptions wide_eyed(const std::filesystem::path& out) {
  SimulatedOptions options;
  InputScript& script = options.script;
  script.width = width;
  script.height = height;
  script.rate_hz = test::rig_hz;
  script.eye_distance_m = 0.9;
  script.eyes = {{{-52, 41, 44, -38}, {-40, 55, 40, -46}}};
  const auto head = [](double yaw, double roll) {
    return Pose{{0.4, 1.9, -0.3},
                glm::angleAxis(yaw, glm::dvec3(0.0, 1.0, 0.0)) * glm::angleAxis(roll, glm::dvec3(0.0, 0.0, 1.0))};
  };
  script.events = {test::tracked(0, Tracker::head, head(0.2, 0.3)), test::tracked(9, Tracker::head, head(0.9, -0.2))};
  options.ends = false;
  options.out = out;
  options.every = 1;
  return options;
}

// Three frames as Explorer draws them, of 0.7 of the size in the second.
std::vector<HeadsetPicture> drawn_in_headset(Device& device, Headset& headset, const Scene& scene) {
  HeadsetScene sea(device, headset, scene);
  std::vector<HeadsetPicture> all;
  for (int number = 0; number < 3; ++number) {
    headset.set_scale(number == 1 ? 0.7 : 1.0);
    const DisplayFrame shown = sea.step(true);
    HeadsetPicture& drawn = all.emplace_back(sea.drawn());
    // What lies in the image that the runtime lent, whatever the experience takes for it.
    ImageSpec theirs{shown.lent->width, shown.lent->height, 2};
    theirs.format = device.facts().depth_format;
    const Image depth(device, "lent", shown.lent->depths[shown.depth], theirs);
    depth.state() = sea.experience().shown_depth()->state();
    for (std::size_t eye = 0; eye < 2; ++eye) drawn.depths[eye] = test::depths_of(device, depth, drawn, eye);
  }
  return all;
}

// Depths that are 0 (the sky) and that are not.
std::array<int, 2> sky_and_sea(const std::vector<std::uint8_t>& depths) {
  std::array<int, 2> count{};
  for (std::size_t i = 0; i + 4 <= depths.size(); i += 4) {
    float depth = 0.0f;
    std::memcpy(&depth, &depths[i], 4);
    ++count[depth > 0.0f];
  }
  return count;
}

// Controls: the eyes' layers exchanged in end_frame() (the files); the area not set (the frame of another size);
// ShownDepth::draw() left out; the first lent depth chosen for all frames; the pass's depth not resolved into what is
// lent.
TEST(HeadsetPicturesTest, AreThoseWithoutAHeadset) {
  const TemporaryFolder folder;
  (void)test::take_validation_messages();
  {
    SimulatedRuntime for_device(wide_eyed(folder.path()));
    HeadsetSystem system_of_device(for_device.get(), for_device.next());
    DeviceOptions device_options;
    device_options.validation = true;
    system_of_device.make_device(device_options);
    Device device(device_options);
    for (const HeadsetLook& look : looks) {
      SimulatedRuntime runtime(wide_eyed(folder.path()));
      HeadsetSystem system(runtime.get(), runtime.next());
      Headset headset(system, device, {});
      ASSERT_TRUE(headset.shows_depth());
      const std::vector<HeadsetPicture> seen = drawn_in_headset(device, headset, scene_of(look, false));
      const std::vector<HeadsetPicture> expected =
          drawn_without(device, scene_of(look, false), options_of(headset), seen);
      const std::vector<HeadsetPicture> deep =
          look.depth_of.empty() ? expected : drawn_without(device, scene_of(look, true), options_of(headset), seen);
      EXPECT_EQ(runtime.frames_shown(), seen.size());
      for (std::size_t number = 0; number < seen.size(); ++number)
        for (std::size_t eye = 0; eye < 2; ++eye) {
          const std::string what =
              std::string(look.name) + " frame " + std::to_string(number) + " eye " + std::to_string(eye);
          const Image8& picture = seen[number].pictures[eye];
          ASSERT_EQ(picture.width, int(std::lround(width * (number == 1 ? 0.7 : 1.0)))) << what;
          EXPECT_EQ(picture.pixels, expected[number].pictures[eye].pixels) << what;
          EXPECT_GT(test::statistics(picture).deviation, 5.0) << what;
          const Image8 file =
              read_png(folder / ("frame_000" + std::to_string(number) + (eye == 0 ? "_left" : "_right") + ".png"));
          EXPECT_EQ(test::differing_pixels(file, picture), 0) << what;
          EXPECT_EQ(file.width, picture.width) << what;
          ASSERT_EQ(seen[number].depths[eye].size(), std::size_t(picture.width) * std::size_t(picture.height) * 4)
              << what;
          EXPECT_TRUE(seen[number].depths[eye] == deep[number].depths[eye]) << what << ": depth";
          for (const int pixels : sky_and_sea(seen[number].depths[eye])) EXPECT_GT(pixels, 300) << what;
        }
      EXPECT_GT(test::differing_pixels(seen[0].pictures[0], seen[0].pictures[1]), 1000) << look.name;
    }
  }
  for (const std::string& message : test::take_validation_messages()) ADD_FAILURE() << message;
}

// How far from the middle of the lens a pixel's middle is, in its radii: the ellipse that the simulated runtime has.
double out_of_lens(const View& eye, std::size_t which, double lens, double x, double y) {
  const Fov& f = eye.fov;
  const glm::dvec2 half(0.5 * (f.right - f.left), 0.5 * (f.up - f.down));
  const double nose = which == 0 ? 0.05 : -0.05;
  return glm::length(glm::dvec2(2.0 * x - 1.0 - nose, 1.0 - 2.0 * y)) / lens;
}

// Behind lenses the same pictures and depths, but for what is hidden: black, and as near as can be. Controls: hide()
// left out of the frame; the light of deferred pixels without its question.
TEST(HeadsetPicturesTest, BehindLensesAreTheSameWhereAnEyeSees) {
  const TemporaryFolder folder;
  (void)test::take_validation_messages();
  {
    SimulatedRuntime for_device(wide_eyed(folder.path()));
    HeadsetSystem system_of_device(for_device.get(), for_device.next());
    DeviceOptions device_options;
    device_options.validation = true;
    system_of_device.make_device(device_options);
    Device device(device_options);
    constexpr double lens = 0.9;
    for (const HeadsetLook& look : looks) {
      const auto seen_through = [&](double through) {
        SimulatedOptions options = wide_eyed(folder.path());
        options.lens = through;
        SimulatedRuntime runtime(options);
        HeadsetSystem system(runtime.get(), runtime.next());
        Headset headset(system, device, {});
        return drawn_in_headset(device, headset, scene_of(look, false));
      };
      const std::vector<HeadsetPicture> whole = seen_through(0.0), seen = seen_through(lens);
      const bool samples = look.set[1].second == "4";
      for (std::size_t number = 0; number < seen.size(); ++number)
        for (std::size_t eye = 0; eye < 2; ++eye) {
          const Image8& picture = seen[number].pictures[eye];
          const View& view = seen[number].viewpoint.eyes[eye];
          int hidden = 0, same = 0, wrong = 0, wrong_depth = 0;
          for (std::size_t i = 0; i < picture.pixels.size() / 4; ++i) {
            const double out =
                out_of_lens(view, eye, lens, (double(i % std::size_t(picture.width)) + 0.5) / picture.width,
                            (double(i / std::size_t(picture.width)) + 0.5) / picture.height);
            if (std::abs(out - 1.0) < (samples ? 0.05 : 0.02)) continue;
            const std::uint8_t night[] = {0, 0, 0, 255};
            const float nearest = 1.0f;
            const bool is_hidden = out > 1.0;
            (is_hidden ? hidden : same)++;
            wrong += std::memcmp(&picture.pixels[4 * i], is_hidden ? night : &whole[number].pictures[eye].pixels[4 * i],
                                 4) != 0;
            wrong_depth +=
                std::memcmp(&seen[number].depths[eye][4 * i],
                            is_hidden ? static_cast<const void*>(&nearest) : &whole[number].depths[eye][4 * i], 4) != 0;
          }
          const std::string what =
              std::string(look.name) + " frame " + std::to_string(number) + " eye " + std::to_string(eye);
          EXPECT_EQ(wrong, 0) << what;
          EXPECT_EQ(wrong_depth, 0) << what;
          EXPECT_GT(hidden, 500) << what;
          EXPECT_GT(same, 1500) << what;
        }
    }
  }
  for (const std::string& message : test::take_validation_messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace seascape
