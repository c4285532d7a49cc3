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
#include "ocean/places/lod_change.h"
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
        field_(settings.windows, values_.outside, placement),
        ranges_(settings.windows.slices, settings.windows.resolution) {
    for (int i = 0; i < settings.windows.slices; ++i) {
      fill(i, [](glm::dvec2) { return true; });
      find_range(i, whole_change(settings.windows.resolution));
    }
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

  // Moves the windows to the placement, and takes what changes with time as it is at `time_s` (place_time_s). Gives
  // what has changed of each slice: what has come in, or all of it.
  LodChanges follow(const LodPlacement& placement, double time_s) {
    const int slices = field_.slices(), side = settings_.windows.resolution;
    const LodPlacement before = field_.placement();
    const double now = place_time_s(settings_, values_.still, time_s);
    const bool later = now != time_s_;
    time_s_ = now;
    field_.follow(placement, [&](glm::dvec2 middle, double texel, const T&) {
      const T value = values_.value(middle, texel, time_s_);
      widen(double(first_channel(value)));
      return value;
    });
    LodChanges changes{};
    const bool other_octave = placement.scale.octave != before.scale.octave;
    if (other_octave && stale_ != 0) stale_ = (1u << slices) - 1u;  // slices have changed places
    for (int i = 0; i < slices; ++i) {
      LodChange& change = changes[std::size_t(i)];
      change = other_octave ? whole_change(side)
                            : lod_entered(before.first[std::size_t(i)], placement.first[std::size_t(i)], side);
      const double texel = field_.texel_m(i);
      if (later && fill(i, [&](glm::dvec2 middle) { return values_.moving.holds(middle, texel); }))
        change = whole_change(side);
    }
    const bool renewing = stale_ != 0;
    if (renewing) {
      const int i = std::countr_zero(stale_);
      fill(i, [](glm::dvec2) { return true; });
      changes[std::size_t(i)] = whole_change(side);
      stale_ &= ~(1u << i);
    }
    for (int i = 0; i < slices; ++i)
      if (changes[std::size_t(i)].any()) find_range(i, changes[std::size_t(i)]);
    if (renewing && stale_ == 0) forget_range();
    return changes;
  }

  const LodField<T>& field() const { return field_; }
  const PlaceSettings& settings() const { return settings_; }
  // Of all that has been in it since its values were taken, the outside included; of the first channel.
  double least() const { return least_; }
  double most() const { return most_; }
  // That a slice has now.
  double least(int slice) const { return double(ranges_.least(slice)); }
  double most(int slice) const { return double(ranges_.most(slice)); }

 private:
  void widen(double value) {
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
  }
  // Nothing is left of values before.
  void forget_range() {
    least_ = most_ = double(first_channel(values_.outside));
    for (int i = 0; i < settings_.windows.slices; ++i) widen(least(i)), widen(most(i));
  }
  void find_range(int slice, const LodChange& change) {
    const T* texels = field_.texels(slice);
    const std::size_t side = std::size_t(settings_.windows.resolution);
    ranges_.take(slice, change,
                 [&](int x, int z) { return first_channel(texels[std::size_t(z) * side + std::size_t(x)]); });
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
  LodRanges ranges_;
  std::uint32_t stale_ = 0;  // bit i: slice i has other values than values_
};

// Of one kind's inputs alone.
PlaceValues<glm::vec4> place_values(std::shared_ptr<const Inputs> inputs, const PlaceSettings& settings);

}  // namespace seascape
