// How explore's user moves: what is held pushes, turns and aims, and what a recording keeps of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/explorer.h"
#include "app/frame.h"

namespace seascape {

namespace {

constexpr double farthest_jump_m = 200.0;

// What a hand feels: strength, and seconds.
struct Buzz {
  double strength, seconds;
};
constexpr Buzz aim_found{0.25, 0.02}, arrived{0.6, 0.08}, snapped{0.4, 0.03};

// A display tells its period in whole nanoseconds, which is not quite its rate.
double rate_hz(double period_s) { return period_s > 0.0 ? std::round(100.0 / period_s) / 100.0 : 0.0; }

}  // namespace

void Explorer::look(const Input& input) {
  // The button looks around when it went down over the sea, wherever it goes then.
  if (input.right_button && !button_was_down_ && !points_at_widgets()) look_by_button_ = true;
  if (!input.right_button) look_by_button_ = false;
  button_was_down_ = input.right_button;
  const bool held = look_by_button_ || look_by_key_;
  mirror_ ? mirror_->hold_mouse(held) : display_.hold_mouse(held);
}

void Explorer::suit_wearer() {
  const HeadsetSettings& wearer = settings().headset;
  display_.set_scale((display_.tracks_head() ? wearer.scale : 1.0) * quality_.scale);
  display_.set_rate(wearer.rate_hz);
  display_.set_left_handed(wearer.left_handed);
  display_.set_stature(wearer.seated, wearer.eye_height_m);
}

void Explorer::soften(const Input& input, double dt_s, double water_m, CameraWish& wish) {
  const ComfortSettings& c = settings().comfort;
  // A controller's stick asks for both, and comfort says which it is; what asks for one gets it.
  const double turn = types() ? 0.0 : input.value(Action::turn), snap = types() ? 0.0 : input.value(Action::snap_turn);
  ComfortSettings stepped = c;
  if (turn == 0.0) {
    stepped.on = true;
    if (stepped.snap_turn_deg == 0) stepped.snap_turn_deg = 30;
  }
  const bool smooth = turn != 0.0 && (snap == 0.0 || !c.on || c.snap_turn_deg == 0);
  const double steps_deg = comfort_.turned_deg(stepped, smooth ? 0.0 : snap, dt_s);
  wish.head = display_.head().value_or(Pose{{0.0, ExploreCamera::deck_height_m, 0.0}});
  wish.turn_deg = {smooth ? turn * c.turn_deg_per_s * dt_s : steps_deg, 0.0};
  if (!smooth && steps_deg != 0.0) feel(settings().headset.left_handed ? 0u : 1u, snapped.strength, snapped.seconds);
  ComfortMotion motion;
  motion.velocity_mps = camera_.velocity_mps();
  if (smooth) motion.turn_deg_per_s = turn * c.turn_deg_per_s;
  const glm::dvec3 at = head().position_m;
  if (camera_.travel() == Travel::ride && !swims(input))
    motion.carrier = Pose{{at.x, comfort_.ridden_m(c, water_m, dt_s), at.z}};
  comfort_.step(c, motion, dt_s);
  if (comfort_.carrier()) wish.ridden_m = comfort_.carrier()->position_m.y;
  experience_->show_comfort(comfort_.shown());
}

void Explorer::move(const Input& input, double dt_s) {
  hands_.follow(experience_->sea());
  hands_.move(hands(input), sea_time_s());
  if (crew_.body()) return sail(input, dt_s);
  CameraWish wish;
  const ComfortSettings& c = settings().comfort;
  const bool worn = display_.tracks_head();
  if (!types()) {
    wish.move = {input.value(Action::move_x), input.value(Action::move_y), -input.value(Action::move_z)};
    wish.fast = input.held(Action::fast);
  }
  if (!types() && !worn) {
    wish.turn_deg = glm::dvec2(input.value(Action::turn), input.value(Action::pitch)) * (c.turn_deg_per_s * dt_s);
    for (const auto& [action, value] : input.pressed)
      if (action == Action::snap_turn) wish.turn_deg.x += value * (c.snap_turn_deg > 0 ? c.snap_turn_deg : 30);
  }
  if (!points_at_widgets()) wish.faster_notches = input.wheel;
  const QueryAnswer water = water_at_camera(*experience_, head().position_m, sea_time_s());
  const double water_m = water.height_m;
  if (experience_->underwater()) wish.dives_to_m = std::min(water.still_m - water.depth_m, water_m);
  if (worn) soften(input, dt_s, water_m, wish);
  if (look_by_button_ || look_by_key_)
    wish.turn_deg += glm::dvec2(input.mouse_pixels.x, worn ? 0.0 : -input.mouse_pixels.y) *
                     (degrees_a_pixel * settings().render.vertical_fov_deg);
  const bool now_swims = swims(input);
  if (now_swims) wish.swum = swim(input, dt_s);
  swam_ = now_swims;
  camera_.step(wish, dt_s, water_m);
  if (camera_.held() && !std::exchange(told_to_stay_above_, true) && !wish.dives_to_m)
    tell("the camera stays above the water: to dive, switch the effect underwater on");
  aim(input);
}

CameraWish::Swum Explorer::swim(const Input& input, double dt_s) {
  const bool under = camera_.dived();
  const glm::dvec3 ahead = (under ? head().orientation : heading(head().orientation)) * glm::dvec3(0.0, 0.0, -1.0);
  if (!swam_) {
    swim_.begin_anew({camera_.velocity_mps().x, 0.0, camera_.velocity_mps().z});
    strokes_ = {};
  }
  SwimWish wish;
  wish.ahead = ahead;
  const SeaView water = experience_->sea()->view_at(sea_time_s(), SeaDetail::felt);
  const std::optional<Pose> head_then = display_.head();
  const std::array<std::optional<Pose>, 2> at = hands(input);
  for (std::size_t hand = 0; hand < 2; ++hand) {
    std::optional<glm::dvec3> from_head_m;
    if (head_then && strokes_.hands_m[hand]) from_head_m = *strokes_.hands_m[hand] - head_then->position_m;
    strokes_.hands_m[hand].reset();
    if (at[hand]) {
      wish.tracked = true;
      strokes_.hands_m[hand] = input.hands[hand]->grip.position_m;
      if (from_head_m && strokes_.from_head_m[hand] && strokes_.dt_s > 0.0) {
        const glm::dvec3 moves = carrier().orientation * ((*from_head_m - *strokes_.from_head_m[hand]) / strokes_.dt_s);
        const glm::dvec3& place = at[hand]->position_m;
        const double deep_m = water.query({place.x, place.z}, {.footprint_m = 0.1}).height_m - place.y;
        wish.hands[hand] =
            SwimHand{{moves.x, under ? moves.y : 0.0, moves.z},
                     HandInWater::section_m2(deep_m) / HandInWater::section_m2(2.0 * HandInWater::radius_m)};
      }
    }
    strokes_.from_head_m[hand] = from_head_m;
  }
  strokes_.dt_s = dt_s;
  swim_.step(wish, dt_s);
  return {swim_.moved_m(), swim_.velocity_mps()};
}

std::array<std::optional<Pose>, 2> Explorer::hands(const Input& input) const {
  std::array<std::optional<Pose>, 2> found;
  for (std::size_t hand = 0; hand < 2; ++hand)
    if (input.hands[hand]) found[hand] = composed(carrier(), input.hands[hand]->grip);
  return found;
}

// Where they are held, pointing as they aim.
void Explorer::show_hands(const Input& input) {
  std::vector<ShownHand> shown;
  for (std::size_t hand = 0; hand < 2; ++hand) {
    if (!input.hands[hand]) continue;
    const Pose at{input.hands[hand]->grip.position_m, input.hands[hand]->aim.orientation};
    const double closed = std::max(input.value(hand == 0 ? Action::grab_left : Action::grab_right),
                                   0.4 * input.value(hand == 0 ? Action::select_left : Action::select_right));
    shown.push_back({composed(carrier(), at), hand == 1, closed});
  }
  experience_->show_hands(std::move(shown));
}

void Explorer::record(const Input& input, const Pose& head) {
  head_ = head;
  if (std::exchange(recording_wanted_, false)) {
    recorder_.start(now_s_, head, scene_time_s(), {rate_hz(period_s_)});
    recording_began_s_ = now_s_;
    recording_began_ = true;
    tell("path: recording");
  }
  if (!recorder_.recording()) return;
  RecordedInput told;
  told.values = input.values;
  // A path begins with its scene's light.
  if (std::exchange(recording_began_, false) && settings().dive_light.on != program_.scene.settings.dive_light.on)
    told.presses.push_back({0.0, Action::light, 1.0});
  for (const Press& press : input.pressed) told.presses.push_back({0.0, press.action, press.value});
  told.hands = hands(input);
  recorder_.sample(now_s_, head, scene_time_s(), told);
  if (recorder_.full().empty()) return;
  tell(recorder_.full());
  toggle_recording();
}

Pose Explorer::carrier() const {
  if (crew_.body()) return carrier_aboard();
  return display_.tracks_head() ? camera_.carrier() : camera_.pose();
}

Pose Explorer::head() const {
  if (!display_.tracks_head()) return carrier();
  return composed(carrier(), display_.head().value_or(Pose{{0.0, ExploreCamera::deck_height_m, 0.0}}));
}

// The one that points and turns, where it is tracked, or the other.
std::optional<std::size_t> Explorer::pointing_hand(const Input& input) const {
  const std::size_t first = settings().headset.left_handed ? 0 : 1;
  for (const std::size_t hand : {first, 1 - first})
    if (input.hands[hand]) return hand;
  return std::nullopt;
}

// What points at the water: a hand, or the view.
Pose Explorer::pointer(const Input& input) const {
  if (const auto hand = pointing_hand(input)) return composed(carrier(), input.hands[*hand]->aim);
  return head();
}

// The head comes to stand there, wherever it is over the floor's middle.
void Explorer::jump(const glm::dvec3& to_m) {
  const glm::dvec3 off = head().position_m - camera_.pose().position_m;
  camera_.jump({to_m.x - off.x, to_m.z - off.z}, to_m.y);
  comfort_.begin_anew();
}

void Explorer::feel(std::optional<std::size_t> hand, double strength, double seconds) {
  if (hand) display_.buzz(int(*hand), strength, seconds);
}

ShownAim Explorer::shown_aim(const Input& input, const SeaView& water) const {
  ShownAim shown;
  const Pose from = pointer(input);
  if (pointing_hand(input)) shown.from_m = from.position_m;
  shown.found = aimed_at_m_.has_value();
  shown.to_m =
      aimed_at_m_.value_or(from.position_m + from.orientation * glm::dvec3(0.0, 0.0, -aim_line_without_water_m));
  if (!shown.found) return shown;
  std::array<glm::dvec2, ShownAim::sides> places;
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = aim_corner(shown.to_m, i);
  std::array<QueryAnswer, ShownAim::sides> answers;
  water.query(places, answers, {.footprint_m = 0.1});
  // Few of the small waves that are drawn and not felt stand over it.
  for (std::size_t i = 0; i < places.size(); ++i) shown.water_m[i] = answers[i].height_m + 1.5 * water.left_out_m();
  return shown;
}

void Explorer::aim(const Input& input) {
  std::optional<ShownAim> shown;
  const bool held = !types() && input.held(Action::teleport);
  if (held) {
    const Pose from = pointer(input);
    const glm::dvec3 ahead = from.orientation * glm::dvec3(0.0, 0.0, -1.0);
    const SeaView water = experience_->sea()->view_at(sea_time_s(), SeaDetail::felt);
    const RayAnswer met = water.ray(from.position_m, ahead, {.most_m = farthest_jump_m});
    const bool found_before = aiming_ && aimed_at_m_;
    aimed_at_m_.reset();
    if (met.hit) aimed_at_m_ = from.position_m + met.distance_m * ahead;
    if (met.hit && !found_before) feel(pointing_hand(input), aim_found.strength, aim_found.seconds);
    if (display_.tracks_head()) shown = shown_aim(input, water);
  } else if (aiming_) {
    if (aimed_at_m_) {
      jump(*aimed_at_m_);
      feel(pointing_hand(input), arrived.strength, arrived.seconds);
    } else {
      tell(fmt::format("no water there within {:.0f} m", farthest_jump_m));
    }
    aimed_at_m_.reset();
  }
  aiming_ = held;
  if (display_.tracks_head()) experience_->show_aim(shown);
}

}  // namespace seascape
