#include "ocean/places/dynamic_waves.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/require.h"

namespace seascape {

namespace {

void require(const WaveSource& s, std::size_t index) {
  const double all =
      s.place_m.x + s.place_m.y + s.velocity_mps.x + s.velocity_mps.y + s.length_m + s.head_m + s.rise_mps + s.depth_m;
  const std::string name = "source " + std::to_string(index);
  if (!std::isfinite(all)) throw Error(name, "has a number that is not finite", "push the water with finite numbers");
  if (!(s.length_m > 0.0))
    throw Error(name, "its length of " + text_from(s.length_m) + " m is not above 0", "give a length above 0");
}

bool pushes(const WaveSource& s) { return s.head_m != 0.0 || s.rise_mps != 0.0; }

constexpr double border_power = 2.0, border_exponent = 3.0;

double taper(double texels, double width) {
  const double x = std::clamp(texels / width, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

std::size_t wrapped(std::int64_t texel, int n) { return std::size_t(texel & (n - 1)); }

// What is left of the time owed when `due` steps of it are done: less than a step. Of a very long time rounding leaves
// any number; then none is left.
double left_of(double owed_s, double due, double dt) {
  const double left = owed_s - due * dt;
  return left >= -1e-6 * dt && left < dt ? left : 0.0;
}

}  // namespace

void validate(const DynamicWavesSettings& s) {
  validate(s.windows);
  const int n = s.windows.resolution;
  require(n >= 64 && n <= 1024 && std::has_single_bit(unsigned(n)), n, "resolution", "a power of two from 64 to 1024");
  require(s.rate_hz >= 10.0 && s.rate_hz <= 1000.0, s.rate_hz, "rate_hz", "from 10 to 1000");
  require(s.damping_per_s >= 0.0, s.damping_per_s, "damping_per_s", "0 or more");
  require(s.gravity_mps2 > 0.0, s.gravity_mps2, "gravity_mps2", "above 0");
  require(true, s.depth_m, "depth_m", "finite");
  require(s.idle_m >= 0.0, s.idle_m, "idle_m", "0 or more");
  require(s.sharpening >= 0.0 && s.sharpening <= 2.0, s.sharpening, "sharpening", "from 0 to 2");
  require(s.most_steps >= 1, s.most_steps, "most_steps", "1 or more");
}

DynamicWaves::DynamicWaves(const DynamicWavesSettings& settings) : settings_(settings) {
  validate(settings);
  const int count = settings.windows.slices, n = settings.windows.resolution;
  placement_ = lod_placement(settings.windows, {0.0, 0.0}, {});
  levels_.assign(std::size_t(count), WaveLevel(n));
  depth_m_.assign(std::size_t(count), settings.depth_m);
  axes_.assign(std::size_t(count), {std::vector<float>(std::size_t(n)), std::vector<float>(std::size_t(n))});
  for (int i = 0; i < count; ++i) shape(i);
}

void DynamicWaves::apply(const DynamicWavesSettings& settings) {
  validate(settings);
  assert(settings.windows == settings_.windows && settings.gravity_mps2 == settings_.gravity_mps2 &&
         settings.depth_m == settings_.depth_m);
  settings_ = settings;
}

void DynamicWaves::shape(int i) {
  levels_[std::size_t(i)].shape(lod_texel_m(settings_.windows, placement_, i), i + 1 == levels(),
                                settings_.gravity_mps2, depth_m_[std::size_t(i)]);
}

void DynamicWaves::set_depth(int i, double depth_m) {
  require(true, depth_m, "depth_m", "finite");
  if (depth_m == depth_m_.at(std::size_t(i))) return;
  depth_m_[std::size_t(i)] = depth_m;
  shape(i);
  if (!(depth_m > 0.0)) levels_[std::size_t(i)].clear();
}

void DynamicWaves::set_obstacles(Openness openness) {
  openness_ = std::move(openness);
  open_.reset();
  if (!openness_) return;
  open_.emplace(settings_.windows, 1.0f, placement_);
  for (int i = 0; i < levels(); ++i)
    open_->each(i, [&](LodIndex w) {
      open_->texel(i, w) = std::clamp(openness_(open_->middle(i, w), open_->texel_m(i)), 0.0f, 1.0f);
    });
}

// What an axis of the border leaves after dt: absorption rises with the square of the way into it; a wave that runs all
// the way in at the speed falls to exp(-3) of its amplitude, and again on the way out on the other side.
void DynamicWaves::border(int i, double dt, double speed) {
  const int n = settings_.windows.resolution;
  const double width = n / 8.0,
               strength = border_exponent * (border_power + 1.0) * speed / (width * levels_[std::size_t(i)].texel_m());
  for (int e = 0; e < n; ++e) {
    const double inside = std::min(e + 0.5, n - e - 0.5);
    const float left = float(std::exp(-dt * strength * std::pow(std::max(1.0 - inside / width, 0.0), border_power)));
    const LodIndex first = placement_.first[std::size_t(i)];
    axes_[std::size_t(i)].x[wrapped(first.x + e, n)] = left;
    axes_[std::size_t(i)].z[wrapped(first.y + e, n)] = left;
  }
}

void DynamicWaves::place(const LodPlacement& next, double seconds) {
  const int n = settings_.windows.resolution;
  if (placed_ && seconds > 0.0) viewer_speed_ = glm::length(next.viewer - placement_.viewer) / seconds;
  if (next.scale.octave != placement_.scale.octave) turn_octaves(next.scale.octave - placement_.scale.octave);
  const LodPlacement before = placement_;
  placement_ = next;
  placed_ = true;
  if (open_)
    open_->follow(next,
                  [&](glm::dvec2 at, double texel, float) { return std::clamp(openness_(at, texel), 0.0f, 1.0f); });
  // A window that jumps farther than the border can swallow keeps what both places have.
  for (int i = 0; i < levels(); ++i) {
    const LodIndex was = before.first[std::size_t(i)], is = next.first[std::size_t(i)];
    if (std::max(std::abs(is.x - was.x), std::abs(is.y - was.y)) <= n / 16) continue;
    const double width = n / 8.0;
    for (int axis = 0; axis < 2; ++axis)
      for (int e = 0; e < n; ++e) {
        const std::int64_t w = is[axis] + e, old = w - was[axis];
        const double both = old < 0 || old >= n ? 0.0
                                                : taper(std::min(e + 0.5, n - e - 0.5), width) *
                                                      taper(std::min(double(old) + 0.5, n - double(old) - 0.5), width);
        (axis == 0 ? axes_[std::size_t(i)].x : axes_[std::size_t(i)].z)[wrapped(w, n)] = float(both);
      }
    levels_[std::size_t(i)].take_off(axes_[std::size_t(i)].x, axes_[std::size_t(i)].z, nullptr);
  }
}

// Slices and levels go on by their octave. Waves whose share moves from the coarsest level of before to that of now
// move with it, where both windows lie.
void DynamicWaves::turn_octaves(int octaves) {
  const int direction = octaves > 0 ? 1 : -1, last = levels() - 1;
  for (; octaves != 0; octaves -= direction) {
    const LodPlacement before = placement_;
    placement_ = lod_placement(settings_.windows, placement_.viewer, {placement_.scale.octave + direction, 0.0});
    const WaveLevel was = levels_.back();
    if (direction > 0) {
      std::rotate(levels_.begin(), levels_.begin() + 1, levels_.end());
      std::rotate(depth_m_.begin(), depth_m_.begin() + 1, depth_m_.end());
      depth_m_.back() = depth_m_[std::size_t(last - 1)];
    } else {
      std::rotate(levels_.begin(), levels_.end() - 1, levels_.end());
      std::rotate(depth_m_.begin(), depth_m_.end() - 1, depth_m_.end());
      depth_m_.front() = depth_m_[1];
    }
    (direction > 0 ? levels_.back() : levels_.front()).clear();
    for (int i = 0; i <= last; ++i) shape(i);
    if (was.still()) continue;
    if (direction > 0)
      hand_up(was, before.first[std::size_t(last)]);
    else
      hand_down(was, placement_.first[std::size_t(last)]);
  }
}

// From the level that was coarsest and is now the last but one, what is longer than it still carries, to the new
// coarsest.
void DynamicWaves::hand_up(const WaveLevel& was, LodIndex first) {
  const int n = was.samples();
  WaveLevel &finer = levels_[levels_.size() - 2], longer = was;
  for (std::size_t i = 0; i < was.modes().size(); ++i) {
    if (!(was.share()[i] > 0.0)) continue;
    const double kept = std::min(finer.share()[i] / was.share()[i], 1.0);
    finer.modes()[i] = kept * was.modes()[i];
    longer.modes()[i] = (1.0 - kept) * was.modes()[i];
  }
  // The middle of a coarse texel lies between two fine ones.
  longer.shift_by({0.5, 0.5});
  const std::size_t texels = std::size_t(n) * std::size_t(n);
  std::vector<float> from_h(texels), from_q(texels), h(texels, 0.0f), q(texels, 0.0f);
  longer.surface(from_h, from_q);
  for (std::int64_t z = first.y / 2; z < first.y / 2 + n / 2; ++z)
    for (std::int64_t x = first.x / 2; x < first.x / 2 + n / 2; ++x) {
      const std::size_t to = wrapped(z, n) * std::size_t(n) + wrapped(x, n),
                        from = wrapped(2 * z, n) * std::size_t(n) + wrapped(2 * x, n);
      h[to] = from_h[from], q[to] = from_q[from];
    }
  levels_.back().add(h, q);
}

// From the level that was coarsest and is no more, what the coarsest of now carries beyond what it did, in its window.
void DynamicWaves::hand_down(const WaveLevel& was, LodIndex first) {
  const int n = was.samples();
  WaveLevel& finer = levels_.back();
  const std::size_t texels = std::size_t(n) * std::size_t(n);
  std::vector<float> from_h(texels), from_q(texels), h(texels, 0.0f), q(texels, 0.0f);
  for (int parity = 0; parity < 4; ++parity) {
    WaveLevel part = was;
    const int band = n / 4;
    for (std::size_t i = 0; i < part.modes().size(); ++i) {
      const double m = std::hypot(double(int(i) % band - band / 2), double(int(i) / band - band / 2));
      const double share = was.share()[i],
                   extra = m > 0.0 ? wave_share(2.0 * n / m, true, n) - wave_share(2.0 * n / m, false, n) : 0.0;
      part.modes()[i] *= share > 0.0 ? std::min(extra / share, 1.0) : 0.0;
    }
    // Fine texel 2 V + p has its middle a quarter of a coarse one before or after that of V.
    part.shift_by({(parity & 1) != 0 ? 0.25 : -0.25, (parity >> 1) != 0 ? 0.25 : -0.25});
    part.surface(from_h, from_q);
    for (std::int64_t z = first.y; z < first.y + n; ++z)
      for (std::int64_t x = first.x; x < first.x + n; ++x) {
        if ((x & 1) != (parity & 1) || (z & 1) != (parity >> 1)) continue;
        const std::size_t to = wrapped(z, n) * std::size_t(n) + wrapped(x, n),
                          from = wrapped(z >> 1, n) * std::size_t(n) + wrapped(x >> 1, n);
        const float edge = float(taper(std::min(double(x - first.x), double(first.x + n - 1 - x)), n / 8.0) *
                                 taper(std::min(double(z - first.y), double(first.y + n - 1 - z)), n / 8.0));
        h[to] = edge * from_h[from], q[to] = edge * from_q[from];
      }
  }
  finer.add(h, q);
}

// Gives whether anything pushes. Every square of two by two texels has the pressure of its middle.
bool DynamicWaves::press(const LodPlacement& placement, const Pressure& pressure, const InputBounds& where) {
  heads_.resize(levels_.size());
  for (std::vector<float>& heads : heads_) heads.clear();
  if (!pressure || where.empty()) return false;
  const std::int64_t n = settings_.windows.resolution;
  std::atomic<bool> any{false}, wrong{false};
  tbb::parallel_for(0, levels(), [&](int i) {
    const double texel = lod_texel_m(settings_.windows, placement, i);
    const LodIndex first = placement.first[std::size_t(i)];
    const glm::dvec2 low = glm::dvec2(first) * texel, high = low + double(n) * texel;
    if (where.least.x > high.x || where.least.y > high.y || where.most.x < low.x || where.most.y < low.y) return;
    std::vector<float>& heads = heads_[std::size_t(i)];
    heads.assign(std::size_t(n * n), 0.0f);
    std::atomic<bool> here{false};
    tbb::parallel_for(std::int64_t(0), n / 2, [&](std::int64_t j) {
      const std::int64_t z = (first.y & ~std::int64_t(1)) + 2 * j;
      for (std::int64_t k = 0; k < n / 2; ++k) {
        const std::int64_t x = (first.x & ~std::int64_t(1)) + 2 * k;
        const glm::dvec2 middle = (glm::dvec2(double(x), double(z)) + 1.0) * texel;
        if (!where.holds(middle, texel)) continue;
        const float head = pressure(middle, 2.0 * texel);
        if (!std::isfinite(head)) wrong.store(true, std::memory_order_relaxed);
        if (!std::isfinite(head) || head == 0.0f) continue;
        here.store(true, std::memory_order_relaxed);
        for (int corner = 0; corner < 4; ++corner)
          heads[wrapped(z + (corner >> 1), int(n)) * std::size_t(n) + wrapped(x + (corner & 1), int(n))] = head;
      }
    });
    if (here.load())
      any.store(true, std::memory_order_relaxed);
    else
      heads.clear();
  });
  if (wrong.load()) fault_ = "dynamic waves: a pressure that is no number was taken for none";
  return any.load();
}

void DynamicWaves::step(double dt, double to_end_s, std::span<const WaveSource> sources) {
  moved_.assign(sources.begin(), sources.end());
  for (WaveSource& s : moved_) s.place_m -= s.velocity_mps * to_end_s;
  tbb::parallel_for(0, levels(), [&](int i) {
    WaveLevel& level = levels_[std::size_t(i)];
    const auto at = std::size_t(i);
    if (!(depth_m_[at] > 0.0)) return;
    level.turn(dt, settings_.damping_per_s, placement_.first[at], moved_, heads_[at]);
    if (level.still()) return;
    border(i, dt, level.longest_speed_mps() + viewer_speed_);
    level.take_off(axes_[at].x, axes_[at].z, open_ ? open_->texels(i) : nullptr);
  });
  // Waves of 1e12 m are as wrong as what is no number; those of 1e-30 m cost more than they are worth.
  for (int i = 0; i < levels(); ++i) {
    const double energy = levels_[std::size_t(i)].energy_m2();
    if (!(energy < 1e24))
      fault_ = "dynamic waves: level " + std::to_string(i) + " held what is no number, and was cleared";
    if (!(energy < 1e24) || energy < 1e-60) levels_[std::size_t(i)].clear();
  }
}

int DynamicWaves::advance(double seconds, const LodPlacement& placement, std::span<const WaveSource> sources,
                          const Pressure& pressure, const InputBounds& where) {
  require(seconds >= 0.0, seconds, "seconds", "0 or more");
  for (std::size_t i = 0; i < sources.size(); ++i) require(sources[i], i);
  const bool pressed = press(placement, pressure, where),
             pushed = pressed || std::any_of(sources.begin(), sources.end(), pushes);
  owed_s_ += seconds;
  const double dt = 1.0 / settings_.rate_hz;
  const double due = std::floor(owed_s_ / dt + 1e-9);
  if (!active_ && !pushed) {
    owed_s_ = left_of(owed_s_, due, dt);
    placed_ = false;
    return 0;
  }
  if (!(due >= 1.0)) return 0;
  active_ = true;
  place(placement, owed_s_);
  const int steps = int(std::min(due, double(settings_.most_steps)));
  const double length = due * dt / steps;
  owed_s_ = left_of(owed_s_, due, dt);
  for (int i = 0; i < steps; ++i) step(length, owed_s_ + (steps - 1 - i) * length, sources);
  if (!pushed) {
    double highest = 0.0;
    for (const WaveLevel& level : levels_) highest += level.highest_m();
    if (highest < settings_.idle_m || highest == 0.0) {
      for (WaveLevel& level : levels_) level.clear();
      active_ = false;
    }
  }
  return steps;
}

void DynamicWaves::calm() {
  for (WaveLevel& level : levels_) level.clear();
  active_ = placed_ = false;
  owed_s_ = viewer_speed_ = 0.0;
}

void DynamicWaves::calm_at(const LodPlacement& placement) {
  assert(placement.scale.octave == placement_.scale.octave);
  calm();
  place(placement, 0.0);
}

double DynamicWaves::energy_m2() const {
  double sum = 0.0;
  for (const WaveLevel& level : levels_) sum += level.energy_m2();
  return sum;
}

std::optional<std::string> DynamicWaves::take_fault() {
  if (fault_.empty()) return std::nullopt;
  return std::exchange(fault_, {});
}

}  // namespace seascape
