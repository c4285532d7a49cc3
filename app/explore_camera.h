// The camera that explore moves: flies, walks at deck height, or rides the waves. Pure: keys and water in, pose out.
#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "engine/view.h"

namespace seascape {

enum class Travel { fly, walk, ride };
const char* travel_name(Travel travel);

// What the user asks of the camera for a stretch of time.
struct CameraWish {
  glm::dvec3 move{0.0};      // -1 to 1 each: to the right, up, forward
  glm::dvec2 turn_deg{0.0};  // by the mouse since the last step: to the right, up
  bool fast = false;
  // Where the head is that a display tracks, from the middle of the floor that carrier() gives: it moves as it looks,
  // and turns about itself. Nothing: the camera is the head.
  std::optional<Pose> head;
  std::optional<double> ridden_m;  // the height that carries who rides the waves; nothing: the water's
  double faster_notches = 0;       // of the wheel: each changes the speed by a fifth
  // A swimmer's eyes are just above the water, and move as far as this along the sea in this time, until he dives;
  // under water they move up and down too. Nothing: one travels, or climbs back to how one travelled.
  struct Swum {
    glm::dvec3 moved_m{0.0}, velocity_mps{0.0};
  };
  std::optional<Swum> swum;
  // Who flies may dive, and comes no lower than this (m). Nothing: no eye comes into the water.
  std::optional<double> dives_to_m;
};

// Poses come from two angles, so the horizon stays level whatever was done before.
class ExploreCamera {
 public:
  static constexpr double deck_height_m = 1.7;   // a person's eyes over the still sea
  static constexpr double ride_height_m = 1.2;   // over the water that carries
  static constexpr double swim_height_m = 0.15;  // a swimmer's, when he began; he may raise his head and lower it
  static constexpr double clearance_m = 0.3;     // no eye comes closer to the water than this
  static constexpr double swim_clearance_m = 0.1;
  static constexpr double under_water_mps = 1.5;  // at full push, of who dives; ten times less than in flight
  static constexpr double dives_mps = 0.8;        // a swimmer, up or down
  static constexpr double largest_pitch_deg = 89.0;

  // Starts flying from a pose; its roll is dropped.
  explicit ExploreCamera(const Pose& start);

  // Moves for `dt_s` seconds. `water_m` is the water's height at the camera's place. The movement follows its
  // differential equation exactly for a constant wish, so it does not depend on how time is cut into frames.
  void step(const CameraWish& wish, double dt_s, double water_m);
  // Goes to another place at once, to stand there as it travels; who flies comes down to deck height.
  void jump(const glm::dvec2& place_m, double water_m);
  // The camera stays where it is and comes to the new height within about a second.
  void set_travel(Travel travel);

  Pose pose() const;
  // The middle of the floor that a tracked head stands on: deck height below the camera, level.
  Pose carrier() const;
  Travel travel() const { return travel_; }
  // He swims under water, not at the surface.
  bool dived() const { return dived_; }
  // The water, or the ground, kept it from coming lower in the last step.
  bool held() const { return held_; }
  double speed_mps() const;                                         // at full push, not fast
  const glm::dvec3& velocity_mps() const { return velocity_mps_; }  // as it pushes itself, nothing of what carries it
  double yaw_deg() const { return yaw_deg_; }
  double pitch_deg() const { return pitch_deg_; }

 private:
  double rest_height(double water_m) const;
  void swim(const CameraWish& wish, double dt_s, double water_m);
  void swim_under(const CameraWish& wish, double dt_s, double water_m);
  void come_to(double rest_m, double dt_s);
  Travel travel_ = Travel::fly;
  glm::dvec3 position_m_;
  glm::dvec3 velocity_mps_{0.0};
  double yaw_deg_ = 0.0, pitch_deg_ = 0.0;
  double speed_factor_ = 1.0;
  double height_above_rest_m_ = 0.0;  // not flying: what is left of the height that the change began with
  bool height_known_ = false, held_ = false, dived_ = false;
  std::optional<double> swims_head_m_;  // the head's height over the floor as swimming began
  double flown_at_m_ = 0.0;             // before that
  double climb_m_ = 0.0;                // flying: what is left of it to climb
};

}  // namespace seascape
