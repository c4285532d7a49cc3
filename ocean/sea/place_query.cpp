#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ocean/places/flow_phase.h"
#include "ocean/sea/place_query_simd.h"
#include "ocean/sea/place_sea.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {
// Puts numbers where a texel has them.
struct Texel {
  const PlaceNumbers& numbers;
  float* to;
  void put(int number, float value) const {
    if (numbers.at[std::size_t(number)] >= 0) to[numbers.at[std::size_t(number)]] = value;
  }
  void put(const BedTexel& ground) const {
    put(PlaceNumbers::bed, ground.bed.x);
    for (int i = 0; i < 3; ++i) put(PlaceNumbers::bend + i, ground.bed[i + 1]);
    put(PlaceNumbers::run_up, ground.more.z);
    for (int i = 0; i < 4; ++i) put(PlaceNumbers::share + i, ground.share[i]);
    put(PlaceNumbers::share + 4, ground.more.x);
    put(PlaceNumbers::others, ground.more.y);
  }
};
}  // namespace

PlaceNumbers PlaceSea::numbers() const {
  PlaceNumbers numbers;
  numbers.at.fill(-1);
  std::int8_t count = 0;
  const auto have = [&](int first, int end) {
    for (int number = first; number < end; ++number) numbers.at[std::size_t(number)] = count++;
  };
  if (level_) have(PlaceNumbers::level, PlaceNumbers::level + 1);
  if (flow_) have(PlaceNumbers::flow_x, PlaceNumbers::flow_z + 1);
  if (bed_) have(PlaceNumbers::bed, PlaceNumbers::share + cascades_);
  if (bed_ && has_others_) have(PlaceNumbers::others, PlaceNumbers::others + 1);
  if (along_curves_) have(PlaceNumbers::right, PlaceNumbers::count);
  numbers.vectors = (count + 3) / 4;
  if (numbers.vectors == 3) numbers.vectors = 4;  // whole cache lines
  return numbers;
}

void PlaceSea::renew() {
  pages_.reset();
  clip_pages_.reset();
  const auto time_of = [](const auto& values, double time) { return values->still ? 0.0 : time; };
  if (clip_)
    clip_pages_ = std::make_shared<PlacePages>(1, [clip = clip_](glm::dvec2 at, double texel, double time, float* to) {
      const glm::vec4 value = clip->value(at, texel, clip->still ? 0.0 : time);
      for (int i = 0; i < 4; ++i) to[i] = value[i];
    });
  const PlaceNumbers numbers = this->numbers();
  if (numbers.vectors == 0) return;
  pages_ = std::make_shared<PlacePages>(
      numbers.vectors, [=, level = level_, flow = flow_, bed = bed_, shore = along_curves_](
                           glm::dvec2 at, double texel_m, double time, float* to) {
        std::fill(to, to + 4 * numbers.vectors, 0.0f);
        const Texel texel{numbers, to};
        if (level) texel.put(PlaceNumbers::level, level->value(at, texel_m, time_of(level, time)).x);
        if (flow) {
          const glm::vec4 velocity = flow->value(at, texel_m, time_of(flow, time));
          texel.put(PlaceNumbers::flow_x, velocity.x);
          texel.put(PlaceNumbers::flow_z, velocity.y);
        }
        if (bed) texel.put(bed->value(at, texel_m, time_of(bed, time)));
        if (!shore) return;
        const ShoreTexel line = shore->value(at, texel_m, time_of(shore, time));
        const float along[] = {line.line.x, line.line.y, line.line.z, line.line.w, line.way.x, line.way.y};
        for (int i = 0; i < 6; ++i) texel.put(PlaceNumbers::right + i, along[i]);
      });
}

bool PlaceSea::flat_clipped(glm::dvec2 place, double texel, double time) const {
  if (!clip_pages_) return false;
  if (!(std::abs(place.x) + std::abs(place.y) < 0x1p40 * texel)) return false;
  const glm::dvec2 at = place / texel - 0.5, first = glm::floor(at);
  PlacePages::Own own;
  std::uint32_t slot = 0;
  const PlacePages::Cell cell = clip_pages_->cell(std::int64_t(first.x), std::int64_t(first.y), texel,
                                                  place_time_s(settings_, clip_->still, time), slot, own);
  return lod_bilinear(glm::vec2(at - first),
                      [&](LodIndex from) { return cell.first[from.x * cell.right + from.y * cell.below]; }) > 0.5f;
}

bool PlaceSea::clipped(glm::dvec3 point, bool flat, const ClipVolumes* volumes) const {
  if (volumes == nullptr) volumes = volumes_.get();
  return volumes == nullptr ? flat : volumes->clipped(point, flat);
}

bool PlaceSea::flat_clipped(glm::dvec2 at, double time, const ClipRead& read) const {
  if (read.seen != nullptr && clip_)
    return PlaceReader(*clip_, settings_, time)(place_reading(settings_.windows, at, 0.0, read.seen), at).x > 0.5f;
  return flat_clipped(at, read.texel_m > 0.0 ? read.texel_m : settings_.windows.texel_m, time);
}

bool PlaceSea::clipped(glm::dvec3 point, double time, const ClipRead& read) const {
  if (!clips() || !std::isfinite(point.x + point.z)) return false;
  return clipped(point, flat_clipped({point.x, point.z}, time, read), read.volumes);
}

bool PlaceSea::dry(glm::dvec2 rest, glm::dvec3 d, double time, const ClipRead& read) const {
  const bool flat = flat_clipped(rest, time, read);
  const ClipVolumes* const volumes = read.volumes != nullptr ? read.volumes : volumes_.get();
  return volumes == nullptr ? flat : volumes->dry({rest.x + d.x, d.y, rest.y + d.z}, flat);
}

namespace {
// The layers of one place as a bed and a current have them: once, or once for each of two patterns.
void place_layers(PlacePlan& plan, const QueryLayer& layer, PlacedLayer placed, const WaveField::Place& place) {
  placed.decay = glm::vec3(0.25 * plan.period_s * plan.period_s * place.decay_per_m2);
  placed.laid = layer.share * layer.laid[0];
  for (int pattern = plan.flow ? 0 : -1; pattern <= (plan.flow ? 1 : -1); ++pattern) {
    placed.pattern = std::int8_t(pattern);
    const auto at = std::size_t(plan.waves.count++);
    plan.waves.layers[at] = layer;
    plan.placed[at] = placed;
  }
}

// A level of dynamic waves as a query reads it.
QueryLayer dynamic_layer(const DynamicSurface& dynamic, int level) {
  const double texel = dynamic.texel_m(level);
  const int size = dynamic.samples();
  QueryLayer layer{};
  layer.cosine = 1.0;
  layer.inverse_side = 1.0 / (texel * size);
  layer.size = size;
  layer.first = size - 0.5;
  layer.cosine_a_texel = float(1.0 / texel);
  layer.mask = size - 1;
  layer.stride = size;
  layer.share = 1.0f;
  layer.shift = &dynamic.shift(level).data()->x;
  layer.velocity = dynamic.has_velocity() ? &dynamic.velocity(level).data()->x : nullptr;
  return layer;
}

void place_dynamic(PlacePlan& plan, const DynamicSurface& dynamic, double footprint_m) {
  const gpu::LodWindows windows = dynamic.windows(plan.viewer);
  for (int i = 0; i < dynamic.levels(); ++i) {
    const double kept = DynamicSurface::kept(footprint_m, dynamic.texel_m(i));
    if (dynamic.still(i) || !(kept > 0.0)) continue;
    const auto at = std::size_t(plan.waves.count++);
    const float end = std::min(windows.reach.x * float(1 << i), windows.reach.y);
    plan.placed[at] = {.kind = PlacedLayer::dynamic,
                       .share = 0,
                       .bent = -1,
                       .runs_up = false,
                       .even = dynamic.share() == 1.0,
                       .pattern = -1,
                       .decay = glm::vec3(0.0f),
                       .laid = 1.0f,
                       .end_m = end,
                       .per_border = 1.0f / (gpu::lod_border * end),
                       .counts = float(kept * (i == 0 ? 1.0 - double(windows.reach.z) : 1.0)),
                       .sharpened = float(dynamic.share())};
    plan.waves.layers[at] = dynamic_layer(dynamic, i);
  }
}

// All windows but that of the body `without`.
void place_wakes(PlacePlan& plan, const WakeSurface& wakes, double footprint_m, std::uint64_t without) {
  std::array<const WakeSurface::Part*, gpu::max_wake_windows> parts;
  for (const WakeSurface::Part& part : wakes.parts()) {
    if (without != 0 && part.body == without) continue;
    const auto window = std::size_t(plan.wakes.count++);
    parts[window] = &part;
    plan.wakes.middle_m[window] = part.middle_m[0];
    for (std::size_t i = 0; i < part.middle_m.size(); ++i)
      plan.wakes.from_middle_m[window][i] = glm::vec2(part.middle_m[i] - part.middle_m[0]);
    plan.wakes.presence[window] = float(part.presence);
  }
  for (int i = 0; i < wakes.levels(); ++i)
    for (int window = 0; window < plan.wakes.count; ++window) {
      const DynamicSurface& surface = parts[std::size_t(window)]->surface;
      const double kept = DynamicSurface::kept(footprint_m, surface.texel_m(i));
      if (surface.still(i) || !(kept > 0.0)) continue;
      const auto at = std::size_t(plan.waves.count++);
      plan.placed[at] = {.kind = PlacedLayer::wake,
                         .share = std::int8_t(window),
                         .bent = std::int8_t(i),
                         .runs_up = false,
                         .even = wakes.share() == 1.0,
                         .pattern = -1,
                         .decay = glm::vec3(0.0f),
                         .laid = 1.0f,
                         .end_m = float(wakes.half_m(i)),
                         .per_border = 0.0f,
                         .counts = float(kept),
                         .sharpened = float(wakes.share())};
      plan.waves.layers[at] = dynamic_layer(surface, i);
    }
}
}  // namespace

PlacePlan PlaceSea::plan(const WaveField& field, const WaveTiles& tiles, const QueryOptions& options,
                         const Beside& beside) const {
  PlacePlan plan;
  const QueryPlan waves = plan_queries(field, tiles, options, along_curves_.has_value());
  plan.waves.most_iterations = waves.most_iterations;
  plan.waves.tolerance_m = waves.tolerance_m;
  plan.waves.velocity = waves.velocity;
  plan.waves.slopes = waves.slopes;
  plan.waves.depth_m = waves.depth_m;
  plan.waves.warp = waves.warp;
  plan.waves.left_out_m = beside.left_out_m;
  plan.places = this;
  plan.pages = pages_.get();
  plan.numbers = numbers();
  plan.bed = bed_.has_value();
  plan.shore = along_curves_.has_value();
  plan.flow = flow_.has_value();
  plan.dries = plan.bed && clips();
  plan.time_s = double(tiles.ticks()) / double(gpu::ticks_per_second);
  plan.period_s = settings_.flow_period_s;
  plan.phase = flow_phase(plan.time_s, plan.period_s);
  const bool still = (!level_ || level_->still) && (!flow_ || flow_->still) && (!bed_ || bed_->still) &&
                     (!along_curves_ || along_curves_->still);
  plan.place_time_s = place_time_s(settings_, still, plan.time_s);
  LodWindowSettings windows = settings_.windows;
  if (beside.finest_m > 0.0) windows.texel_m = beside.finest_m, windows.slices = gpu::max_lod_slices;
  plan.reading = place_reading(windows, glm::dvec2(0.0), options.footprint_m, nullptr);
  plan.clip = {plan.reading.texel_m, beside.volumes, options.seen};
  if (options.seen != nullptr) {
    plan.seen = options.seen;
    plan.reading.texel_m = lod_texel_m(settings_.windows, *options.seen, 0);
    plan.reach = lod_reach(settings_.windows, *options.seen);
    plan.slices = settings_.windows.slices;
    plan.footprint_m = float(options.footprint_m);
    const Texel outside{plan.numbers, plan.outside.data()};
    if (level_) outside.put(PlaceNumbers::level, level_->outside.x);
    if (flow_) outside.put(PlaceNumbers::flow_x, flow_->outside.x), outside.put(PlaceNumbers::flow_z, flow_->outside.y);
    if (bed_) outside.put(bed_->outside);
    for (int number = 0; number < PlaceNumbers::count; ++number)
      if (const int at = plan.numbers.at[std::size_t(number)]; at >= 0)
        plan.fades[std::size_t(at)] = number < PlaceNumbers::right || number == PlaceNumbers::shore_share;
  }
  for (int i = 0; plan.bed && i < 3; ++i) plan.along[std::size_t(i)] = shallows_.direction(i);
  if (plan.shore) plan.shore_period_m = float(shore_->period_m());
  const int cascades = field.quality().cascades;
  assert(cascades <= cascades_ && (has_others_ || field.places().size() <= std::size_t(cascades)));
  for (int l = 0; l < waves.count; ++l) {
    const QueryLayer& layer = waves.layers[std::size_t(l)];
    const int place = waves.place[std::size_t(l)];
    if (std::size_t(place) == field.curved()) continue;
    const bool cascade = place < cascades;
    place_layers(plan, layer,
                 {.kind = PlacedLayer::waves,
                  .share = std::int8_t(cascade ? place : gpu::max_cascades),
                  .bent = std::int8_t(cascade && place < Refraction::bent_cascades ? place : -1),
                  .runs_up = cascade && place < Shallows::swash_cascades,
                  .even = !plan.bed || !cascade || place >= Shallows::swash_cascades},
                 field.places()[std::size_t(place)]);
  }
  if (beside.dynamic != nullptr) {
    plan.viewer = beside.dynamic->viewer();
    place_dynamic(plan, *beside.dynamic, options.footprint_m);
  }
  if (beside.wakes != nullptr) place_wakes(plan, *beside.wakes, options.footprint_m, options.without_window_of);
  plan.curved = plan.waves.count;
  if (!plan.shore) return plan;
  const WaveField::Place& place = field.curved_place();
  for (int l = 0; l < waves.count; ++l) {
    if (std::size_t(waves.place[std::size_t(l)]) != field.curved()) continue;
    QueryLayer layer = waves.layers[std::size_t(l)];
    layer.cosine = layer.sine = 0.0;  // its pattern lies where the curve has it
    place_layers(plan, layer, {.kind = PlacedLayer::curved, .share = 0, .bent = -1, .runs_up = false, .even = true},
                 place);
  }
  return plan;
}

SeaSample PlaceSea::at(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest, const QueryOptions& options,
                       const Beside& beside) const {
  QueryOptions once = options;
  once.fields = query_slopes;
  return placed_sample(plan(field, tiles, once, beside), rest);
}

void PlaceSea::query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places,
                     std::span<QueryAnswer> answers, const QueryOptions& options, const Beside& beside) const {
  constexpr std::size_t block = 512;
  assert(places.size() == answers.size());
  const auto for_blocks = [&](const auto& answer) {
    if (places.size() < 2 * block) return answer(std::size_t{0}, places.size());
    tbb::parallel_for(std::size_t{0}, (places.size() + block - 1) / block,
                      [&](std::size_t n) { answer(n * block, std::min(block, places.size() - n * block)); });
  };
  if (!moves() && beside.dynamic == nullptr && beside.wakes == nullptr) {
    seascape::query(field, tiles, places, answers, options, beside.left_out_m);
  } else {
    const PlacePlan plan = this->plan(field, tiles, options, beside);
    const QueryAnswer* previous = options.previous.empty() ? nullptr : options.previous.data();
    for_blocks([&](std::size_t first, std::size_t count) {
      answer_placed_points(plan, places.data() + first, previous ? previous + first : nullptr, answers.data() + first,
                           count);
    });
  }
  if (!clips() || (options.fields & query_clip) == 0) return;
  const double time_s = double(tiles.ticks()) / double(gpu::ticks_per_second);
  for_blocks([&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i)
      answers[i].clipped = clipped({places[i].x, answers[i].height_m, places[i].y}, time_s,
                                   {.texel_m = beside.finest_m, .volumes = beside.volumes, .seen = options.seen});
  });
}

}  // namespace seascape
