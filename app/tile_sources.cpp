#include "app/tile_sources.h"

#include <algorithm>

#include "app/loop_file.h"
#include "ocean/effects.h"
#include "ocean/inputs/input_source.h"
#include "ocean/sea/sea_spec.h"
#include "ocean/waves/baked.h"
#include "ocean/waves/wave_particles.h"

namespace seascape {

namespace {
// The source that there was before of this kind; null: none.
template <class Source>
std::shared_ptr<const Source> found(const MadeBefore* before, bool along_curves = false) {
  if (before == nullptr) return nullptr;
  for (const auto& source : before->sea.sources)
    if (source->along_curves() == along_curves)
      if (auto same = std::dynamic_pointer_cast<const Source>(source)) return same;
  return nullptr;
}

// The same where it is of the same settings.
template <class Source>
std::shared_ptr<const Source> unchanged(const Scene& scene, const MadeBefore* before, std::string_view group,
                                        bool along_curves = false) {
  auto source = found<Source>(before, along_curves);
  if (source == nullptr) return nullptr;
  const SeaState &now = scene.settings.sea, &was = before->settings.sea;
  const bool same = same_group(scene.settings, before->settings, group) && now.gravity_mps2 == was.gravity_mps2 &&
                    now.depth_m == was.depth_m && now.loop_s == was.loop_s;
  return same ? source : nullptr;
}
}  // namespace

std::shared_ptr<const Gerstner> shore_gerstner(const Scene& scene, const MadeBefore* before) {
  if (!calls_for(scene.effects, "gerstner")) return nullptr;
  std::vector<std::string> told;
  if (std::none_of(scene.inputs.begin(), scene.inputs.end(), [&](const InputSpec& spec) {
        return spec.to == InputTarget::gerstner && spec.weight > 0.0 && !points_apart(spec, told).empty();
      }))
    return nullptr;
  if (auto same = unchanged<Gerstner>(scene, before, "gerstner", true)) return same;
  const Settings& s = scene.settings;
  auto tile = std::make_shared<const Gerstner>(s.gerstner, s.sea.gravity_mps2, s.sea.depth_m, s.sea.loop_s, true);
  return tile->still() ? nullptr : tile;
}

TileSources tile_sources(const Scene& scene, const LimitedSea& limited, const MadeBefore* before) {
  const auto wanted = [&](std::string_view name) { return calls_for(scene.effects, name); };
  const Settings& s = scene.settings;
  TileSources sources;
  if (wanted("gerstner")) {
    auto everywhere = unchanged<Gerstner>(scene, before, "gerstner");
    if (everywhere == nullptr)
      everywhere = std::make_shared<const Gerstner>(s.gerstner, s.sea.gravity_mps2, s.sea.depth_m, s.sea.loop_s);
    sources.push_back(everywhere);
    if (const std::shared_ptr<const Gerstner> shore = shore_gerstner(scene, before)) {
      validate_together(*everywhere, *shore, s.gerstner.chop);
      sources.push_back(shore);
    }
  }
  if (wanted("wave_particles")) {
    auto particles = unchanged<WaveParticles>(scene, before, "wave_particles");
    if (particles == nullptr || particles->height_m() != limited.particles->height_m)
      particles = std::make_shared<const WaveParticles>(*limited.particles, s.sea.gravity_mps2, s.sea.loop_s);
    sources.push_back(particles);
  }
  if (wanted("baked")) {
    auto loop = unchanged<Baked>(scene, before, "baked");
    if (loop == nullptr) {
      const auto other = found<Baked>(before);
      loop =
          other != nullptr && before->settings.baked.loop == s.baked.loop
              ? std::make_shared<const Baked>(*other, s.baked, s.sea.loop_s)
              : std::make_shared<const Baked>(read_loop(loop_folder(s.baked.loop, scene.file)), s.baked, s.sea.loop_s);
    }
    sources.push_back(loop);
  }
  return sources;
}

}  // namespace seascape
