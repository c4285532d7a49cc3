// What belongs to places, read as a picture reads it: between the same texels, without any window.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "ocean/places/place_fields.h"

namespace seascape {

// Which texels are read at a place: those of `read`, of which slice 0's are `texel_m` wide.
struct PlaceReading {
  gpu::LodRead read;
  double texel_m = 0.0;

  double fine_texel_m() const { return std::ldexp(texel_m, read.fine); }
};

// What whether there is no water is read from.
struct ClipRead {
  double texel_m = 0.0;                  // of flat inputs the texels of this side; 0: the finest of windows
  const ClipVolumes* volumes = nullptr;  // in place of the scene's, with the bodies of actors; null: the scene's
  const LodPlacement* seen = nullptr;    // flat inputs as a picture with these windows has them; null: by texel_m
};

// For a footprint, m: as a picture reads a place (x and z, m) whose windows lie as `seen` says; without one the finest
// texels that the footprint leaves, wherever the place is.
inline PlaceReading place_reading(const LodWindowSettings& settings, glm::dvec2 place_m, double footprint_m,
                                  const LodPlacement* seen) {
  const LodPlacement nowhere;
  const LodPlacement& placement = seen != nullptr ? *seen : nowhere;
  const float distance = seen != nullptr ? gpu::lod_distance(glm::vec2(place_m - placement.viewer)) : 0.0f;
  return {gpu::lod_read(lod_reach(settings, placement), settings.slices, distance, float(footprint_m)),
          lod_texel_m(settings, placement, 0)};
}

// One kind, as of one time of the sea (s); `values` has to outlive it. Keeps the texels that it has asked for last, so
// that places side by side cost little: one thread's.
template <class T>
class PlaceReader {
 public:
  PlaceReader(const PlaceValues<T>& values, const PlaceSettings& settings, double time_s)
      : values_(&values), time_s_(place_time_s(settings, values.still, time_s)) {}

  // Out of reach of any window (LodPlacement), or where a place is no number, it is what is outside of all.
  T operator()(const PlaceReading& reading, glm::dvec2 place_m) {
    if (!(reading.read.present > 0.0f) || !(std::abs(place_m.x) + std::abs(place_m.y) < 0x1p49 * reading.texel_m))
      return values_->outside;
    T value = between(reading, reading.read.fine, place_m);
    if (reading.read.coarser > 0.0f)
      value = value + (between(reading, reading.read.fine + 1, place_m) - value) * reading.read.coarser;
    return values_->outside + (value - values_->outside) * reading.read.present;
  }

 private:
  struct Kept {
    LodIndex index{0};
    double texel_m = 0.0;  // 0: nothing yet
    T value{};
  };
  T between(const PlaceReading& reading, int slice, glm::dvec2 place_m) {
    const double texel = std::ldexp(reading.texel_m, slice);
    const glm::dvec2 at = place_m / texel - 0.5, cell = glm::floor(at);
    const LodIndex w(cell);
    return lod_bilinear(glm::vec2(at - cell), [&](LodIndex from_first) { return texel_at(w + from_first, texel); });
  }
  const T& texel_at(LodIndex w, double texel_m) {
    Kept& kept = kept_[(std::uint64_t(w.x) + 13u * std::uint64_t(w.y) + 41u * std::uint64_t(std::ilogb(texel_m) + 64)) %
                       kept_.size()];
    if (kept.texel_m != texel_m || kept.index != w)
      kept = {w, texel_m, values_->value((glm::dvec2(w) + 0.5) * texel_m, texel_m, time_s_)};
    return kept.value;
  }

  const PlaceValues<T>* values_;
  double time_s_;
  std::array<Kept, 128> kept_;
};

}  // namespace seascape
