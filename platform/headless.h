// A display without a screen: pictures stay in memory for replay, capture and tests.
#pragma once
#include <chrono>

#include "platform/display.h"

namespace seascape {

struct HeadlessOptions {
  std::uint32_t width = 1280, height = 720;  // pixels an eye
  int views = 2;
  double vertical_fov_deg = 60.0;
  double eye_distance_m = 0.064;
  // Of one view: which eye of the two it is, -1 left, 0 the centre, 1 right.
  int eye = 0;
};

class Headless final : public Display {
 public:
  explicit Headless(const HeadlessOptions& options);
  const char* name() const override { return "headless"; }
  int views() const override { return options_.views; }
  DisplayFrame begin() override;
  Viewpoint viewpoint(const Pose& carrier) const override;
  void end(Frame& frame, const RenderTarget* picture, const Image* depth = nullptr) override;
  void set_scale(double scale) override { scale_ = scale; }
  double scale() const override { return scale_; }
  glm::uvec2 most_size() const override { return {options_.width, options_.height}; }

 private:
  HeadlessOptions options_;
  double scale_ = 1.0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace seascape
