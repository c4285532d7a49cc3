#include "app/tile_sources.h"

#include <algorithm>

#include "app/loop_file.h"
#include "ocean/effects.h"
#include "ocean/inputs/input_source.h"
#include "ocean/waves/baked.h"
#include "ocean/waves/wave_particles.h"

namespace seascape {

std::shared_ptr<const Gerstner> shore_gerstner(const Scene& scene) {
  if (!calls_for(scene.effects, "gerstner")) return nullptr;
  std::vector<std::string> told;
  if (std::none_of(scene.inputs.begin(), scene.inputs.end(), [&](const InputSpec& spec) {
        return spec.to == InputTarget::gerstner && spec.weight > 0.0 && !points_apart(spec, told).empty();
      }))
    return nullptr;
  const Settings& s = scene.settings;
  auto tile = std::make_shared<const Gerstner>(s.gerstner, s.sea.gravity_mps2, s.sea.depth_m, s.sea.loop_s, true);
  return tile->still() ? nullptr : tile;
}

TileSources tile_sources(const Scene& scene) {
  const auto wanted = [&](std::string_view name) { return calls_for(scene.effects, name); };
  const Settings& s = scene.settings;
  TileSources sources;
  if (wanted("gerstner")) {
    const auto everywhere =
        std::make_shared<const Gerstner>(s.gerstner, s.sea.gravity_mps2, s.sea.depth_m, s.sea.loop_s);
    sources.push_back(everywhere);
    if (const std::shared_ptr<const Gerstner> shore = shore_gerstner(scene)) {
      validate_together(*everywhere, *shore, s.gerstner.chop);
      sources.push_back(shore);
    }
  }
  if (wanted("wave_particles"))
    sources.push_back(std::make_shared<WaveParticles>(s.wave_particles, s.sea.gravity_mps2, s.sea.loop_s));
  if (wanted("baked"))
    sources.push_back(std::make_shared<Baked>(read_loop(loop_folder(s.baked.loop, scene.file)), s.baked));
  return sources;
}

}  // namespace seascape
