#include "app/hands_in_water.h"

#include "ocean/sea/sea.h"

namespace seascape {

void HandsInWater::follow(const std::shared_ptr<Sea>& sea) {
  if (sea_.lock() == sea) return;
  sea_ = sea;
  last_ = {};
  actors_ = {};
  if (sea->dynamic_waves() == nullptr) return;
  for (auto& actor : actors_) {
    actor = std::make_shared<HandInWater>(sea->spec().dynamic_waves->waves.windows.texel_m);
    sea->add(actor);
  }
}

void HandsInWater::move(const std::array<std::optional<Pose>, 2>& hands, double time_s) {
  constexpr double longest_s = 0.2;  // between frames: what is longer is no movement
  for (std::size_t hand = 0; hand < 2; ++hand) {
    std::optional<HandInWater::At> at;
    if (hands[hand]) {
      at = HandInWater::At{time_s, hands[hand]->position_m};
      if (const auto& before = last_[hand]; before && time_s > before->time_s && time_s - before->time_s < longest_s)
        at->velocity_mps = (at->place_m - before->place_m) / (time_s - before->time_s);
    }
    last_[hand] = at;
    if (actors_[hand]) actors_[hand]->set(at);
  }
}

}  // namespace seascape
