#include "ocean/foam/foam_shore.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ocean/places/place_fields.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {
// Slower than this, water stands (breaking.cpp).
constexpr float least_flow_mps = 0.02f;

std::shared_ptr<const TileSource> curved_source(const WaveField& field) {
  for (const auto& source : field.others())
    if (source->along_curves()) return source;
  return nullptr;
}
}  // namespace

FoamShore::FoamShore(std::shared_ptr<const ShoreLines> lines, const LodWindowSettings& windows, const WaveField& field)
    : lines_(std::move(lines)), windows_(windows) {
  source_ = curved_source(field);
  if (source_ == nullptr) return;
  height_variance_ = source_->statistics().height_variance;
  largest_shift_m_ = source_->statistics().largest_shift_m;
}

bool FoamShore::is_of(const std::shared_ptr<const ShoreLines>& lines, const WaveField& field) const {
  return lines == lines_ && curved_source(field) == source_;
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
  return {{glm::vec4(glm::dvec4(at.bent_m.x - period * std::floor(at.bent_m.x / period), at.bent_m.y, at.forward)),
           glm::vec4(at.stretch, float(at.turning_per_m), float(share), float(surf))}};
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

ShorePattern FoamShore::pattern(double footprint, const WaveField& field, const WaveTiles& tiles) const {
  const WaveField::Place& place = field.curved_place();
  const WaveField::Filter filter = field.filter(footprint);
  const std::size_t at = field.curved();
  const int tile = place.tile, last = tiles.levels(tile) - 1;
  ShorePattern result{};
  result.size = float(place.size);
  result.kept = filter.level[at] >= last ? 0.0f : std::max(filter.share[at], 0.0f);
  result.whole_moment = tiles.texels(tile, WavePlane::moments, last)->w;
  result.decay_per_m2 = glm::vec3(place.decay_per_m2);
  result.least_flow_mps = least_flow_mps;
  for (int step = 0; result.kept > 0.0f && step < (filter.between[at] > 0.0f ? 2 : 1); ++step) {
    const int level = filter.level[at] + step, size = tiles.layout().level(tile, level).size;
    const double texels = place.inverse_side * size;
    result.levels[result.count++] = {tiles.texels(tile, WavePlane::shift, level),
                                     tiles.texels(tile, WavePlane::slope, level),
                                     tiles.texels(tile, WavePlane::moments, level),
                                     size - 1,
                                     tiles.stride(tile, level),
                                     float(place.cosine * texels),
                                     float(place.sine * texels),
                                     float((0.5 / tiles.samples(tile) + place.offset) * size - 0.5),
                                     step == 0 ? 1.0f - filter.between[at] : filter.between[at]};
  }
  return result;
}

bool FoamShore::row(const FoamRow& row, const WaveField& field, const WaveTiles& tiles, const LodField<glm::vec2>* flow,
                    const FlowPhase& phase, std::span<Moved> moved) const {
  const LodIndex first(glm::floor(row.first_m / row.texel_m));
  const LodRow<Texel> texels = field_->row(row.slice, first);
  const LodRow<glm::vec2> speeds = flow ? flow->row(row.slice, first) : LodRow<glm::vec2>{};
  std::array<ShoreTexelPlace, shore_group> group;
  std::array<glm::vec2, shore_group> velocity;
  std::array<ShoreMoved, shore_group> result;
  std::optional<ShorePattern> pattern;
  for (std::size_t from = 0; from < moved.size(); from += shore_group) {
    bool any = false;
    for (std::size_t i = 0; i < shore_group; ++i) {
      group[i] = texels[std::int64_t(from + i)];
      any = any || group[i].waves.z > 0.0f;
      if (flow) velocity[i] = speeds[std::int64_t(from + i)];
    }
    if (!any) continue;
    if (!pattern) {
      pattern = this->pattern(row.texel_m, field, tiles);
      std::fill(moved.begin(), moved.end(), Moved{});
    }
    shore_moved(*pattern, phase, group.data(), flow ? velocity.data() : nullptr, result.data());
    for (std::size_t i = 0; i < shore_group; ++i) {
      const double share = double(group[i].waves.z), squared = share * share;
      if (!(share > 0.0)) continue;
      const ShoreMoved& m = result[i];
      moved[from + i] = {{m.x, m.y, m.z},
                         {m.xx, m.zz, m.xz},
                         double(m.variance),
                         squared * double(pattern->whole_moment),
                         squared * height_variance_,
                         double(group[i].waves.w)};
    }
  }
  return pattern.has_value();
}

}  // namespace seascape
