#include "ocean/foam/foam.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "engine/error.h"
#include "engine/text.h"
#include "ocean/foam/foam_simd.h"

namespace seascape {

namespace {

void require(bool holds, double value, const char* name, const char* range) {
  if (!holds || !std::isfinite(value))
    throw Error(name, text_from(value) + " is not " + range, std::string("give a number ") + range);
}

// A row of a slice's window from its first texel on, and back to where it lies. `w`: that texel.
template <class T>
void take_row(const LodField<T>& field, int slice, LodIndex w, T* to) {
  const LodRow<T> row = field.row(slice, w);
  std::copy(row.texels + row.column, row.texels + row.side, to);
  std::copy(row.texels, row.texels + row.column, to + (row.side - row.column));
}
void put_row(LodField<float>& field, int slice, LodIndex w, const float* from) {
  const LodRow<float> row = field.row(slice, w);
  float* const texels = &field.texel(slice, w) - row.column;
  std::copy(from, from + (row.side - row.column), texels + row.column);
  std::copy(from + (row.side - row.column), from + row.side, texels);
}

}  // namespace

void validate(const FoamSettings& s) {
  validate(s.windows);
  require(s.rate_hz >= 1.0 && s.rate_hz <= 240.0, s.rate_hz, "rate_hz", "from 1 to 240");
  require(s.life_s >= 0.1 && s.life_s <= 1000.0, s.life_s, "life_s", "from 0.1 to 1000");
  require(s.breaking >= 0.0 && s.breaking <= 4.0, s.breaking, "breaking", "from 0 to 4");
  require(s.shore_m > 0.0 && s.shore_m <= 100.0, s.shore_m, "shore_m", "above 0, at most 100");
  require(s.shore_per_s >= 0.0 && s.shore_per_s <= 100.0, s.shore_per_s, "shore_per_s", "from 0 to 100");
  require(s.settle_s >= 0.0 && s.settle_s <= 60.0, s.settle_s, "settle_s", "from 0 to 60");
}

Foam::Foam(const FoamSettings& settings)
    : settings_(settings), field_(settings.windows, 0.0f, lod_placement(settings.windows, glm::dvec2(0.0), {})) {
  validate(settings);
}

void Foam::set_flow(Flow flow, bool still) {
  flow_ = std::move(flow);
  flow_still_ = still;
  speed_.reset();
  flows_ = false;
}

void Foam::fill(float covered) {
  for (int i = 0; i < field_.slices(); ++i) field_.each(i, [&](LodIndex w) { field_.texel(i, w) = covered; });
  foamy_ = covered > 0.0f ? (1u << field_.slices()) - 1u : 0u;
}

std::uint32_t Foam::follow(const LodPlacement& placement, float fresh) {
  const LodPlacement before = field_.placement();
  const std::uint32_t all = (1u << field_.slices()) - 1u;
  std::uint32_t changed = placement.scale.octave != before.scale.octave ? all : 0u;
  for (int i = 0; i < field_.slices(); ++i)
    if (placement.first[std::size_t(i)] != before.first[std::size_t(i)]) changed |= 1u << i;
  const double coarsest = lod_texel_m(settings_.windows, placement, field_.slices() - 1);
  field_.follow(placement,
                [&](glm::dvec2, double texel, float inherited) { return texel >= coarsest ? fresh : inherited; });
  if (changed != 0 && (any() || fresh > 0.0f)) foamy_ |= changed;
  if (flow_) {
    const auto speed = [&](glm::dvec2 at, double texel) {
      glm::vec2 v = flow_(at, texel);
      if (!(std::abs(v.x) + std::abs(v.y) < 1e4f)) v = glm::vec2(0.0f);
      flows_ = flows_ || v != glm::vec2(0.0f);
      return v;
    };
    if (!speed_ || !flow_still_) {
      flows_ = false;
      speed_.emplace(settings_.windows, glm::vec2(0.0f), placement);
      for (int i = 0; i < field_.slices(); ++i)
        speed_->each(i, [&](LodIndex w) { speed_->texel(i, w) = speed(speed_->middle(i, w), speed_->texel_m(i)); });
    } else {
      speed_->follow(placement, [&](glm::dvec2 at, double texel, glm::vec2) { return speed(at, texel); });
    }
  }
  return changed;
}

// What lies `at`, in texels from the slice's first, before the step: beyond its window, of the next coarser one.
float Foam::beyond(int slice, glm::dvec2 at) const {
  if (slice + 1 >= field_.slices()) return 0.0f;
  const glm::dvec2 place = (glm::dvec2(field_.first(slice)) + at + 0.5) * field_.texel_m(slice);
  const glm::dvec2 coarse = glm::floor(place / field_.texel_m(slice + 1) - 0.5),
                   begin(field_.first(slice + 1));  // of a long step no whole number has room for it
  const double last = double(field_.side() - 2);
  if (!(coarse.x >= begin.x && coarse.y >= begin.y && coarse.x <= begin.x + last && coarse.y <= begin.y + last))
    return 0.0f;
  return field_.bilinear(slice + 1, place);
}

void Foam::carry(int slice, double dt) {
  const LodIndex first = field_.first(slice);
  const std::int64_t side = field_.side();
  const std::size_t count = std::size_t(side);
  straight_.resize(count * count);
  for (std::int64_t z = 0; z < side; ++z) take_row(field_, slice, first + LodIndex(0, z), straight_.data() + z * side);
  // What cubics have below nothing is taken off what they have above, in the order of rows: the sum stays theirs.
  sums_.resize(count);
  tbb::parallel_for(std::int64_t(0), side, [&](std::int64_t z) {
    thread_local std::vector<glm::vec2> speeds, ways;
    thread_local std::vector<float> values, grow;
    thread_local std::vector<int> outside;
    speeds.resize(3 * (count + 2));
    ways.resize(count), values.resize(count), grow.resize(count), outside.resize(count);
    const auto speed = [&](std::int64_t by) { return speeds.data() + (by + 1) * (side + 2) + 1; };
    for (std::int64_t by = -1; by <= 1; ++by)
      take_row(*speed_, slice, first + LodIndex(0, std::clamp<std::int64_t>(z + by, 0, side - 1)), speed(by));
    const int left = carry_row(
        {straight_.data(), speed(-1), speed(0), speed(1), int(side), int(z), float(dt), float(field_.texel_m(slice))},
        values, grow, outside, ways);
    for (std::size_t n = 0; n < std::size_t(left); ++n)
      values[std::size_t(outside[n])] = beyond(slice, glm::dvec2(double(outside[n]), double(z)) + glm::dvec2(ways[n]));
    sums_[std::size_t(z)] = settle_row(values, grow, values);
    put_row(field_, slice, first + LodIndex(0, z), values.data());
  });
  glm::dvec2 sum(0.0);
  for (const glm::dvec2& row : sums_) sum += row;
  if (!(sum.x < 0.0 && sum.y > 0.0)) return;
  const float left = float(std::max(1.0 + sum.x / sum.y, 0.0));
  for (std::int64_t i = 0; i < side * side; ++i) field_.texels(slice)[i] *= left;
}

std::uint32_t Foam::step_slice(int slice, double dt, const Gain& gain) {
  const std::uint32_t bit = 1u << slice, had = foamy_ & bit;
  if (flows_ && (foamy_ & (bit | bit << 1)) != 0)
    carry(slice, dt);
  else if (had == 0 && !gain)
    return 0;
  const std::int64_t side = settings_.windows.resolution;
  const float loss = float(1.0 / settings_.life_s), lasting = float(std::exp(-dt / settings_.life_s));
  std::atomic<bool> foamy{false}, wrong{false};
  tbb::parallel_for(std::int64_t(0), side, [&](std::int64_t z) {
    const LodIndex w = field_.first(slice) + LodIndex(0, z);
    thread_local std::vector<float> gains, covered;
    gains.assign(std::size_t(side), 0.0f), covered.resize(std::size_t(side));
    if (gain) gain({slice, field_.texel_m(slice), field_.middle(slice, w)}, gains);
    take_row(field_, slice, w, covered.data());
    const SpentRow spent = spend_row(loss, float(dt), lasting, gains, covered);
    put_row(field_, slice, w, covered.data());
    if (spent.wrong) wrong.store(true, std::memory_order_relaxed);
    if (spent.holds) foamy.store(true, std::memory_order_relaxed);
  });
  foamy_ = (foamy_ & ~bit) | (foamy.load() ? bit : 0u);
  if (wrong.load()) fault_ = "foam: what was no share of the water was taken out";
  return had | (foamy_ & bit);
}

std::optional<std::string> Foam::take_fault() {
  if (fault_.empty()) return std::nullopt;
  return std::exchange(fault_, {});
}

}  // namespace seascape
