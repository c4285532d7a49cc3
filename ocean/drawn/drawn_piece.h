// The interface of what takes one part of the sea to the GPU: waves, places, foam. The ocean and its surface know
// nothing else of it.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/frame.h"
#include "ocean/sea/sea.h"
#include "shaders/shared/frame_data.h"

namespace seascape {

// Specialisation constants and bindings of the surface's shaders, collected from all pieces. Their numbers have names
// in shaders/shared/slots.h.
class SurfaceSlots {
 public:
  // A specialisation constant; 0 where no piece sets it.
  void set(int constant, std::uint32_t value) { values_.push_back({std::uint32_t(constant), value}); }
  // A constant that switches an effect (a literal): at 0 the shaders contain none of its code.
  void set(const char* effect, int constant, std::uint32_t value) {
    set(constant, value);
    effects_.push_back({effect, std::uint32_t(constant)});
  }
  std::uint32_t value(int constant) const {
    const auto found = std::find_if(values_.begin(), values_.end(),
                                    [&](const SpecValue& v) { return v.id == std::uint32_t(constant); });
    return found == values_.end() ? 0 : found->value;
  }
  void bind(int slot, const Image& image, VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
    bound_.push_back({.binding = std::uint32_t(slot), .view = image.view(), .layout = layout});
  }
  void bind(int slot, const Buffer& buffer) { bound_.push_back({.binding = std::uint32_t(slot), .buffer = &buffer}); }
  void bind(int slot, VkSampler sampler) { bound_.push_back({.binding = std::uint32_t(slot), .sampler = sampler}); }

  const std::vector<SpecValue>& values() const { return values_; }
  struct EffectValue {
    const char* effect;
    std::uint32_t constant;
  };
  const std::vector<EffectValue>& effects() const { return effects_; }
  const std::vector<Bound>& bound() const { return bound_; }

 private:
  std::vector<SpecValue> values_;
  std::vector<EffectValue> effects_;
  std::vector<Bound> bound_;
};

// What a frame draws.
struct DrawnMoment {
  Sea& sea;              // as of time_s
  const SeaView& water;  // of a detail that has the sources' tiles
  double time_s;         // of the sea
  glm::dvec3 viewer_m;   // in the world
};

// Upper bounds on how far water is displaced, m.
struct WaterReach {
  double height_m = 0.0, shift_m = 0.0;
};

class DrawnPiece {
 public:
  DrawnPiece() = default;
  DrawnPiece(const DrawnPiece&) = delete;
  DrawnPiece& operator=(const DrawnPiece&) = delete;
  virtual ~DrawnPiece() = default;

  // Name of the CPU stage that its updates are timed under: a literal.
  virtual const char* stage() const = 0;
  // Takes what Sea::apply has changed, from the next update on.
  virtual void take(const Sea&) {}
  // Brings its images and buffers to this moment. Records nothing if they already hold it.
  virtual void update(Frame& frame, const DrawnMoment& moment) = 0;
  // Adds its values and bindings; these never change while it lives, but for the copy that is bound.
  virtual void declare(SurfaceSlots& slots, std::size_t copy) const = 0;
  // What shaders are told, as of the last update; `grid_origin_m` is the world x, z that rest positions count from.
  virtual void describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const = 0;
  // Adds all that the surface reads.
  virtual void add_uses(Uses& uses) const = 0;

  // How many copies of its images there are, for frames in flight, and which the surface is to read from now.
  virtual std::size_t copies() const { return 1; }
  virtual std::size_t shown() const { return 0; }
  // How far it displaces water, as of the last update. What a bed may amplify is not in it (Ocean adds the sources).
  virtual WaterReach reach() const { return {}; }
};

}  // namespace seascape
