// Explore aboard a boat: going aboard and ashore, driving her, and looking from her deck or at her.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/camera_path.h"
#include "app/explorer.h"
#include "app/frame.h"

namespace seascape {

void Explorer::board() {
  const auto& bodies = experience_->bodies();
  if (bodies == nullptr) return tell("no boats float here");
  const Pose was = head();
  tell(crew_.board(experience_->scene(), *bodies, was.position_m, sea_time_s()));
  look_deg_ = {0.0, 0.0};
  comfort_.begin_anew();
  if (crew_.body())
    display_.set_post(Post::aboard);
  else
    step_ashore(was);
}

void Explorer::work_boat(Action action) {
  const auto& bodies = experience_->bodies();
  if (bodies == nullptr) return tell("no boats float here");
  const auto told = crew_.press(action, experience_->scene(), *bodies, head().position_m, sea_time_s());
  if (told) tell(*told);
  if (action != Action::respawn) return;
  look_deg_ = {0.0, 0.0};
  comfort_.begin_anew();
}

// Where one was, level.
void Explorer::step_ashore(const Pose& was) {
  display_.set_post(Post::afoot);
  const Travel travel = camera_.travel();
  camera_ = ExploreCamera(was);
  camera_.set_travel(travel);
}

void Explorer::look_from_boat(BoatView view) {
  crew_.set_view(view, head().position_m);
  look_deg_ = {0.0, 0.0};
  comfort_.begin_anew();
  tell(std::string("looking ") + boat_view_name(view));
}

// The sea and its bodies are there at the frame's time before the deck is asked for.
void Explorer::sail(const Input& input, double dt_s) {
  const auto& bodies = experience_->bodies();
  crew_.drive(*bodies, types() ? ActionValues{} : input.values);
  (void)water_at_camera(*experience_, head().position_m, sea_time_s());

  const bool worn = display_.tracks_head();
  ComfortSettings comfort = settings().comfort;
  const double turn = types() ? 0.0 : input.value(Action::turn);
  ComfortMotion motion;
  if (worn) {
    look_deg_.x += comfort_.turned_deg(comfort, types() || turn != 0.0 ? turn : input.value(Action::snap_turn), dt_s);
  } else {
    comfort.heave = 1.0;  // on a desk nobody falls ill of a heave, and all see where the deck is
    look_deg_ += glm::dvec2(turn, types() ? 0.0 : input.value(Action::pitch)) * (comfort.turn_deg_per_s * dt_s);
    if (look_by_button_ || look_by_key_)
      look_deg_ += glm::dvec2(input.mouse_pixels.x, -input.mouse_pixels.y) *
                   (degrees_a_pixel * settings().render.vertical_fov_deg);
  }
  look_deg_ = {std::remainder(look_deg_.x, 360.0), std::clamp(look_deg_.y, -89.0, 89.0)};
  if (crew_.view() == BoatView::deck) {
    motion.carrier = crew_.eyes(*bodies, sea_time_s());
    motion.velocity_mps = bodies->velocity_mps(*crew_.body());
  }
  comfort_.step(comfort, motion, dt_s);
  eyes_aboard_ =
      motion.carrier ? comfort_.carrier().value_or(*motion.carrier) : crew_.outside(*bodies, sea_time_s(), dt_s);
  if (experience_->options().comfort) experience_->show_comfort(comfort_.shown());
}

// Steps that are missing are seen: what floats has not moved.
void Explorer::tell_of_bodies() {
  const auto& bodies = experience_->bodies();
  const int holds = bodies != nullptr ? bodies->holds() : 0;
  if (holds > std::exchange(holds_, holds) && holds > 1) tell("the sea's time jumped: what floats stays where it is");
  if (bodies == nullptr) return;
  for (const BodyEvent& event : bodies->take_events())
    if (crew_.body() == event.body && event.kind != BodyEventKind::in && event.kind != BodyEventKind::out)
      tell(fmt::format("{}: {}", crew_.name(), name_of(event.kind)));
}

void Explorer::tell_of_eyes() {
  eyes_.step(now_s_, experience_->eyes_depth_m().first(std::size_t(display_.views())));
  for (const EyeEvent& event : eyes_.take_events()) {
    if (!event.in || std::exchange(told_how_to_swim_, true)) continue;
    tell("under water: the move keys swim where one looks, E rises, Q dives, N is the light");
  }
}

// What a display's head is seen from: the deck below the eyes, or the eyes.
Pose Explorer::carrier_aboard() const {
  const glm::dquat turned = orientation_from_angles({look_deg_.x, display_.tracks_head() ? 0.0 : look_deg_.y, 0.0});
  const Pose eyes{eyes_aboard_.position_m, eyes_aboard_.orientation * turned};
  if (!display_.tracks_head()) return eyes;
  return {eyes.position_m - eyes.orientation * glm::dvec3(0.0, ExploreCamera::deck_height_m, 0.0), eyes.orientation};
}

}  // namespace seascape
