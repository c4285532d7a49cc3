#include "ocean/sea/actor_bodies.h"

#include <algorithm>

#include "ocean/sea/state_hash.h"

namespace seascape {

ActorBodies::ActorBodies(std::shared_ptr<const ClipVolumes> volumes, double step_s)
    : scene_(std::move(volumes)), step_s_(step_s) {
  const std::size_t most = scene_ ? std::size_t(scene_->most_bodies()) : 0;
  last_.reserve(most);
  next_.reserve(most);
  carried_.reserve(most);
}

void ActorBodies::end_step(double end_s) {
  std::swap(last_, next_);
  end_s_ = end_s;
  held_ = false;
}

bool ActorBodies::add(const SeaActor& by, const ClipBody& body) {
  if (scene_ == nullptr || next_.size() == std::size_t(scene_->most_bodies()) || !scene_->takes(body)) return false;
  next_.push_back({&by, body});
  return true;
}

void ActorBodies::take_away(const SeaActor& by) {
  for (Said& said : last_)
    if (said.by == &by) said.by = nullptr;
}

void ActorBodies::forget() {
  std::erase_if(last_, [](const Said& said) { return said.by == nullptr; });
}

std::shared_ptr<const ClipVolumes> ActorBodies::at(double time_s) {
  if (last_.empty()) return scene_;
  // What a sum of frame times loses is no time of its own.
  const double since_s = time_s - end_s_, ahead_s = held_ || !(since_s > 1e-6) ? 0.0 : std::min(since_s, step_s_);
  carried_.clear();
  for (const Said& said : last_) carried_.push_back(carried(said.body, ahead_s));
  if (current_ < made_.size() && std::ranges::equal(made_[current_]->bodies(), carried_)) return made_[current_];
  for (current_ = 0; current_ < made_.size() && made_[current_].use_count() > 1;) ++current_;
  if (current_ == made_.size()) made_.push_back(std::make_shared<ClipVolumes>(*scene_));
  made_[current_]->place(carried_);
  return made_[current_];
}

std::uint64_t ActorBodies::mixed_into(std::uint64_t hash) const {
  for (const Said& said : last_) {
    const ClipBody& b = said.body;
    hash = mixed(mixed(hash, std::uint64_t(b.form)), std::uint64_t(b.hull));
    for (const double size : {b.round_m, b.radius_m, b.length_m, b.scale}) hash = mixed(hash, size);
    for (const glm::dvec3& v : {b.size_m, b.at_m, b.velocity_mps, b.spin_rad_s}) hash = mixed(hash, v);
    for (int i = 0; i < 4; ++i) hash = mixed(hash, b.orientation[i]);
  }
  return last_.empty() ? hash : mixed(hash, std::uint64_t(held_));
}

}  // namespace seascape
