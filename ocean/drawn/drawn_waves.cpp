#include "ocean/drawn/drawn_waves.h"

namespace seascape {

namespace {
bool on_gpu(const Device& device, WavePlace place) {
  return place == WavePlace::gpu || (place == WavePlace::automatic && !device.facts().software);
}
}  // namespace

DrawnWaves::DrawnWaves(Device& device, ShaderLibrary& shaders, Sea& sea, WavePlace where, double anisotropy,
                       int in_flight)
    : sea_(sea),
      images_(device, sea.state(), sea.spec().drawn, sea.bins(), sea.statistics(), anisotropy,
              on_gpu(device, where) ? WaveImages::Filled::stored : WaveImages::Filled::written, in_flight),
      version_(sea.bins_version()) {
  if (!sea.spec().has_waves) return;
  if (on_gpu(device, where))
    compute_ = std::make_unique<WaveCompute>(device, shaders, sea.state(), sea.bins(), images_);
  else
    upload_ = std::make_unique<WaveUpload>(device, sea, images_);
}

void DrawnWaves::make(Frame& frame, double time_s) {
  follow(frame);
  const std::int64_t ticks = ticks_from_seconds(time_s);
  if (compute_) compute_->update(frame, ticks);
  if (upload_) upload_->update(frame, ticks);
}

// Takes what a change has made of the waves.
void DrawnWaves::follow(Frame& frame) {
  if (sea_.bins_version() == version_) return;
  version_ = sea_.bins_version();
  images_.take(sea_.bins(), sea_.chop(), sea_.statistics());
  if (compute_) compute_->take(frame, sea_.bins(), sea_.chop());
}

void DrawnWaves::declare(SurfaceSlots& slots, std::size_t copy) const {
  slots.set("waves", gpu::value_cascades, std::uint32_t(images_.cascades()));
  slots.set(gpu::value_warp, images_.warped() ? 1 : 0);
  slots.bind(gpu::slot_smooth_sampler, images_.smooth_sampler());
  slots.bind(gpu::slot_pixel_sampler, images_.pixel_sampler());
  for (const WaveImages::Set& set : images_.copies()[copy]) {
    const int first = set.first == 0 ? gpu::slot_longest_tile : gpu::slot_tiles;
    slots.bind(first, set.displacement, images_.read_layout());
    slots.bind(first + 1, set.derivatives, images_.read_layout());
    slots.bind(first + 2, set.moments, images_.read_layout());
  }
}

void DrawnWaves::describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const {
  images_.describe(data.sea, grid_origin_m);
}

}  // namespace seascape
