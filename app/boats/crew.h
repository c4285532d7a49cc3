// Who goes aboard: boards a boat near by, drives her by what is held, sees from her deck or sees her, and steps off.
// Pure.
#pragma once
#include <optional>
#include <string>

#include "app/boats/boat_model.h"
#include "app/scene.h"
#include "ocean/bodies/sea_bodies.h"
#include "platform/input_script.h"

namespace seascape {

// deck: from a seat. chase: from behind, as she turns. fixed: from where one was, towards her.
enum class BoatView { deck, chase, fixed };
const char* boat_view_name(BoatView view);

class Crew {
 public:
  static constexpr double reach_m = 8.0;    // of a boat's seat from the head
  static constexpr double line_m = 8.0;     // of what she is made fast to from her bow and stern
  static constexpr double eyes_m = 0.75;    // over a seat
  static constexpr double capsized = 0.35;  // cosine of a heel from which a boat is righted before she is boarded

  // Aboard: steps off. Else boards the boat of the nearest seat in reach, by its best seat: helm, then oars; one that
  // lies on her side is righted. Gives what to tell.
  std::string board(const Scene& scene, SeaBodies& bodies, const glm::dvec3& head_m, double time_s);
  // Aboard: makes her fast to what lies within line_m of bow and stern, or casts her off.
  std::string moor(SeaBodies& bodies) const;
  // Aboard: lets her anchor go, or weighs it.
  std::string anchor(SeaBodies& bodies) const;
  // Puts the boat back that one is aboard of or stepped off last, or else the nearest within reach_m.
  std::string respawn(const Scene& scene, SeaBodies& bodies, const glm::dvec3& head_m, double time_s) const;
  // What an action of these and `board` does, and what to tell of it; nothing: it is none of them.
  std::optional<std::string> press(Action action, const Scene& scene, SeaBodies& bodies, const glm::dvec3& head_m,
                                   double time_s);
  // Ashore at once, and nothing is asked of the boat any more. Where the bodies are others, before they go.
  void leave(SeaBodies& bodies);
  void forget() { *this = {}; }

  std::optional<std::size_t> body() const { return body_; }
  const std::string& name() const { return name_; }
  // What is held becomes her controls.
  void drive(SeaBodies& bodies, const ActionValues& values) const;

  BoatView view() const { return view_; }
  // Where the head is now counts as the place of a fixed view.
  void set_view(BoatView view, const glm::dvec3& head_m);

  // The eyes on deck, with her heel and trim, ahead as the seat looks. Aboard only.
  Pose eyes(const SeaBodies& bodies, double time_s) const;
  // The eyes of the other views, level, after dt_s more. Aboard only.
  Pose outside(const SeaBodies& bodies, double time_s, double dt_s);

 private:
  std::optional<std::size_t> body_, last_;  // last_: that was boarded last
  std::string name_;
  BoatSeat seat_;
  double length_m_ = 5.0;
  BoatView view_ = BoatView::deck;
  glm::dvec3 stood_m_{0.0};
  std::optional<double> chased_rad_;  // the heading that a chase follows, from -z to starboard
};

}  // namespace seascape
