#include "ocean/places/lod_windows.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/require.h"

namespace seascape {

namespace {

constexpr double most_texels = 1125899906842624.0;  // 2^50: a half, a quarter and an eighth of a texel are still exact

bool reachable(const LodWindowSettings& settings, glm::dvec2 viewer) {
  return std::abs(viewer.x) <= most_texels * settings.texel_m &&
         std::abs(viewer.y) <= most_texels * settings.texel_m;  // no for NaN
}

double octaves_of(const LodWindowSettings& settings, double height_m) {
  if (!(height_m > settings.scale_height_m)) return 0.0;
  return std::min(std::log2(height_m / settings.scale_height_m), double(settings.most_octaves));
}

LodScale split(const LodWindowSettings& settings, double octaves) {
  const int octave = std::min(int(octaves), settings.most_octaves);
  return {octave, octaves - octave};
}

double wrapped(std::int64_t texel, int resolution) {
  const std::int64_t rest = texel % resolution;
  return double(rest < 0 ? rest + resolution : rest);
}

}  // namespace

void validate(const LodWindowSettings& s) {
  require(s.resolution >= 32 && s.resolution <= 2048 && s.resolution % 16 == 0, s.resolution, "resolution",
          "a multiple of 16 from 32 to 2048");
  require(s.slices >= 2 && s.slices <= gpu::max_lod_slices, s.slices, "slices", "from 2 to 16");
  require(s.texel_m >= 1e-3 && s.texel_m <= 1e6, s.texel_m, "texel_m", "from 0.001 to 1000000");
  require(s.scale_height_m > 0.0, s.scale_height_m, "scale_height_m", "above 0");
  require(s.most_octaves >= 0 && s.most_octaves <= 40, s.most_octaves, "most_octaves", "from 0 to 40");
  require(s.follow_s >= 0.0, s.follow_s, "follow_s", "0 or more");
}

LodScale lod_scale(const LodWindowSettings& settings, double height_m) {
  return split(settings, octaves_of(settings, height_m));
}

double lod_texel_m(const LodWindowSettings& settings, const LodPlacement& placement, int slice) {
  return std::ldexp(settings.texel_m, placement.scale.octave + slice);
}

LodPlacement lod_placement(const LodWindowSettings& settings, glm::dvec2 viewer, LodScale scale) {
  if (!reachable(settings, viewer))
    throw Error("viewer", text_from(viewer.x) + ", " + text_from(viewer.y) + " m is out of reach",
                "stay within 2^50 texels of the world's origin");
  LodPlacement result{scale, viewer, {}};
  for (int i = 0; i < settings.slices; ++i) {
    const double texel = lod_texel_m(settings, result, i);
    result.first[std::size_t(i)] = LodIndex(std::llround(viewer.x / texel), std::llround(viewer.y / texel)) -
                                   std::int64_t(settings.resolution / 2);
  }
  return result;
}

// Two texels less than half the window: half a one for the snapped middle, half a one for what is read between texels,
// one to spare.
glm::vec4 lod_reach(const LodWindowSettings& settings, const LodPlacement& placement) {
  const double texel = lod_texel_m(settings, placement, 0), reach = (settings.resolution / 2 - 2) * texel;
  return {float(reach), float(reach * std::exp2(settings.slices - 2 + placement.scale.blend)),
          float(placement.scale.blend), float(texel)};
}

gpu::LodWindows lod_windows(const LodWindowSettings& settings, const LodPlacement& placement, glm::dvec2 origin) {
  gpu::LodWindows result{};
  for (int i = 0; i < settings.slices; ++i) {
    const double texel = lod_texel_m(settings, placement, i), side = texel * settings.resolution;
    const glm::dvec2 cell = glm::floor(origin / texel), within = origin / texel - cell;
    const auto at = [&](double whole, double part) {
      return float((wrapped(std::int64_t(whole), settings.resolution) + part) / settings.resolution);
    };
    result.slice[i] = glm::vec4(at(cell.x, within.x), at(cell.y, within.y), float(1.0 / side), float(texel));
  }
  result.reach = lod_reach(settings, placement);
  result.viewer = glm::vec2(placement.viewer - origin);
  result.slices = settings.slices;
  result.first_layer = placement.scale.octave % settings.slices;
  return result;
}

LodViewer::LodViewer(const LodWindowSettings& settings) : settings_(settings) {
  validate(settings);
  placement_ = lod_placement(settings, {0.0, 0.0}, {});
}

const LodPlacement& LodViewer::follow(glm::dvec2 viewer, double height_m, double seconds) {
  if (!reachable(settings_, viewer) || !std::isfinite(height_m) || !(seconds >= 0.0)) return placement_;
  const double wanted = octaves_of(settings_, height_m);
  const bool jump = octaves_ < 0.0 || seconds > 1.0 || std::abs(wanted - octaves_) > 2.0 || settings_.follow_s == 0.0;
  octaves_ = jump ? wanted : octaves_ + (wanted - octaves_) * -std::expm1(-seconds / settings_.follow_s);
  placement_ = lod_placement(settings_, viewer, split(settings_, octaves_));
  return placement_;
}

}  // namespace seascape
