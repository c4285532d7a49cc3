#include "ocean/sea/query.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ocean/sea/query_simd.h"
#include "ocean/waves/tile_sampler_simd.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

QueryPlan plan_queries(const WaveField& field, const WaveTiles& tiles, const QueryOptions& options, bool curved) {
  const WaveField::Filter filter = field.filter(options.footprint_m);
  QueryPlan plan;
  plan.most_iterations = options.most_iterations;
  // The nearest float that is no larger: what is within the one is within the other.
  plan.tolerance_m = float(options.tolerance_m);
  if (double(plan.tolerance_m) > options.tolerance_m) plan.tolerance_m = std::nextafter(plan.tolerance_m, -1.0f);
  plan.velocity = tiles.has_velocity() && (options.fields & query_velocity) != 0;
  plan.slopes = plan.velocity || (options.fields & query_slopes) != 0;
  plan.depth_m = field.state().depth_m;
  if (field.warp()) plan.warp = &field.warp();
  const std::size_t places = field.curved() + (curved && field.has_curved() ? 1 : 0);
  for (std::size_t c = 0; c < places; ++c) {
    const WaveField::Place& place = c == field.curved() ? field.curved_place() : field.places()[c];
    const int i = place.tile;
    if (filter.level[c] >= tiles.levels(i) - 1 || filter.share[c] <= 0.0f) continue;
    for (int step = 0; step < (filter.between[c] > 0.0f ? 2 : 1); ++step) {
      const int level = filter.level[c] + step, size = tiles.samples(i) >> level;
      const auto plane = [&](WavePlane p) { return &tiles.texels(i, p, level)->x; };
      plan.place[std::size_t(plan.count)] = std::int8_t(c);
      QueryLayer& layer = plan.layers[std::size_t(plan.count++)];
      layer.cosine = place.cosine;
      layer.sine = place.sine;
      layer.inverse_side = place.inverse_side;
      layer.size = size;
      layer.first = first_texel(level, size, place.offset);
      layer.cosine_a_texel = float(place.cosine * place.inverse_side * size);
      layer.sine_a_texel = float(place.sine * place.inverse_side * size);
      layer.mask = size - 1;
      layer.stride = tiles.stride(i, level);
      layer.share = filter.share[c] * (step == 0 ? 1.0f - filter.between[c] : filter.between[c]);
      const float laid = float(place.size);
      layer.laid = {laid, laid, laid, 1.0f};
      layer.plain = laid == 1.0f;
      layer.warped = c == 0 && plan.warp != nullptr;
      layer.shift = plane(WavePlane::shift);
      layer.velocity = plan.velocity ? plane(WavePlane::velocity) : nullptr;
    }
  }
  return plan;
}

void query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places,
           std::span<QueryAnswer> answers, const QueryOptions& options, double left_out_m) {
  constexpr std::size_t block = 1024;  // points that a core takes at a time: some 0.1 ms
  assert(places.size() == answers.size());
  assert(options.previous.empty() || options.previous.size() == places.size());
  QueryPlan plan = plan_queries(field, tiles, options);
  plan.left_out_m = left_out_m;
  const QueryAnswer* previous = options.previous.empty() ? nullptr : options.previous.data();
  const auto answer = [&](std::size_t first, std::size_t count) {
    answer_points(plan, places.data() + first, previous ? previous + first : nullptr, answers.data() + first, count);
  };
  if (places.size() < 2 * block) return answer(0, places.size());
  tbb::parallel_for(std::size_t{0}, (places.size() + block - 1) / block,
                    [&](std::size_t i) { answer(i * block, std::min(block, places.size() - i * block)); });
}

}  // namespace seascape
