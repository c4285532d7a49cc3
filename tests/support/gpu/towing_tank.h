// The scene wake_tank at any speed and course: what is drawn of the water around its hull, and what that wake measures.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tests/support/gpu/sea_shot.h"

namespace seascape::test {

struct TankRun {
  double froude = 0.4;        // of the hull's length, 10 m
  double course_deg = 0.0;    // clockwise from -z
  double way_m = 150.0;       // before the frame that is measured
  double frame_s = 1.0 / 60;  // between frames
  std::string preset = "high";
  glm::dvec3 eye_m{0.0, 46.0, 26.0};  // to the right of the hull's middle, above it, and behind it
  double looks_down_deg = 86.0, to_right_deg = 0.0;
  // From up there presets draw waves of centimetres as light alone: a finer mesh shows their heights too.
  std::vector<std::pair<std::string, std::string>> set = {{"lod.pixel_error", "0.25"}};
};

// The surface that one frame draws: the mesh as the vertex shader put it out, straight between its vertices.
class DrawnWake {
 public:
  explicit DrawnWake(const TankRun& run);
  static constexpr double length_m = 10.0, step_m = 0.2, behind_m = 100.0, aside_m = 30.0;

  double speed_mps() const { return speed_; }
  // Wave number of the transverse waves, 1/m (Kelvin 1887).
  double transverse_number() const;
  // The height (m) so far behind the hull's middle and to its right; where no water is drawn 0.
  double height(double behind_m, double right_m) const;
  bool drawn(double behind_m, double right_m) const;

  // The root of height^2 + |sideways displacement|^2: of a wave on deep water its amplitude, for its water goes in
  // circles (Airy 1845). The displacement before the share of it that keeps the water from folding.
  double amplitude(double behind_m, double right_m) const;

  // Half the opening of the wake seen from the bow, degrees: where, beyond the outermost crest of the amplitude, that
  // has fallen to what it is on the line where rays fold over (Airy's function there over its greatest value); means
  // over both sides and over lines across the wake from..to m behind the hull's middle.
  double envelope_deg(double from_m, double to_m) const;
  // The same of where the amplitude is greatest, seen from the hull's middle.
  double highest_deg(double from_m, double to_m) const;
  // Of the waves along the hull's way, m: that of A cos(k x) + B sin(k x), over the root of the distance from the
  // stern, which fits the heights best.
  double wavelength_m(double from_m, double to_m) const;
  // The mean square difference from another run's heights in a rectangle behind the hull, over the mean square of
  // these.
  double difference(const DrawnWake& other, glm::dvec2 behind_m, glm::dvec2 right_m) const;

 private:
  struct Vertex {
    glm::dvec2 at;  // behind and right
    glm::dvec3 moved;
  };
  void rasterise(const std::vector<Vertex>& vertices);  // patch after patch
  glm::vec3 moved(double behind_m, double right_m) const;
  double speed_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<glm::vec3> moved_;  // y: the height; x NaN where nothing is drawn
};

}  // namespace seascape::test
