#include "ocean/waves/pattern_warp.h"

#include <cmath>
#include <numbers>

#include "shaders/shared/phase.h"

namespace seascape {

namespace {
// A wave of the warp in the tile's own axes: its wave vector, the direction that it shifts in, its strain and its
// phase.
struct Shape {
  bool by_side;  // the wave vector is in turns a side; else in turns in 10 km
  glm::dvec2 along;
  double towards_deg, strain, phase;
};
// Two as long as two to three sides make copies next to each other unlike each other. Two of 10.6 km at every side keep
// all copies within 4 km apart: they never come round in it.
constexpr Shape shapes[gpu::warp_waves] = {{true, {0.30797, 0.19657}, 17.7, 0.03391, 0.137},
                                           {true, {-0.20379, 0.31344}, 143.4, 0.03766, 0.391},
                                           {false, {-0.93104, -0.15908}, 54.5, 0.01699, 0.04},
                                           {false, {0.08615, 0.94087}, 96.5, 0.01859, 0.97}};
}  // namespace

PatternWarp::PatternWarp(const Ladder& ladder) : warped_(ladder[0].warped) {
  if (!warped_) return;
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const Shape& shape = shapes[i];
    const double rotation = ladder[0].rotation_rad, towards = shape.towards_deg * std::numbers::pi / 180.0;
    const glm::dvec2 along = rotate_xz(shape.along / (shape.by_side ? ladder[0].side_m : 10e3), rotation);
    const double way = shape.strain / (2.0 * std::numbers::pi * glm::length(along));
    waves_[i] = {along, way * rotate_xz({std::cos(towards), std::sin(towards)}, rotation), shape.phase};
  }
}

PatternWarp::Local PatternWarp::at(glm::dvec2 rest) const {
  Local warp;
  for (const Wave& wave : waves_) {
    const glm::dvec2 turn(
        gpu::cos_sin_turns(gpu::warp_turns(wave.along.x, wave.along.y, wave.phase, rest.x, rest.y)));  // cosine, sine
    warp.shift_m += turn.y * wave.way;
    for (int by = 0; by < 2; ++by)
      for (int of = 0; of < 2; ++of) warp.growth[by][of] += gpu::warp_growth(wave.way[of], wave.along[by], turn.x);
  }
  return warp;
}

glm::dvec3 PatternWarp::Local::of_moments(const glm::dvec3& m) const {
  const glm::dmat2 warped = glm::dmat2(1.0) + growth;
  const glm::dmat2 result = glm::transpose(warped) * glm::dmat2(m.x, m.z, m.z, m.y) * warped;
  return {result[0][0], result[1][1], result[0][1]};
}

gpu::WarpData PatternWarp::from(glm::dvec2 origin) const {
  gpu::WarpData data{};
  for (int i = 0; i < gpu::warp_waves; ++i) {
    const Wave& wave = waves_[std::size_t(i)];
    const double turns = glm::dot(wave.along, origin) + wave.phase;
    data.wave[i] = glm::vec4(glm::dvec4(wave.along, wave.way));
    data.phase[i] = float(turns - std::floor(turns));
  }
  return data;
}

}  // namespace seascape
