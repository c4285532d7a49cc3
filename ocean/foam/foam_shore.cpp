#include "ocean/foam/foam_shore.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ocean/places/place_fields.h"
#include "ocean/sea/shore_sea.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {
// Slower than this, water stands (breaking.cpp).
constexpr float least_flow_mps = 0.02f;
}  // namespace

FoamShore::FoamShore(std::shared_ptr<const ShoreLines> lines, const LodWindowSettings& windows, const WaveField& field)
    : lines_(std::move(lines)), windows_(windows) {
  for (const auto& source : field.others()) {
    if (!source->along_curves()) continue;
    height_variance_ = source->statistics().height_variance;
    largest_shift_m_ = source->statistics().largest_shift_m;
  }
}

FoamShore::Texel FoamShore::texel(glm::dvec2 middle, double texel_m, const PlaceSea* water) const {
  const ShorePlace at = lines_->at(middle, texel_m);
  if (!(at.share > 0.0f)) return {};
  double share = double(at.share), surf = 0.0;
  if (water != nullptr) {
    const StillWater w = water->still_water(middle, texel_m, 0.0);  // as FoamSea
    share *= std::min(w.placed, 10.0);
    surf = std::min(w.placed_surf, 1.0);
  }
  const double period = lines_->period_m();
  return {glm::vec4(glm::dvec4(at.bent_m.x - period * std::floor(at.bent_m.x / period), at.bent_m.y, at.forward)),
          glm::vec4(at.stretch, float(at.turning_per_m), float(share), float(surf))};
}

void FoamShore::follow(const LodPlacement& placement, const PlaceSea* water) {
  if (field_)
    return field_->follow(
        placement, [&](glm::dvec2 middle, double texel_m, const Texel&) { return texel(middle, texel_m, water); });
  field_.emplace(windows_, Texel{}, placement);
  for (int i = 0; i < windows_.slices; ++i)
    for_each_row(windows_.resolution, [&](int z) {
      for (std::int64_t x = 0; x < field_->side(); ++x) take(i, field_->first(i) + LodIndex(x, z), water);
    });
}

bool FoamShore::row(const FoamRow& row, const WaveField& field, const WaveTiles& tiles,
                    const LodField<glm::vec2>* flow, const FlowPhase& phase, std::span<Moved> moved) const {
  const LodIndex first(glm::floor(row.first_m / row.texel_m));
  const LodRow<Texel> texels = field_->row(row.slice, first);
  const LodRow<glm::vec2> speeds = flow ? flow->row(row.slice, first) : LodRow<glm::vec2>{};
  bool any = false;
  ShorePart part;
  double of_divergence = 0.0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Texel& texel = texels[std::int64_t(i)];
    if (!(texel.waves.z > 0.0f)) continue;
    if (!any) {
      any = true;
      std::fill(moved.begin(), moved.end(), Moved{});
      part.filter = field.filter(row.texel_m);
      const int tile = field.curved_place().tile;
      of_divergence = double(tiles.texels(tile, WavePlane::moments, tiles.levels(tile) - 1)->w);
    }
    part.share = double(texel.waves.z);
    part.at.bent_m = glm::dvec2(texel.place);
    part.at.forward = glm::dvec2(texel.place.z, texel.place.w);
    part.at.stretch = texel.waves.x;
    part.at.turning_per_m = double(texel.waves.y);
    SeaSample sum;
    const glm::vec2 velocity = flow ? speeds[std::int64_t(i)] : glm::vec2(0.0f);
    if (glm::dot(velocity, velocity) < least_flow_mps * least_flow_mps) {
      part.add(field, tiles, sum);
    } else {
      for (const ShorePart& one : part.carried(field, velocity, phase)) one.add(field, tiles, sum);
    }
    const double squared = part.share * part.share;
    moved[i] = {sum.displacement,        sum.shift_gradient,         sum.divergence_moment,
                squared * of_divergence, squared * height_variance_, double(texel.waves.w)};
  }
  return any;
}

}  // namespace seascape
