// Data that belong to places, kept in windows around the viewer: what the scene's inputs make of each kind, as the
// shaders read it.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "ocean/inputs/clip_volumes.h"
#include "ocean/inputs/inputs.h"
#include "ocean/places/lod_field.h"
#include "ocean/places/place_settings.h"

namespace seascape {

// Calls `row` with 0 to rows - 1, on all threads.
void for_each_row(int rows, const std::function<void(int)>& row);

class ShoreLines;  // ocean/places/shore_lines.h

// What of a scene belongs to places: the inputs of each kind that an effect calls for.
struct PlaceInputs {
  PlaceSettings settings;
  std::vector<std::shared_ptr<const Inputs>> kinds;  // each kind once at most
  std::vector<std::shared_ptr<const Inputs>>
      following;  // of what lies on the water (albedo, shadow), those that go with the waves; each kind once at most
  std::shared_ptr<const ClipVolumes> volumes;  // of clip beside its flat inputs; null where there are none, and
                                               // no room for bodies

  std::shared_ptr<const ShoreLines> shore = nullptr;  // along which waves run; null where none do

  bool empty() const { return kinds.empty() && following.empty() && volumes == nullptr && shore == nullptr; }

  // Null where there are none.
  std::shared_ptr<const Inputs> of(InputTarget kind) const { return of(kinds, kind); }
  static std::shared_ptr<const Inputs> of(const std::vector<std::shared_ptr<const Inputs>>& kinds, InputTarget kind) {
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [&](const auto& inputs) { return inputs->target() == kind; });
    return found == kinds.end() ? nullptr : *found;
  }
};

// What there is beyond all windows, and where no input is.
glm::vec4 place_outside(const PlaceSettings& settings, InputTarget kind);

// The time as of which what belongs to places is taken: in steps of 1 / rate where it changes with time (is not
// `still`).
double place_time_s(const PlaceSettings& settings, bool still, double time_s);

// What a field holds.
template <class T>
struct PlaceValues {
  T outside;  // beyond all windows
  std::function<T(glm::dvec2 middle_m, double texel_m, double time_s)>
      value;           // of a texel; asked by several threads at once
  bool still = true;   // the same at any time,
  InputBounds moving;  // or else outside of these bounds
};

// The first channel of a texel, of which a field knows the least and the most.
inline float first_channel(const glm::vec4& texel) { return texel.x; }

// One kind. Texels hold the value at their middle, for a footprint of their side.
template <class T>
class PlaceField {
 public:
  PlaceField(PlaceValues<T> values, const PlaceSettings& settings, const LodPlacement& placement, double time_s)
      : values_(std::move(values)),
        settings_(settings),
        time_s_(place_time_s(settings, values_.still, time_s)),
        least_(double(first_channel(values_.outside))),
        most_(least_),
        field_(settings.windows, values_.outside, placement) {
    for (int i = 0; i < settings.windows.slices; ++i) fill(i, [](glm::dvec2) { return true; });
    find_range((1u << settings.windows.slices) - 1u);
  }

  // Takes other values: what comes into a window has them at once, and each follow() fills one slice anew, the finest
  // first.
  void take(PlaceValues<T> values, const PlaceSettings& settings) {
    values_ = std::move(values);
    settings_ = settings;
    field_.set_outside(values_.outside);
    widen(double(first_channel(values_.outside)));
    stale_ = (1u << settings_.windows.slices) - 1u;
  }

  // Moves the windows to the placement, and takes what changes with time as it is at `time_s` (place_time_s). Gives the
  // slices that have changed: bit i for slice i, all of them after a change of the octave.
  std::uint32_t follow(const LodPlacement& placement, double time_s) {
    const int slices = field_.slices();
    const std::uint32_t all = (1u << slices) - 1u;
    const LodPlacement before = field_.placement();
    const double now = place_time_s(settings_, values_.still, time_s);
    const bool later = now != time_s_;
    time_s_ = now;
    field_.follow(placement, [&](glm::dvec2 middle, double texel, const T&) {
      const T value = values_.value(middle, texel, time_s_);
      widen(double(first_channel(value)));
      return value;
    });
    std::uint32_t changed = placement.scale.octave != before.scale.octave ? all : 0u;
    if (changed != 0 && stale_ != 0) stale_ = all;  // slices have changed places
    for (int i = 0; i < slices; ++i)
      if (placement.first[std::size_t(i)] != before.first[std::size_t(i)]) changed |= 1u << i;
    for (int i = 0; later && i < slices; ++i) {
      const double texel = field_.texel_m(i);
      if (fill(i, [&](glm::dvec2 middle) { return values_.moving.holds(middle, texel); })) changed |= 1u << i;
    }
    if (stale_ != 0) {
      const int i = std::countr_zero(stale_);
      fill(i, [](glm::dvec2) { return true; });
      changed |= 1u << i;
      stale_ &= ~(1u << i);
      if (stale_ == 0) measure();
    }
    find_range(changed);
    return changed;
  }

  const LodField<T>& field() const { return field_; }
  const PlaceSettings& settings() const { return settings_; }
  // Of all that has been in it since its values were taken, the outside included; of the first channel.
  double least() const { return least_; }
  double most() const { return most_; }
  // That a slice has now.
  double least(int slice) const { return slice_least_[std::size_t(slice)]; }
  double most(int slice) const { return slice_most_[std::size_t(slice)]; }

 private:
  void widen(double value) {
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
  }
  // Nothing is left of values before.
  void measure() {
    least_ = most_ = double(first_channel(values_.outside));
    const std::size_t texels = std::size_t(settings_.windows.resolution) * std::size_t(settings_.windows.resolution);
    for (int i = 0; i < settings_.windows.slices; ++i)
      for (std::size_t n = 0; n < texels; ++n) widen(double(first_channel(field_.texels(i)[n])));
  }
  void find_range(std::uint32_t slices) {
    const std::size_t texels = std::size_t(settings_.windows.resolution) * std::size_t(settings_.windows.resolution);
    for (int i = 0; i < settings_.windows.slices; ++i) {
      if ((slices >> i & 1u) == 0) continue;
      float least = first_channel(field_.texels(i)[0]), most = least;
      for (std::size_t n = 1; n < texels; ++n) {
        least = std::min(least, first_channel(field_.texels(i)[n]));
        most = std::max(most, first_channel(field_.texels(i)[n]));
      }
      slice_least_[std::size_t(i)] = double(least);
      slice_most_[std::size_t(i)] = double(most);
    }
  }
  // Takes the texels of a slice anew whose middles `wanted` says yes to, on all cores; gives whether there were any.
  template <class Wanted>
  bool fill(int slice, const Wanted& wanted) {
    const LodIndex first = field_.first(slice);
    const int side = settings_.windows.resolution;
    bool any = false;
    std::mutex together;
    for_each_row(side, [&](int z) {
      bool some = false;
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (int x = 0; x < side; ++x) {
        const LodIndex w = first + LodIndex(x, z);
        const glm::dvec2 middle = field_.middle(slice, w);
        if (!wanted(middle)) continue;
        const T value = values_.value(middle, field_.texel_m(slice), time_s_);
        field_.texel(slice, w) = value;
        least = std::min(least, double(first_channel(value)));
        most = std::max(most, double(first_channel(value)));
        some = true;
      }
      if (!some) return;
      const std::scoped_lock lock(together);
      widen(least);
      widen(most);
      any = true;
    });
    return any;
  }

  PlaceValues<T> values_;
  PlaceSettings settings_;
  double time_s_;  // of what is in the field
  double least_, most_;
  LodField<T> field_;
  std::array<double, gpu::max_lod_slices> slice_least_{}, slice_most_{};
  std::uint32_t stale_ = 0;  // bit i: slice i has other values than values_
};

// Of one kind's inputs alone.
PlaceValues<glm::vec4> place_values(std::shared_ptr<const Inputs> inputs, const PlaceSettings& settings);

}  // namespace seascape
