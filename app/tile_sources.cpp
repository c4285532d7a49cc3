#include "app/tile_sources.h"

#include <algorithm>

#include "ocean/effects.h"
#include "ocean/waves/wave_particles.h"

namespace seascape {

TileSources tile_sources(const Scene& scene) {
  const std::vector<EffectEntry> effects = closure(scene.effects);
  const auto wanted = [&](std::string_view name) {
    return std::any_of(effects.begin(), effects.end(), [&](const EffectEntry& entry) { return entry.name == name; });
  };
  const Settings& s = scene.settings;
  TileSources sources;
  if (wanted("wave_particles")) sources.push_back(std::make_shared<WaveParticles>(s.wave_particles, s.sea.gravity_mps2, s.sea.loop_s));
  return sources;
}

}  // namespace seascape
