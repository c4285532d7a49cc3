// Bodies as an actor of the sea: they float on what is felt of it, keep its water out of their hulls, and are seen
// where they are at the time of a frame.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/view.h"
#include "ocean/bodies/boat.h"
#include "ocean/bodies/bodies.h"
#include "ocean/bodies/body_events.h"
#include "ocean/bodies/helmsman.h"
#include "ocean/bodies/hull_course.h"
#include "ocean/bodies/moorings.h"
#include "ocean/bodies/sea_water.h"
#include "ocean/bodies/wake_foam.h"
#include "ocean/sea/sea_actor.h"

namespace seascape {

// What of a body holds no water: hulls of ClipRoom::hulls, whose origin and axes are the body's, so many times as
// large.
struct BodyInsides {
  std::vector<int> hulls;
  double scale = 1.0;
};

// What bodies may run into beside each other: what stands still, the ground where `land`, and their lines.
struct BodySurroundings {
  std::vector<StillCollider> still;
  bool land = false;
  std::vector<BodyMooring> moorings;
  std::vector<BodyFittings> fittings;  // of each body, or none at all
  std::vector<MooringPoint> points;
};

// Bodies move in the sea's steps alone. What they do depends on where they began and on the steps since, never on
// frames, viewer, preset or threads.
class SeaBodies final : public SeaActor {
 public:
  // `boats`, `courses` (null: it goes any way alike) and `insides`: one a body each. Throws Error as Bodies does.
  SeaBodies(const BodySettings& settings, std::vector<BodySpec> specs, std::vector<BoatSpec> boats,
            std::vector<std::shared_ptr<const HullCourse>> courses, std::vector<BodyInsides> insides,
            const BodySurroundings& surroundings = {});

  // Other gravity, wind and water from the next step on.
  void take(const HullMedia& media);

  void step(SeaStep& step) override;
  void hold() override;
  std::uint64_t hash() const override;

  std::size_t size() const { return insides_.size(); }
  // It makes waves, foam and spray (of its mesh about the centre of mass); no source is shorter than this (m).
  void makes_waves(std::size_t body, std::shared_ptr<const HullWake> hull, double least_length_m);
  // As by a towing carriage: it keeps the velocity along the sea, the course and the heading that it has, and heaves,
  // pitches and rolls as it likes.
  void tow(std::size_t body) { towed_.push_back({body, bodies_.result()[body].motion}); }
  // Where a body's hull has its origin at a time (s): as the last step left it, carried on by its velocity and spin,
  // no longer than a step lasts. Held bodies stay.
  Pose pose_at(std::size_t body, double time_s) const;
  // Of that origin, m/s.
  glm::dvec3 velocity_mps(std::size_t body) const;
  const Bodies& bodies() const { return bodies_; }
  Bodies& bodies() { return bodies_; }
  // What is asked of a boat from the next step on, until it is asked for something else; her helmsman lets go.
  void ask(std::size_t body, const BoatControls& controls);
  // Sets a boat's sails at once as the wind has them, so that they do not swing there in her first steps.
  void trim(std::size_t body) { boats_[body].trim(bodies_.result()[body], media_); }
  // From the next step on until somebody asks her for something, and again once she is put back.
  void keep_to(std::size_t body, Helmsman helmsman) { steered_.push_back({body, std::move(helmsman), true}); }
  const Boat& boat(std::size_t body) const { return boats_[body]; }
  // What has happened to bodies since the last call, in order.
  std::vector<BodyEvent> take_events() { return std::exchange(told_, {}); }
  // How often steps were missing since it was made, so that all stayed where they were.
  int holds() const { return holds_; }

  // Moorings: what is done between steps counts from the next one on.
  std::vector<std::string> make_fast(std::size_t body, double reach_m) {
    return moorings_.make_fast(body, reach_m, bodies_);
  }
  void cast_off(std::size_t body) { moorings_.cast_off(body, bodies_); }
  AnchorDrop drop_anchor(std::size_t body) { return moorings_.drop_anchor(body, bodies_, water_, media_); }
  void weigh_anchor(std::size_t body) { moorings_.weigh(body, bodies_); }
  const Moorings& moorings() const { return moorings_; }
  // Puts a body back where the scene has it, upright, dry and at rest; of lines it has the scene's.
  void put_back(std::size_t body);
  // A line as it hangs at a time (pose_at): from a body to where it is made fast, or to its anchor.
  struct HungLine {
    glm::dvec3 from_m{0.0}, to_m{0.0};
    double length_m = 0.0, diameter_m = 0.0;
    std::optional<Chain> chain;
  };
  HungLine line_at(std::size_t line, double time_s) const;

 private:
  struct Towed {
    std::size_t body;
    BodyMotion as;  // at the end of the last step, but for heave, pitch and roll
  };
  struct Steered {
    std::size_t body;
    Helmsman helmsman;
    bool steers;
  };
  struct Wake {
    std::size_t body;
    std::shared_ptr<const HullWake> hull;
    double least_length_m, length_m;
    WakeFoam foam;
  };
  void keep_course(std::size_t body, double end_s);
  void hold_towed(double dt_s);
  void make_waves(SeaStep& step, Wake& wake);
  ClipBody clip_of(std::size_t body, int hull) const;
  SeaWater water_;
  Moorings moorings_;
  Bodies bodies_;
  HullMedia media_;
  std::vector<Boat> boats_;
  std::vector<std::shared_ptr<const HullCourse>> courses_;
  std::vector<BodyInsides> insides_;
  std::vector<Towed> towed_;
  std::vector<Steered> steered_;
  std::vector<Wake> wakes_;
  std::vector<HullSection> cut_;
  std::vector<WaveSource> sources_;
  WakeFoam::Made made_;
  BodyEvents events_;
  std::vector<BodyEvent> told_;
  double stepped_s_ = 0.0, step_s_ = 0.0;  // the last step's end and length; a length of 0: held
  int holds_ = 0;
};

}  // namespace seascape
