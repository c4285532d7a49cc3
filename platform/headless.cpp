#include "platform/headless.h"

namespace seascape {

Headless::Headless(const HeadlessOptions& options) : options_(options), start_(std::chrono::steady_clock::now()) {}

DisplayFrame Headless::begin() {
  DisplayFrame frame;
  frame.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  frame.width = scaled_pixels(options_.width, scale_);
  frame.height = scaled_pixels(options_.height, scale_);
  return frame;
}

Viewpoint Headless::viewpoint(const Pose& carrier) const {
  const Fov fov = symmetric_fov(options_.vertical_fov_deg, double(options_.width) / options_.height);
  const std::vector<View> eyes = stereo_views(carrier, fov, options_.eye_distance_m);
  const double pixels = pixels_per_radian(eyes, int(scaled_pixels(options_.height, scale_)));
  if (options_.views == 2) return {carrier, eyes, pixels};
  if (options_.eye == 0) return {carrier, {{carrier, fov}}, pixels};
  return {carrier, {options_.eye < 0 ? eyes[0] : eyes[1]}, pixels};
}

void Headless::end(Frame& frame, const RenderTarget* picture, const Image*) {
  if (picture) frame.submit();
}

}  // namespace seascape
