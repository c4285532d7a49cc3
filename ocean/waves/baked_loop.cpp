#include "ocean/waves/baked_loop.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "engine/error.h"
#include "engine/text.h"
#include "ocean/waves/dispersion.h"
#include "ocean/waves/spectrum.h"

namespace seascape {

namespace {
constexpr double turn = 2.0 * std::numbers::pi;

void require(bool good, const std::string& option, const std::string& value, const std::string& range) {
  if (!good) throw Error(option, value + " is not " + range, "give " + range, 2);
}

LoopRequest checked(const SeaState& sea, LoopRequest r) {
  require(r.frames >= BakedLoop::least_frames && r.frames <= BakedLoop::most_frames, "--frames", text_from(r.frames),
          "a whole number from 8 to 1000");
  require(r.fps >= 0.1 && r.fps <= 240.0, "--fps", text_from(r.fps), "a number from 0.1 to 240");
  require(r.samples == 64 || r.samples == 128 || r.samples == 256 || r.samples == 512, "--size", text_from(r.samples),
          "64, 128, 256 or 512");
  require(r.side_m == 0.0 || (r.side_m >= 1.0 && r.side_m <= 20000.0), "--tile", text_from(r.side_m),
          "0 or a number from 1 to 20000 m");
  const double peak_m = longest_peak_wave_m(sea);
  if (peak_m <= 0.0 || !(sea.depth_m > 0.0))
    throw Error("bake", "the scene's sea has neither wind waves nor swell",
                "give it wind (--set waves.wind_speed_mps=8) or another scene");
  if (r.side_m == 0.0) r.side_m = std::clamp(3.0 * peak_m * std::sqrt(r.samples / 64.0), 1.0, 20000.0);
  return r;
}

WaveQuality quality_of(const LoopRequest& r) { return {.resolution = r.samples / 4, .cascades = 1}; }

SeaState looping(SeaState sea, const LoopRequest& r) {
  sea.loop_s = r.frames / r.fps;
  return sea;
}

// The spectrum on one tile, down to waves of four texels.
WaveBins bins_of_loop(const SeaState& sea, const LoopRequest& r) {
  const double step = turn / r.side_m, last = 0.25 * r.samples * step;
  Ladder one{};
  one.fill({r.side_m, 0.0, {0.0, 0.0}, {0.85 * last, last}});
  WaveBins bins = make_wave_bins(looping(sea, r), quality_of(r), one);
  // A tile carries its waves higher by what sampling between texels takes; a record has them as they are.
  const int half = bins_of(0) / 2;
  for (int mz = -half; mz < half; ++mz)
    for (int mx = -half; mx < half; ++mx) bins.at(0, mx, mz).amplitude *= float(sampled_share(mx, mz, r.samples));
  return bins;
}
}  // namespace

LoopRecorder::LoopRecorder(const SeaState& sea, const LoopRequest& request)
    : request_(checked(sea, request)),
      field_(looping(sea, request_), quality_of(request_), bins_of_loop(sea, request_)) {
  const int half = bins_of(0) / 2;
  const double step = turn / request_.side_m;
  double energy = 0.0, square = 0.0;
  const auto visit = [&](auto take) {
    for (int mz = -half; mz < half; ++mz)
      for (int mx = -half; mx < half; ++mx) {
        const gpu::WaveBin& bin = field_.bins().at(0, mx, mz);
        const double a = glm::length(glm::dvec2(bin.amplitude)) / sampled_share(mx, mz, request_.samples);
        if (a == 0.0) continue;
        const double w = wave_frequency(step * std::hypot(double(mx), double(mz)), sea.gravity_mps2, sea.depth_m);
        const double drawn =
            turn * gpu::ticks_per_second * 0x1p-64 * double(std::uint64_t(bin.turns_high) << 32 | bin.turns_low);
        take(0.5 * a * a, std::abs(drawn - w) / w);
      }
  };
  visit([&](double e, double off) { energy += e, square += e * off * off; });
  visit([&](double e, double off) {
    if (e > 1e-3 * energy) worst_frequency_error_ = std::max(worst_frequency_error_, off);
  });
  frequency_error_ = energy > 0.0 ? std::sqrt(square / energy) : 0.0;
  height_m_ = 4.0 * std::sqrt(energy);
  sea_height_m_ =
      4.0 * std::sqrt(sea_statistics(sea, make_wave_bins(sea, {.resolution = 128, .cascades = 5})).height_variance);
}

void LoopRecorder::record(int frame, std::span<float> texels) {
  const int n = request_.samples;
  assert(texels.size() == 3 * std::size_t(n) * std::size_t(n));
  field_.evaluate(ticks_from_seconds(frame / request_.fps), tiles_);
  const glm::vec4* from = tiles_.texels(0, WavePlane::shift, 0);
  for (int z = 0; z < n; ++z)
    for (int x = 0; x < n; ++x)
      for (int c = 0; c < 3; ++c) texels[std::size_t((c * n + z) * n + x)] = from[z * tiles_.stride(0, 0) + x][c];
}

}  // namespace seascape
