// One input as the sea asks it: what it gives at a place, and how much of it there is. Each kind is one room of this
// folder.
#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "ocean/inputs/bounds_tree.h"
#include "ocean/inputs/input_spec.h"

namespace seascape {

struct InputSample {
  glm::vec4 value{0.0f};
  float share = 0.0f;  // 0 to 1: how much of it there is, for its shape and its soft edge
};

// Immutable once made: any number of threads may ask one.
class InputSource {
 public:
  virtual ~InputSource() = default;
  // At a place (x and z, m), seen with a footprint (m, 0 or more), at a time (s). All are finite; so is what comes
  // back.
  virtual InputSample sample(glm::dvec2 place_m, double footprint_m, double time_s) const = 0;
  // Outside of this, made larger by soft_reach(), the share is 0 at any time.
  virtual InputBounds bounds() const = 0;
  // The same at any time.
  virtual bool still() const { return true; }
};

// Of a spec that validate() lets pass. nullptr where there is nothing of it, as of a spline of one point; `remarks`
// then says why, and also what of it was left out.
std::unique_ptr<const InputSource> make_input(const InputSpec& spec, std::vector<std::string>& remarks);

// The points of a spline, without those that lie where the one before does; none where they are too few for a curve.
// `remarks` says what was left out.
std::vector<SplinePoint> points_apart(const InputSpec& spec, std::vector<std::string>& remarks);
std::unique_ptr<const InputSource> make_spline(const InputSpec& spec, std::vector<std::string>& remarks);
std::unique_ptr<const InputSource> make_area(const InputSpec& spec);
std::unique_ptr<const InputSource> make_vortex(const InputSpec& spec);
std::unique_ptr<const InputSource> make_shape(const InputSpec& spec, std::vector<std::string>& remarks);
std::unique_ptr<const InputSource> make_texture(const InputSpec& spec);
std::unique_ptr<const InputSource> make_trail(const InputSpec& spec, std::vector<std::string>& remarks);

// A frame on the plane, turned clockwise seen from above: its x to +x and its y to +z where it is not turned.
struct TurnedFrame {
  glm::dvec2 at{0.0};
  double cos = 1.0, sin = 0.0;

  TurnedFrame(glm::dvec2 at_m, double turn_deg);
  glm::dvec2 local(glm::dvec2 place) const {
    const glm::dvec2 d = place - at;
    return {cos * d.x + sin * d.y, cos * d.y - sin * d.x};
  }
  glm::dvec2 turned(glm::dvec2 v) const { return {cos * v.x - sin * v.y, sin * v.x + cos * v.y}; }
  // Of a rectangle of these half sides about `middle`, both in the frame.
  InputBounds bounds(glm::dvec2 middle, glm::dvec2 half) const;
};

// The input's own value as vec4: a factor in all channels.
glm::vec4 plain_value(const InputSpec& spec, glm::vec4 value);
// Colours are kept multiplied by their cover, so that they can be mixed.
glm::vec4 with_cover(const InputSpec& spec, glm::vec4 value);

}  // namespace seascape
