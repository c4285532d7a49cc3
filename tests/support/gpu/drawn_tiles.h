// The sea's tiles in the images that the surface samples, filled in either way, and read back.
#pragma once
#include <glm/gtc/packing.hpp>

#include <cstring>
#include <memory>
#include <vector>

#include "ocean/drawn/wave_compute.h"
#include "ocean/drawn/wave_upload.h"
#include "ocean/waves/wave_place.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape::test {

inline SeaState windy() {
  SeaState sea;
  sea.wind_speed_mps = 12.0;
  sea.fetch_m = 150e3;
  sea.swell_height_m = 1.2;
  sea.chop = 1.1;
  return sea;
}

// The tiles for one sea and quality, at any time.
class DrawnTiles {
 public:
  // `from_cpu`: how the processor's tiles come into the images.
  DrawnTiles(WavePlace place, const SeaState& sea, const WaveQuality& quality,
             WaveImages::Filled from_cpu = WaveImages::Filled::written)
      : bins_(make_wave_bins(sea, quality)),
        statistics_(sea_statistics(sea, bins_)),
        frame_(device(), 4096),
        images_(device(), sea, quality, bins_, statistics_, 1.0,
                place == WavePlace::gpu ? WaveImages::Filled::stored : from_cpu) {
    if (place == WavePlace::gpu)
      compute_ = std::make_unique<WaveCompute>(device(), shaders(), sea, bins_, images_);
    else {
      SeaSpec spec;
      spec.state = sea;
      spec.drawn = spec.crests = spec.felt = quality;
      sea_ = std::make_unique<Sea>(std::move(spec));
      upload_ = std::make_unique<WaveUpload>(device(), *sea_, images_);
    }
  }
  // In a frame that has begun.
  void update(std::int64_t ticks) {
    if (compute_)
      compute_->update(frame_, ticks);
    else
      upload_->update(frame_, ticks);
  }
  // A frame of its own, finished.
  void compute(std::int64_t ticks) {
    frame_.begin();
    update(ticks);
    frame_.submit();
    frame_.finish();
  }
  // The set of images that holds a cascade.
  const WaveImages::Set& set(int cascade) const { return images_.sets()[cascade == 0 ? 0 : 1]; }
  const Image& image(int cascade, WavePlane plane) const { return set(cascade).image(plane); }
  std::vector<glm::vec4> texels(int cascade, WavePlane plane, int level) const {
    const Image& image = this->image(cascade, plane);
    const auto bytes = read_image(device(), image, std::uint32_t(cascade - set(cascade).first), std::uint32_t(level));
    const bool half = image.spec().format == VK_FORMAT_R16G16B16A16_SFLOAT;
    std::vector<glm::vec4> list(bytes.size() / (half ? 8 : 16));
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (half) {
        std::uint64_t packed;
        std::memcpy(&packed, &bytes[8 * i], 8);
        list[i] = glm::unpackHalf4x16(packed);
      } else {
        std::memcpy(&list[i], &bytes[16 * i], 16);
      }
    }
    return list;
  }
  Frame& frame() { return frame_; }
  const WaveImages& images() const { return images_; }
  const SeaStatistics& statistics() const { return statistics_; }
  const WaveBins& bins() const { return bins_; }

 private:
  WaveBins bins_;
  SeaStatistics statistics_;
  Frame frame_;
  WaveImages images_;
  std::unique_ptr<WaveCompute> compute_;
  std::unique_ptr<Sea> sea_;
  std::unique_ptr<WaveUpload> upload_;
};

// For tests that run in both ways.
inline std::string place_name(const ::testing::TestParamInfo<WavePlace>& info) {
  return info.param == WavePlace::gpu ? "gpu" : "cpu";
}
inline const char* place_value(WavePlace place) { return place == WavePlace::gpu ? "gpu" : "cpu"; }

}  // namespace seascape::test
