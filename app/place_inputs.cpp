#include "app/place_inputs.h"

#include <algorithm>
#include <span>

#include "app/scene_hulls.h"
#include "app/tile_sources.h"
#include "ocean/effects.h"
#include "ocean/places/shore_lines.h"
#include "ocean/sea/sea_spec.h"

namespace seascape {

namespace {
// The patterns that a current carries come again with the waves.
PlaceSettings place_settings(const Settings& settings) {
  PlaceSettings result = settings.place;
  result.flow_period_s = period_in_loop(result.flow_period_s, settings.sea.loop_s);
  return result;
}

// Inputs clip where the scene names the effect; hulls of its things do so by themselves.
std::shared_ptr<const ClipVolumes> clip_volumes(const Scene& scene) {
  if (!calls_for(scene, "clip")) return nullptr;
  const bool named = calls_for(scene.effects, "clip");
  const ClipRoom room = hulls_of(scene);
  const std::span<const InputSpec> inputs =
      named ? std::span<const InputSpec>(scene.inputs) : std::span<const InputSpec>();
  if (room.most_bodies == 0 && room.still.empty() && std::none_of(inputs.begin(), inputs.end(), is_volume))
    return nullptr;
  return std::make_shared<const ClipVolumes>(inputs, room);
}
}  // namespace

PlaceInputs place_inputs(const Scene& scene, const MadeBefore* before) {
  PlaceInputs result{place_settings(scene.settings), {}, {}, nullptr};
  if (before != nullptr) result.following = before->sea.place.following;
  for (const InputTarget kind : {InputTarget::level, InputTarget::sea_depth, InputTarget::flow, InputTarget::clip,
                                 InputTarget::albedo, InputTarget::shadow}) {
    if (!calls_for(scene.effects, traits(kind).name)) continue;
    const bool on_water = kind == InputTarget::albedo || kind == InputTarget::shadow;
    auto follow = [](const InputSpec& spec) { return spec.follow_waves; };
    auto stay = [](const InputSpec& spec) { return !spec.follow_waves; };
    auto inputs = before != nullptr ? before->sea.place.of(kind) : nullptr;
    if (inputs == nullptr)
      inputs = on_water ? std::make_shared<const Inputs>(kind, scene.inputs, stay)
                        : std::make_shared<const Inputs>(kind, scene.inputs);
    if (auto following =
            on_water && before == nullptr ? std::make_shared<const Inputs>(kind, scene.inputs, follow) : nullptr;
        following && !following->empty())
      result.following.push_back(std::move(following));
    // A bed lies at waves.depth_m where no input gives another, but for one too deep to be seen or felt.
    const bool bed = kind == InputTarget::sea_depth && scene.settings.sea.depth_m < deep_water_m;
    if (bed || !inputs->empty() || place_outside(result.settings, kind) != glm::vec4(0.0f))
      result.kinds.push_back(std::move(inputs));
  }
  if (before != nullptr)
    result.volumes = before->sea.place.volumes;
  else
    result.volumes = clip_volumes(scene);
  if (const std::shared_ptr<const Gerstner> tile = shore_gerstner(scene, before)) {
    const auto same = before != nullptr ? before->sea.place.shore : nullptr;
    result.shore = same != nullptr && same->period_m() == tile->side_m()
                       ? same
                       : std::make_shared<const ShoreLines>(scene.inputs, tile->side_m());
  }
  return result;
}

std::optional<FoamSpec> foam_spec(const Scene& scene) {
  if (!calls_for(scene.effects, "foam")) return std::nullopt;
  FoamSpec spec{scene.settings.foam, std::make_shared<const Inputs>(InputTarget::foam, scene.inputs), nullptr,
                place_settings(scene.settings)};
  for (const auto& kind : place_inputs(scene).kinds)
    if (kind->target() == InputTarget::flow) spec.flow = kind;
  return spec;
}

}  // namespace seascape
