// Bodies that make waves without hulls: each goes its way on flat water, and presses it by a hump that moves along.
#pragma once
#include <cmath>
#include <utility>
#include <vector>

#include "ocean/sea/sea.h"
#include "ocean/sea/state_hash.h"

namespace seascape::test {

struct WakeMade {
  std::uint64_t id = 1;
  glm::dvec2 at_m{0.0}, velocity_mps{0.0};  // at time 0
  double length_m = 4.0, head_m = 0.05;
  double starts_s = -1e9;  // before it is not there,
  double stops_s = 1e9;    // and from then on it stands where it is and presses nothing
  double rise_mps = 0.0;   // of water that it raises and draws in besides, once in a second and a half
};

class WakeMaker : public SeaActor {
 public:
  explicit WakeMaker(std::vector<WakeMade> made) : made_(std::move(made)) {}
  // What bodies ask of the water in each step, and what they were told.
  QueryOptions options;
  bool asks = false;
  std::vector<QueryAnswer> told;

  static glm::dvec2 place(const WakeMade& body, double time_s) {
    return body.at_m + std::min(time_s, body.stops_s) * body.velocity_mps;
  }
  void step(SeaStep& step) override {
    for (const WakeMade& body : made_) {
      if (step.time_s < body.starts_s) continue;
      const bool moves = step.time_s < body.stops_s;
      const glm::dvec2 velocity = moves ? body.velocity_mps : glm::dvec2(0.0), at = place(body, step.time_s);
      if (asks) told.push_back(step.felt().query(at, options));
      const WaveSource hump{.place_m = at,
                            .velocity_mps = velocity,
                            .length_m = body.length_m,
                            .head_m = moves ? body.head_m : 0.0,
                            .rise_mps = moves ? body.rise_mps * std::sin(4.0 * step.time_s) : 0.0};
      step.wake({.id = body.id, .place_m = at, .velocity_mps = velocity, .length_m = body.length_m}, {&hump, 1});
    }
  }
  std::uint64_t hash() const override { return mixed(1, double(told.empty() ? 0.0 : told.back().height_m)); }

 private:
  std::vector<WakeMade> made_;
};

}  // namespace seascape::test
