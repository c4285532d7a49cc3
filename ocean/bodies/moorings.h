// By what bodies lie: lines made fast to what is near and cast off again, anchors let go and weighed, lines that part
// and anchors that drag. Pure.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ocean/bodies/bodies.h"
#include "ocean/bodies/body_events.h"
#include "ocean/bodies/chain.h"
#include "ocean/bodies/sea_water.h"

namespace seascape {

// A cleat, a bollard or a ring that stands still.
struct MooringPoint {
  std::string name;
  glm::dvec3 at_m{0.0};
};

// Where lines are made fast to a body, in its hull's axes: a boat's bow and then her stern, a buoy's ring. None:
// nowhere.
using BodyFittings = std::vector<glm::dvec3>;

// Made fast to a place of the sea (x, z): from a place of the body's own, to the ground there where that is known.
struct BodyMooring {
  std::size_t body = 0;
  glm::dvec3 from_m{0.0};
  glm::dvec2 to_m{0.0};
};

// A boat's own lines: of polyamide in three strands, which breaks at about 210 N a mm^2 of its diameter's square (EN
// ISO 1140) and stretches by three tenths until then, taken for even; 12 mm for 4.5 t, as the cube root, and none
// thinner than 10 mm, which would cut the hands (estimates).
struct MooringRope {
  double diameter_m = 0.012, breaking_n = 3e4;
  static constexpr double most_stretch = 0.3;
};
MooringRope rope_of(double boat_kg);

// A boat's anchor and chain, by estimates of what such boats carry: 13.6 kg, 8 mm and 50 m for 4.5 t. Of the chain a
// metre weighs 0.0219 kg by the square of its diameter in mm, 0.87 of it in water; it breaks at 300 N/mm^2 of both
// sides of its links (ISO 4565, grade 30); EA is 0.854e11 N by the square of the diameter in m (Orcina's OrcaFlex
// manual, studless chain). The anchor holds 560 kN (kg / 4536)^0.8, a Danforth in sand (UFC 4-159-03, 2005, equation
// 26).
struct GroundTackle {
  double anchor_kg = 0.0, holds_n = 0.0;
  double chain_diameter_m = 0.0, chain_m = 0.0;
  double weight_n_m = 0.0, stiff_n = 0.0, breaking_n = 0.0;
};
GroundTackle tackle_of(double boat_kg, double gravity_mps2);

// Chain let go is so many times as long as the bow stands over the ground: the most if there is that much.
inline constexpr double least_scope = 3.0, most_scope = 5.0;

struct AnchorDrop {
  bool let_go = false;
  bool dry = false;  // there is no water to anchor in
  double depth_m = 0.0, chain_m = 0.0;
  double most_depth_m = 0.0;  // that her chain is long enough for
};

class Moorings {
 public:
  enum class Kind : std::uint8_t { scene, line, anchor };
  struct Line {
    Kind kind = Kind::line;
    MooringLine is;
    double breaking_n = 0.0, diameter_m = 0.0;  // breaking 0: never
    double dragged_s = -1e9;                    // when its anchor did last
  };
  // `fittings`: of each body, or none at all. `still`: what lines may be led round where there is no fitting.
  Moorings(std::vector<BodyMooring> of_scene, std::vector<BodyFittings> fittings, std::vector<MooringPoint> points,
           std::vector<StillCollider> still);

  // Before a step: lines that the scene has, from the first on, and those of bodies that came back.
  void make_scene_lines(Bodies& bodies, const SeaWater& water, const HullMedia& media);
  // After a step: lines part, and anchors drag to where the chain pulls no harder than they hold.
  void follow(double end_s, double dt_s, Bodies& bodies, const SeaWater& water, std::vector<BodyEvent>& events);

  // From each of its fittings a line to the nearest fitting of another body or point, within `reach_m`; where there is
  // none at all, to the nearest place of what stands still. One line where both would lead to the same. Names what it
  // lies at, each once; empty: nothing is near.
  std::vector<std::string> make_fast(std::size_t body, double reach_m, Bodies& bodies);
  bool made_fast(std::size_t body) const;
  // All its lines but its anchor's, and those of others to it.
  void cast_off(std::size_t body, Bodies& bodies);
  bool anchored(std::size_t body) const;
  // Below the first of its fittings, on the ground as the water of the last step has it.
  AnchorDrop drop_anchor(std::size_t body, Bodies& bodies, const SeaWater& water, const HullMedia& media);
  void weigh(std::size_t body, Bodies& bodies);
  // Of a body that is put back where the scene has it: its lines and its anchor come off, the scene's are made fast
  // anew in the next step.
  void begin_anew(std::size_t body, Bodies& bodies);

  std::span<const Line> lines() const { return lines_; }
  const BodyFittings& fittings(std::size_t body) const;
  std::uint64_t mixed_into(std::uint64_t hash) const;  // unchanged by the scene's lines

 private:
  struct Target {
    std::string name;
    glm::dvec3 at_m{0.0};  // in the world
    std::optional<std::size_t> body;
    glm::dvec3 on_body_m{0.0};
    double away_m = 1e300;
  };
  Target nearest(std::size_t body, const glm::dvec3& from_m, const Bodies& bodies) const;
  Target nearest_still(const glm::dvec3& from_m) const;
  void hand_over(Bodies& bodies);
  std::vector<BodyMooring> of_scene_, pending_;
  std::vector<BodyFittings> fittings_;
  std::vector<MooringPoint> points_;
  std::vector<StillCollider> still_;
  std::vector<Line> lines_;  // in the order of those of the bodies
};

}  // namespace seascape
