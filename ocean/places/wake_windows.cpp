#include "ocean/places/wake_windows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/require.h"

namespace seascape {

namespace {

// Of half a level's window: a window astern lies so much farther back on the track, so that what is read whole of both
// (wake_whole) overlaps by as much as it takes to be drawn from one to the other.
constexpr double astern_halves = 0.9;
// How far back the hull's own window lies at most.
constexpr double back_halves = 0.5;
// Of half a window: where the one astern is drawn to the own one, within what is read whole of this and before its
// border begins to absorb (DynamicWaves); and where of the one astern, over the border that would absorb what comes
// from there.
constexpr double drawn_whole = double(gpu::wake_whole), drawn_end = 0.75, there_whole = 0.75, there_end = 0.95;
constexpr int drawn_every = 2;         // steps,
constexpr float drawn_a_time = 0.35f;  // by this share of what is between them
// A body that is somewhere else at once has left no track, finest half windows a step; and so short are the pieces of a
// track, of half the finest window.
constexpr double jump_halves = 0.5, piece_halves = 1.0 / 32.0;
// A wake goes on astern when its waves are so much higher than what comes to rest.
constexpr double worth_astern = 10.0;

constexpr double keeps = 0.5;  // of what a body needs to ask for a window, it needs to keep one

double smooth(double faded) { return faded * faded * (3.0 - 2.0 * faded); }

double area_m2(const WaveSource& s) { return s.length_m * s.length_m / std::numbers::pi; }

bool usable(const WaveSource& s) {
  const double all =
      s.place_m.x + s.place_m.y + s.velocity_mps.x + s.velocity_mps.y + s.length_m + s.head_m + s.rise_mps;
  return std::isfinite(all) && s.length_m > 0.0;
}
bool pushes(const WaveSource& s) { return s.head_m != 0.0 || s.rise_mps != 0.0; }

DynamicWavesSettings one_step(DynamicWavesSettings settings) {
  settings.most_steps = 1;  // the sea counts them
  return settings;
}

}  // namespace

void validate(const WakeSettings& s) {
  validate(s.waves);
  require(s.waves.windows.slices <= gpu::max_wake_levels, s.waves.windows.slices, "slices", "2 or 3");
  require(s.least_speed_mps >= 0.0, s.least_speed_mps, "least_speed_mps", "0 or more");
  require(s.least_push_m3ps >= 0.0, s.least_push_m3ps, "least_push_m3ps", "0 or more");
}

double push_m3ps(std::span<const WaveSource> sources) {
  double sum = 0.0;
  for (const WaveSource& s : sources)
    sum += area_m2(s) * (std::abs(s.rise_mps) + std::abs(s.head_m) * glm::length(s.velocity_mps) * 2.0 / s.length_m);
  return sum;
}

WakeWindows::WakeWindows(const WakeSettings& settings) : settings_(settings) {
  validate(settings);
  for (int i = 0; i < most; ++i) windows_.emplace_back(one_step(settings.waves));
  surfaces_.push_back(std::make_shared<WakeSurface>(settings.waves));
}

void WakeWindows::apply(const WakeSettings& settings) {
  validate(settings);
  for (Window& window : windows_) window.waves.apply(one_step(settings.waves));
  settings_ = settings;
  stale_ = true;
  if (active()) ++version_;  // its waves may be sharper
}

double WakeWindows::half_m(int level) const {
  const LodWindowSettings& windows = settings_.waves.windows;
  return 0.5 * windows.resolution * std::ldexp(windows.texel_m, level);
}

// How far behind a body a level's window lies: so that its hull, and two texels more, are in what is read whole.
double WakeWindows::back_m(double length_m, int level) const {
  const double half = half_m(level), texel_m = std::ldexp(settings_.waves.windows.texel_m, level);
  return std::clamp(double(gpu::wake_whole) * half - 0.5 * length_m - 2.0 * texel_m, 0.0, back_halves * half);
}

// Each level's window has its own middle; the viewer, whose speed the borders know, is the body.
LodPlacement WakeWindows::placement(const Window& window) const {
  const LodWindowSettings& windows = settings_.waves.windows;
  LodPlacement result = lod_placement(windows, window.place_m, {});
  for (std::size_t i = 0; i < std::size_t(windows.slices); ++i)
    result.first[i] = lod_placement(windows, window.middle_m[i], {}).first[i];
  return result;
}

double WakeWindows::presence(int window) const { return smooth(windows_[std::size_t(window)].faded); }

bool WakeWindows::active() const {
  return std::any_of(windows_.begin(), windows_.end(), [](const Window& w) { return w.waves.active(); });
}

bool WakeWindows::add(const WakeBody& body, std::span<const WaveSource> sources) {
  const double all = body.place_m.x + body.place_m.y + body.velocity_mps.x + body.velocity_mps.y;
  // As far as windows go (lod_placement).
  constexpr double farthest_m = 1e9, longest_m = 1e4;
  if (!std::isfinite(all) || std::abs(body.place_m.x) > farthest_m || std::abs(body.place_m.y) > farthest_m ||
      !(body.length_m > 0.0) || body.length_m > longest_m || body.id == 0)
    return false;
  if (std::any_of(said_.begin(), said_.end(), [&](const Said& one) { return one.body.id == body.id; })) return false;
  const std::size_t first = sources_.size();
  std::copy_if(sources.begin(), sources.end(), std::back_inserter(sources_), usable);
  said_.push_back({body, first, sources_.size() - first});
  return true;
}

WakeWindows::Body* WakeWindows::known(std::uint64_t id) {
  const auto at =
      std::lower_bound(bodies_.begin(), bodies_.end(), id, [](const Body& b, auto i) { return b.is.id < i; });
  return at != bodies_.end() && at->is.id == id ? &*at : nullptr;
}

WakeWindows::Window* WakeWindows::of(std::uint64_t id) {
  const auto at = std::find_if(windows_.begin(), windows_.end(), [&](const Window& w) {
    return w.body == id && !w.astern && (w.state == State::held || w.state == State::kept);
  });
  return at == windows_.end() ? nullptr : &*at;
}

// What bodies have said, and whether they ask.
void WakeWindows::hear(double dt_s) {
  for (Body& body : bodies_) body.said = false;
  for (const Said& said : said_) {
    Body* body = known(said.body.id);
    double heads_m3 = 0.0;
    const std::span<const WaveSource> sources(sources_.data() + said.first, said.count);
    for (const WaveSource& s : sources) heads_m3 += area_m2(s) * s.head_m;
    if (body == nullptr) {
      const auto at = std::lower_bound(bodies_.begin(), bodies_.end(), said.body.id,
                                       [](const Body& b, auto id) { return b.is.id < id; });
      body = &*bodies_.insert(at, Body{.is = said.body, .heads_m3 = heads_m3});
    }
    body->is = said.body;
    body->said = true;
    body->push = push_m3ps(sources) + std::abs(heads_m3 - body->heads_m3) / dt_s;
    body->heads_m3 = heads_m3;
    body->average += (1.0 - std::exp(-dt_s / average_s)) * (body->push - body->average);
    const bool moves = std::any_of(sources.begin(), sources.end(), pushes);
    const double least = of(said.body.id) != nullptr ? keeps : 1.0;
    body->asks = (moves && glm::length(said.body.velocity_mps) > least * settings_.least_speed_mps) ||
                 std::max(body->push, body->average) > least * settings_.least_push_m3ps;
  }
  std::erase_if(bodies_, [](const Body& body) { return !body.said; });
}

// The body's own window, which one astern goes on from; null where that is gone or has jumped.
WakeWindows::Window* WakeWindows::before(const Window& astern) {
  const auto at = std::find_if(windows_.begin(), windows_.end(), [&](const Window& w) {
    return w.body == astern.body && !w.astern && w.state != State::free && w.steps >= astern.steps;
  });
  return at == windows_.end() ? nullptr : &*at;
}

void WakeWindows::go_with(Window& window, const WakeBody& body) {
  const int last = settings_.waves.windows.slices - 1;
  if (window.steps == 0 || glm::distance(body.place_m, window.track.now()) > jump_halves * half_m(0)) {
    window.track.begin(body.place_m);
    window.steps = 0;
  }
  window.place_m = body.place_m;
  window.track.go_to(body.place_m, piece_halves * half_m(0), (back_halves + astern_halves) * half_m(last));
  for (int i = 0; i <= last; ++i) window.middle_m[std::size_t(i)] = window.track.behind(back_m(body.length_m, i));
}

// Windows go along with their bodies, and know whether these move.
void WakeWindows::follow() {
  for (Window& window : windows_) {
    if (window.state == State::free || window.astern) continue;
    const Body* const body = known(window.body);
    if (body != nullptr) go_with(window, body->is);
  }
  for (Window& window : windows_) {
    if (window.state == State::free) continue;
    ++window.steps;
    const Body* const body = known(window.body);
    if (window.astern) {
      const Window* const own = before(window);
      if (own != nullptr && body != nullptr) {
        window.place_m = own->place_m;
        for (int i = 0; i < settings_.waves.windows.slices; ++i)
          window.middle_m[std::size_t(i)] = own->track.behind(back_m(body->is.length_m, i) + astern_halves * half_m(i));
      }
      if (window.state == State::trails && own == nullptr) window.state = State::kept;
      if (window.state != State::leaving && !window.waves.active()) window.release();
      continue;
    }
    if (window.state == State::leaving) continue;
    window.state = body != nullptr && body->asks ? State::held : State::kept;
    if (window.state == State::kept && !window.waves.active()) window.release();
  }
}

// Of windows astern that with the least waves, or else of those whose bodies have stopped, or else that of the body
// that pushes least; null where all are leaving.
WakeWindows::Window* WakeWindows::first_to_go() {
  Window* least = nullptr;
  int least_kind = 0;
  double least_of = 0.0;
  for (Window& window : windows_) {
    if (window.state == State::free || window.state == State::leaving) continue;
    const Body* const owner = window.state == State::held ? known(window.body) : nullptr;
    const int kind = window.astern ? 0 : window.state == State::kept ? 1 : 2;
    const double counts = owner != nullptr ? owner->average : window.waves.energy_m2();
    if (least == nullptr || kind < least_kind || (kind == least_kind && counts < least_of))
      least = &window, least_kind = kind, least_of = counts;
  }
  return least;
}

// A window that nobody asks for goes on astern of the body that pushes hardest and has none there.
void WakeWindows::hand_on_astern() {
  const auto free =
      std::find_if(windows_.begin(), windows_.end(), [](const Window& w) { return w.state == State::free; });
  if (free == windows_.end()) return;
  const Window* own = nullptr;
  const Body* hardest = nullptr;
  for (const Window& window : windows_) {
    if (window.state != State::held || window.faded < 1.0 || window.track.length_m() < half_m(0)) continue;
    const double worth_m = worth_astern * settings_.waves.idle_m;
    if (window.waves.energy_m2() < worth_m * worth_m) continue;
    const bool has = std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) {
      return w.astern && w.body == window.body && w.state != State::kept;
    });
    const Body* const body = known(window.body);
    if (has || body == nullptr || (hardest != nullptr && body->average <= hardest->average)) continue;
    own = &window, hardest = body;
  }
  if (own == nullptr) return;
  free->state = State::trails;
  free->body = own->body;
  free->astern = true;
  free->steps = 0;
  free->faded = 0.0;
  free->place_m = own->place_m;
  for (int i = 0; i < settings_.waves.windows.slices; ++i)
    free->middle_m[std::size_t(i)] = own->track.behind(back_m(hardest->is.length_m, i) + astern_halves * half_m(i));
  give(*free);
}

void WakeWindows::hand_out(double dt_s) {
  std::vector<Body*> asking;
  for (Body& body : bodies_) {
    if (body.asks && of(body.is.id) == nullptr)
      asking.push_back(&body);
    else
      body.waits = 0.0;
  }
  std::stable_sort(asking.begin(), asking.end(), [](const Body* a, const Body* b) { return a->average > b->average; });
  const auto leaving =
      std::count_if(windows_.begin(), windows_.end(), [](const Window& w) { return w.state == State::leaving; });
  std::ptrdiff_t comes = leaving;  // windows that those who ask will have
  for (Body* const body : asking) {
    const auto free =
        std::find_if(windows_.begin(), windows_.end(), [](const Window& w) { return w.state == State::free; });
    if (free != windows_.end()) {
      free->state = State::held;
      free->body = body->is.id;
      free->faded = 0.0;
      free->steps = 0;
      go_with(*free, body->is);
      body->waits = 0.0;
      continue;
    }
    if (comes-- > 0) continue;
    Window* const least = first_to_go();
    if (least == nullptr) break;
    if (least->state == State::held) {
      const Body* const owner = known(least->body);
      const double least_of = owner != nullptr ? owner->average : 0.0;
      body->waits = body->average > harder * least_of ? body->waits + dt_s : 0.0;
      if (body->waits < waits_s) continue;
    }
    body->waits = 0.0;
    least->state = State::leaving;
  }
  if (asking.empty()) hand_on_astern();
}

void WakeWindows::fade(double dt_s) {
  for (Window& window : windows_) {
    if (window.state == State::leaving) {
      window.faded = window.waves.active() ? window.faded - dt_s / fade_s : 0.0;
      if (window.faded > 0.0) continue;
      window.release();
    } else {
      window.faded = window.waves.active() ? std::min(window.faded + dt_s / fade_s, 1.0) : 0.0;
    }
  }
}

// The waves that other windows have where this one lies, level by level; texels of all are the same squares.
void WakeWindows::give(Window& window) {
  const LodPlacement at = placement(window);
  window.waves.calm_at(at);
  const std::int64_t n = settings_.waves.windows.resolution;
  const std::size_t texels = std::size_t(n * n);
  std::vector<float> from_h(texels), from_q(texels), h(texels), q(texels), sum(texels);
  for (int level = 0; level < window.waves.levels(); ++level) {
    const auto l = std::size_t(level);
    const double texel_m = window.waves.level(level).texel_m();
    const float half_m = float(0.5 * double(n) * texel_m);
    bool any = false;
    std::fill(h.begin(), h.end(), 0.0f), std::fill(q.begin(), q.end(), 0.0f), std::fill(sum.begin(), sum.end(), 0.0f);
    for (const Window& other : windows_) {
      if (&other == &window || other.waves.level(level).still()) continue;
      const LodIndex begin = glm::max(at.first[l], other.waves.placement().first[l]),
                     end = glm::min(at.first[l], other.waves.placement().first[l]) + n;
      if (begin.x >= end.x || begin.y >= end.y) continue;
      other.waves.level(level).surface(from_h, from_q);
      for (std::int64_t z = begin.y; z < end.y; ++z)
        for (std::int64_t x = begin.x; x < end.x; ++x) {
          const glm::dvec2 place = (glm::dvec2(double(x), double(z)) + 0.5) * texel_m;
          const float present = gpu::wake_present(glm::vec2(place - other.middle_m[l]), half_m);
          const std::size_t texel = std::size_t(z & (n - 1)) * std::size_t(n) + std::size_t(x & (n - 1));
          h[texel] += present * from_h[texel], q[texel] += present * from_q[texel], sum[texel] += present;
          any = any || present > 0.0f;
        }
    }
    if (!any) continue;
    for (std::size_t i = 0; i < texels; ++i)
      if (sum[i] > 1.0f) h[i] /= sum[i], q[i] /= sum[i];
    window.waves.level(level).add(h, q);
  }
}

// One astern is drawn to the body's own window, and never the own one to that, so that nothing can build up between
// them.
void WakeWindows::flow_astern(const Window& own, Window& astern) const {
  const std::int64_t n = settings_.waves.windows.resolution;
  const auto within = [](double halves, double whole, double end) {
    return smooth(std::clamp((end - halves) / (end - whole), 0.0, 1.0));
  };
  tbb::parallel_for(0, settings_.waves.windows.slices, [&](int level) {
    const auto l = std::size_t(level);
    const WaveLevel& from = own.waves.level(level);
    WaveLevel& to = astern.waves.level(level);
    if (from.still() && to.still()) return;
    const double half = half_m(level), texel_m = std::ldexp(settings_.waves.windows.texel_m, level);
    // Along each axis, of texels that lie in both windows.
    std::array<std::vector<float>, 2> along;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      along[axis].assign(std::size_t(n), 0.0f);
      const int which = int(axis);
      const std::int64_t first = own.waves.placement().first[l][which],
                         first_astern = astern.waves.placement().first[l][which];
      for (std::int64_t w = std::max(first, first_astern); w < std::min(first, first_astern) + n; ++w) {
        const double at = (double(w) + 0.5) * texel_m;
        along[axis][std::size_t(w & (n - 1))] =
            float(within(std::abs(at - own.middle_m[l][which]) / half, drawn_whole, drawn_end) *
                  within(std::abs(at - astern.middle_m[l][which]) / half, there_whole, there_end));
      }
    }
    to.draw_towards(from, drawn_a_time, along[0], along[1]);
  });
}

void WakeWindows::move_on(double dt_s) {
  const int last = settings_.waves.windows.slices - 1;
  for (Window& window : windows_) {
    window.sources.clear();
    if (window.state == State::free) continue;
    for (const WaveSource& s : sources_) {
      const glm::dvec2 away = glm::abs(s.place_m - window.middle_m[std::size_t(last)]);
      if (std::max(away.x, away.y) < half_m(last) && pushes(s)) window.sources.push_back(s);
    }
    if (!window.waves.active() && !window.sources.empty()) give(window);
  }
  tbb::parallel_for(std::size_t{0}, windows_.size(), [&](std::size_t i) {
    Window& window = windows_[i];
    if (window.state != State::free) window.waves.advance(dt_s, placement(window), window.sources);
  });
  for (Window& window : windows_) {
    if (!window.astern || window.state == State::free || window.steps % drawn_every != 0) continue;
    const Window* const own = before(window);
    if (own != nullptr && own->waves.active() && window.waves.active()) flow_astern(*own, window);
  }
}

void WakeWindows::step(double dt_s) {
  const bool was_active = active();
  hear(dt_s);
  follow();
  hand_out(dt_s);
  move_on(dt_s);
  fade(dt_s);
  said_.clear();
  sources_.clear();
  ahead_s_ = 0.0;
  if (was_active || active()) stale_ = true, ++version_;
}

void WakeWindows::look_ahead(double ahead_s) {
  if (ahead_s == ahead_s_) return;
  ahead_s_ = ahead_s;
  if (active()) stale_ = true, ++version_;
}

void WakeWindows::calm() {
  const bool was_active = active();
  for (Window& window : windows_) window.release();
  bodies_.clear(), said_.clear(), sources_.clear();
  ahead_s_ = 0.0;
  if (was_active) stale_ = true, ++version_;
}

std::shared_ptr<const WakeSurface> WakeWindows::shared_surface() {
  std::array<WakeSurface::Source, most> sources;
  std::size_t count = 0;
  for (const Window& window : windows_)
    if (window.waves.active()) sources[count++] = {window.body, smooth(window.faded), window.middle_m, &window.waves};
  if (count == 0) return nullptr;
  if (!stale_) return surfaces_[current_];
  for (current_ = 0; current_ < surfaces_.size() && surfaces_[current_].use_count() > 1;) ++current_;
  if (current_ == surfaces_.size()) surfaces_.push_back(std::make_shared<WakeSurface>(settings_.waves));
  surfaces_[current_]->evaluate({sources.data(), count}, ahead_s_, velocity_);
  stale_ = false;
  return surfaces_[current_];
}

std::optional<std::string> WakeWindows::take_fault() {
  for (Window& window : windows_)
    if (auto fault = window.waves.take_fault()) return "wakes: " + *fault;
  return std::nullopt;
}

}  // namespace seascape
