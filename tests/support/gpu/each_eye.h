// Both eyes in one pass, a pass an eye, and each eye alone: the same to the bit.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "engine/multiview_check.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape::test {

// The shapes of a frame, and forward ones with one sample a pixel.
inline std::vector<FrameLook> stereo_looks() {
  std::vector<FrameLook> looks(std::begin(frame_looks), std::end(frame_looks));
  looks.push_back({"tile_1", {{"frame.shape", "tile"}, {"msaa", "1"}, {"frame.lighting", "forward"}}});
  looks.push_back({"desktop_1", {{"frame.shape", "desktop"}, {"msaa", "1"}, {"frame.lighting", "forward"}}});
  return looks;
}

// Expects them of a head at a time, and that the eyes differ; `make`: a shot of these options. Returns each eye alone.
inline std::vector<Image8> expect_each_eye_alone(
    ShotOptions options, const Pose& head, double time_s, const std::string& name,
    const std::function<SeaShot(const ShotOptions&)>& make = [](const ShotOptions& made) { return SeaShot(made); }) {
  options.views = 2;
  std::vector<Image8> together, alone;
  if (multiview_works(device(), shaders())) together = make(options).pictures(head, time_s);
  options.per_eye = true;
  const std::vector<Image8> by_eye = make(options).pictures(head, time_s);
  options.per_eye = false;
  options.views = 1;
  for (const int eye : {-1, 1}) {
    options.eye = eye;
    alone.push_back(make(options).picture(head, time_s));
  }
  for (std::size_t eye = 0; eye < 2; ++eye) {
    if (!together.empty()) {
      EXPECT_EQ(differing_pixels(together[eye], alone[eye]), 0)
          << name << " " << eye << " " << leave(together[eye], "together_" + name);
    }
    EXPECT_EQ(differing_pixels(by_eye[eye], alone[eye]), 0) << name << " " << eye;
  }
  EXPECT_GT(differing_pixels(alone[0], alone[1]), 500) << name;
  return alone;
}

}  // namespace seascape::test
