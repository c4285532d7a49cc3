// All inputs of one kind of local data, joined in their order: what they make of a value at any place and time.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ocean/inputs/input_source.h"

namespace seascape {

// Immutable once made; any number of threads may ask. What it holds of pictures and models is its own.
class Inputs {
 public:
  // Takes those of `specs` that are for `to`, sorted by their order, but volumes (ClipVolumes); the rest may be for
  // others. Throws Error as validate() does.
  Inputs(InputTarget to, std::span<const InputSpec> specs) : Inputs(to, specs, [](const InputSpec&) { return true; }) {}
  // The same of those that `taken` says yes to.
  Inputs(InputTarget to, std::span<const InputSpec> specs, bool (*taken)(const InputSpec&));

  // `base` is what there is without inputs: the same comes back, to the bit, where none is; else every channel of the
  // target's within its range (InputTargetTraits), the others as they were. `footprint_m` is the side of what is asked
  // for as one: no edge is sharper, and pictures are averaged over it. An input that follows the waves is asked at the
  // water's rest place, others at `place_m` itself, x and z, m. At a place or a time that is no number the base comes
  // back.
  glm::vec4 value(glm::dvec2 place_m, double footprint_m, double time_s, glm::vec4 base, glm::dvec2 rest_m) const;
  glm::vec4 value(glm::dvec2 place_m, double footprint_m, double time_s, glm::vec4 base) const {
    return value(place_m, footprint_m, time_s, base, place_m);
  }

  InputTarget target() const { return to_; }
  bool empty() const { return layers_.empty(); }  // of inputs that give something
  std::size_t size() const { return layers_.size(); }
  bool still() const;         // the same at any time
  bool follow_waves() const;  // one of them does
  bool only_add() const;      // all of them have the blend `add`
  // Where they are, at any time, seen with a footprint of 0; a footprint f adds f / 2 on each side at most.
  InputBounds bounds() const { return tree_.bounds(); }
  // What gives nothing, or was left out, and why: a line each.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  struct Layer {
    std::unique_ptr<const InputSource> source;
    float weight = 1.0f;
    InputBlend blend = InputBlend::add;
    bool follow_waves = false;
    InputBounds bounds;
  };
  glm::vec4 joined(const Layer& layer, const InputSample& sample, glm::vec4 base) const;

  InputTarget to_;
  std::vector<Layer> layers_;  // in their order
  BoundsTree tree_;
  std::vector<std::string> remarks_;
};

// The same remarks for inputs of every kind, which have to be valid, without keeping any; and of each kind of data that
// nobody asks for.
std::vector<std::string> remarks_of(std::span<const InputSpec> specs);

}  // namespace seascape
