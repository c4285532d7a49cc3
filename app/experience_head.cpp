// What an experience keeps of the viewer's head from frame to frame: water on the lenses, and his breath in the water.
#include "app/experience.h"
#include "app/water_shapes.h"

namespace seascape {

void Experience::wet_lenses(const Viewpoint& viewpoint, double time_s, bool in_air) {
  if (!scene_.shapes.portals.empty()) return;  // who looks into them stands in a dry place
  if (underwater_ && !clear_lens()) wet_lens_.step(*sea_, viewpoint, scene_.settings.render.near_m, time_s, in_air);
}

// With underwater(): where the surface passes near planes, the water on the lenses and the bubbles that this frame
// draws.
void Experience::update_head(Frame& frame, const Viewpoint& viewpoint, const Ocean::EyesSide& side, double time_s) {
  eyes_depth_m_ = side.depth_m;
  breathe(time_s, viewpoint.viewer);
  bubbles_->update(frame, breath_, viewpoint.viewer.position_m, side.eyes);
  const bool portals = !scene_.shapes.portals.empty();  // who looks into them stands in a dry place
  const std::size_t eyes =
      side.eyes == EyesIn::either && !portals ? std::min(viewpoint.eyes.size(), side.near.size()) : 0;
  surface_->near_lines().choose(frame, *ocean_->selection(), std::span(side.near).first(eyes));
  wet_lenses(viewpoint, time_s, side.eyes == EyesIn::air);
  if (clear_lens() || portals)
    lens_->update(frame, false, {});
  else
    lens_->update(frame, true, wet_lens_.drops());
}

void Experience::breathe(double time_s, const Pose& head) {
  if (!underwater_) return;
  breath_.apply(scene_.settings.breath);
  std::optional<double> water_m;
  const glm::dvec3& at = head.position_m;
  if (at.y < ocean_->highest_m() + 1.0) {
    const SeaView felt = sea_->view_at(time_s, SeaDetail::felt);
    const QueryAnswer water = felt.query({at.x, at.z}, {.footprint_m = 0.3});
    if (!water.clipped && !(shaped_ && kept_dry(scene_.shapes, scene_.objects, at, felt))) water_m = water.height_m;
  }
  breath_.advance(time_s, head, water_m);
}

}  // namespace seascape
