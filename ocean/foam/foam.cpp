#include "ocean/foam/foam.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {

void require(bool holds, double value, const char* name, const char* range) {
  if (!holds || !std::isfinite(value))
    throw Error(name, text_from(value) + " is not " + range, std::string("give a number ") + range);
}

// Less than this is none: half floats hold no less without loss, and processors are slow with much smaller numbers.
constexpr float least = 6.2e-5f;

// A slice by rows and columns of its window: without the divisions that texels by their number in the world cost.
template <class T>
struct SliceRows {
  T* texels;
  std::int64_t side, column, row;  // where the window begins
  SliceRows(T* first, std::int64_t side_, LodIndex begin)
      : texels(first), side(side_), column(((begin.x % side) + side) % side), row(((begin.y % side) + side) % side) {}
  T& operator()(std::int64_t x, std::int64_t z) const {
    const std::int64_t c = column + x, r = row + z;
    return texels[(r < side ? r : r - side) * side + (c < side ? c : c - side)];
  }
};

// Weights of four texels for a place a share f of the way from the second to the third (Catmull and Rom 1974).
glm::vec4 cubic(float f) {
  return 0.5f * glm::vec4(f * (f * (2.0f - f) - 1.0f), f * f * (3.0f * f - 5.0f) + 2.0f,
                          f * (f * (4.0f - 3.0f * f) + 1.0f), f * f * (f - 1.0f));
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
  before_.resize(std::size_t(settings.windows.resolution) * std::size_t(settings.windows.resolution));
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

void Foam::carry(int slice, double dt) {
  const LodIndex first = field_.first(slice);
  const double texel_m = field_.texel_m(slice);
  const std::int64_t side = settings_.windows.resolution;
  const SliceRows<float> to(field_.texels(slice), side, first);
  std::copy_n(std::as_const(field_).texels(slice), before_.size(), before_.begin());
  const SliceRows<const float> from(before_.data(), side, first);
  const SliceRows<const glm::vec2> speeds(std::as_const(*speed_).texels(slice), side, first);
  // What lies `way` texels from a texel, of before the step: of this slice, or beyond its window of the next coarser
  // one.
  const auto there = [&](std::int64_t x, std::int64_t z, glm::dvec2 way) {
    const glm::dvec2 at = glm::dvec2(double(x), double(z)) + way, cell = glm::floor(at);
    if (!(cell.x >= 1.0 && cell.y >= 1.0 && cell.x < double(side - 2) && cell.y < double(side - 2))) {
      if (slice + 1 >= field_.slices()) return 0.0f;
      const glm::dvec2 place = (glm::dvec2(first) + at + 0.5) * texel_m;
      const glm::dvec2 coarse = glm::floor(place / field_.texel_m(slice + 1) - 0.5),
                       begin(field_.first(slice + 1));  // of a long step no whole number has room for it
      const double last = double(side - 2);
      if (!(coarse.x >= begin.x && coarse.y >= begin.y && coarse.x <= begin.x + last && coarse.y <= begin.y + last))
        return 0.0f;
      return field_.bilinear(slice + 1, place);
    }
    const glm::vec4 along = cubic(float(at.x - cell.x)), across = cubic(float(at.y - cell.y));
    const std::int64_t i0 = std::int64_t(cell.x) - 1, j0 = std::int64_t(cell.y) - 1;
    float value = 0.0f;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) value += along[i] * across[j] * from(i0 + i, j0 + j);

    return value;
  };
  // What cubics have below nothing is taken off what they have above, in the order of rows: the sum stays theirs.
  std::vector<glm::dvec2> sums(std::size_t(side), glm::dvec2(0.0));
  tbb::parallel_for(std::int64_t(0), side, [&](std::int64_t z) {
    glm::dvec2& sum = sums[std::size_t(z)];
    for (std::int64_t x = 0; x < side; ++x) {
      const glm::dvec2 speed(speeds(x, z));
      double meets = 0.0;  // minus the flow's divergence, 1/s
      glm::dvec2 midway = speed;
      if (x > 0 && z > 0 && x + 1 < side && z + 1 < side) {
        const glm::dvec2 along_x(speeds(x + 1, z) - speeds(x - 1, z)), along_z(speeds(x, z + 1) - speeds(x, z - 1));
        meets = -(along_x.x + along_z.y) / (2.0 * texel_m);
        // The velocity half a step upstream, by its own slope here.
        const glm::dvec2 back = -0.5 * dt / (2.0 * texel_m) * speed;
        midway += back.x * along_x + back.y * along_z;
      }
      float value = to(x, z);
      if (midway != glm::dvec2(0.0)) value = there(x, z, -dt / texel_m * midway);
      if (meets != 0.0) value *= float(std::exp(std::clamp(meets * dt, -4.0, 4.0)));
      (value < 0.0f ? sum.x : sum.y) += double(value);
      to(x, z) = std::clamp(value, 0.0f, 1.0f);
    }
  });
  glm::dvec2 sum(0.0);
  for (const glm::dvec2& row : sums) sum += row;
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
    const SliceRows<float> rows(field_.texels(slice), side, field_.first(slice));
    thread_local std::vector<float> gains;
    gains.assign(std::size_t(side), 0.0f);
    if (gain) gain({slice, field_.texel_m(slice), field_.middle(slice, field_.first(slice) + LodIndex(0, z))}, gains);
    bool holds = false;
    for (std::int64_t x = 0; x < side; ++x) {
      float& f = rows(x, z);
      float g = gains[std::size_t(x)];
      if (!(g >= 0.0f && g < 1e6f && f >= 0.0f && f <= 1.0f)) {
        wrong.store(true, std::memory_order_relaxed);
        g = g >= 0.0f ? std::min(g, 1e6f) : 0.0f;
        f = f >= 0.0f ? std::min(f, 1.0f) : 0.0f;
      }
      if (g > 0.0f) {
        const float rate = g + loss, rest = g / rate;
        f = std::clamp(rest + (f - rest) * std::exp(-rate * float(dt)), 0.0f, 1.0f);
      } else {
        f *= lasting;
      }
      if (f < least) f = 0.0f;
      holds = holds || f > 0.0f;
    }
    if (holds) foamy.store(true, std::memory_order_relaxed);
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
