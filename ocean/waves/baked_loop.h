// A loop of waves as it is recorded: frames of displacement on one periodic tile; and the recording of a sea's.
#pragma once
#include <span>
#include <vector>

#include "ocean/waves/sea_state.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

struct BakedLoop {
  static constexpr int least_samples = 16, most_samples = 512, least_frames = 8, most_frames = 1000;
  int samples = 0, frames = 0;
  double fps = 0.0, side_m = 0.0;
  // [frame][Dx, height, Dz][z][x], metres from rest; texel (x, z) is the water at rest at (x, z) side_m / samples.
  // After the last frame comes the first.
  std::vector<float> texels;
  std::size_t frame_floats() const { return 3 * std::size_t(samples) * std::size_t(samples); }
};

// What a loop is to be recorded like.
struct LoopRequest {
  int frames = 48;
  double fps = 4.0;
  int samples = 128;    // texels a side: 64, 128, 256 or 512
  double side_m = 0.0;  // 0: three peak waves of the sea at 64 texels a side, and with more of them as their root
};

// The waves of a sea's spectrum that one tile carries: from its side down to four texels, in a loop of frames / fps
// seconds. Each wave's frequency w is rounded to a whole multiple of 2 pi over that time (Tessendorf 2001, section 4.2,
// rounds down; the nearest is at most half as far off, and never 0), so that the frame after the last is the first.
// Sources beside the spectrum have tiles of their own and are not in it.
class LoopRecorder {
 public:
  // Throws Error naming the option (--frames, --fps, --size, --tile) or the sea's setting.
  LoopRecorder(const SeaState& sea, const LoopRequest& request);
  const LoopRequest& request() const { return request_; }  // its side as taken
  // One frame: frame_floats() of a BakedLoop of this request.
  void record(int frame, std::span<float> texels);

  // Root mean square, by energy, of what rounding made of the frequencies, over themselves; and the most of any wave
  // that has a thousandth of the energy.
  double frequency_error() const { return frequency_error_; }
  double worst_frequency_error() const { return worst_frequency_error_; }
  // 4 standard deviations of the loop's height, and of all waves of the sea.
  double height_m() const { return height_m_; }
  double sea_height_m() const { return sea_height_m_; }

 private:
  LoopRequest request_;
  WaveField field_;
  WaveTiles tiles_;
  double frequency_error_ = 0.0, worst_frequency_error_ = 0.0, height_m_ = 0.0, sea_height_m_ = 0.0;
};

}  // namespace seascape
