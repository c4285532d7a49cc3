#include "app/tile_sources.h"

#include "app/loop_file.h"
#include "ocean/effects.h"
#include "ocean/waves/baked.h"
#include "ocean/waves/gerstner.h"
#include "ocean/waves/wave_particles.h"

namespace seascape {

TileSources tile_sources(const Scene& scene) {
  const auto wanted = [&](std::string_view name) { return calls_for(scene.effects, name); };
  const Settings& s = scene.settings;
  TileSources sources;
  if (wanted("gerstner")) sources.push_back(std::make_shared<Gerstner>(s.gerstner, s.sea.gravity_mps2, s.sea.depth_m, s.sea.loop_s));
  if (wanted("wave_particles")) sources.push_back(std::make_shared<WaveParticles>(s.wave_particles, s.sea.gravity_mps2, s.sea.loop_s));
  if (wanted("baked")) sources.push_back(std::make_shared<Baked>(read_loop(loop_folder(s.baked.loop, scene.file)), s.baked));
  return sources;
}

}  // namespace seascape
