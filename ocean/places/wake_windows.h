// Windows of dynamic waves that belong to bodies and follow them, wherever the viewer is: what bodies feel of each
// other's waves never depends on a camera.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ocean/places/dynamic_waves.h"
#include "ocean/places/wake_settings.h"
#include "ocean/places/wake_surface.h"
#include "ocean/places/wake_track.h"

namespace seascape {

// A body as it is at a step's end.
struct WakeBody {
  std::uint64_t id = 0;  // that no other body of the sea has; not 0
  glm::dvec2 place_m{0.0}, velocity_mps{0.0};
  double length_m = 1.0;  // of its waterline, above 0: what presses is sought no farther from its place
};

// How much water sources move, m^3/s: what they add and take away, and pressures that move: a head over its area
// length^2 / pi is pushed aside over half its length.
double push_m3ps(std::span<const WaveSource> sources);

// At most four windows, the same at every preset. A body asks for one while it moves or pushes enough, and half of that
// keeps it; of more bodies than windows those have them that push hardest, averaged over a second. A body takes
// another's window when for a second it has pushed half as hard again, and a window whose body has stopped is kept
// until its waves rest or another body asks. A window fades in and out over a second. Where it comes to lie it begins
// with the waves that other windows have there: all texels are parts of one grid.
//
// Waves are behind who makes them: each level's window lies that far back on its body's track that the hull is just
// within what is read whole of it. Windows that nobody asks for go on where those of the hardest pushing bodies end, a
// window's side times 0.45 farther back on the track (astern). Waves flow into it from
// the body's own: where that is read whole, the one astern is drawn to it. It is the first to go when a body asks.
//
// A source presses every window that it lies in. A body outside all windows makes no waves.
//
// Errors: what DynamicWaves says. Two windows differ where one does not know what came into the other before it lay
// there, or from beyond its border; between them waves then fade as the weights do (wake_windows.h).
class WakeWindows {
 public:
  static constexpr int most = gpu::max_wake_windows;
  static constexpr double fade_s = 1.0, average_s = 1.0, waits_s = 1.0, harder = 1.5;
  // Throws as validate() does.
  explicit WakeWindows(const WakeSettings& settings);

  // What bodies say in a step. Gives false, and leaves the body out, where a number of it is not finite or out of range
  // or its id is taken; sources that are no numbers, or have no length, are left out.
  bool add(const WakeBody& body, std::span<const WaveSource> sources);
  // Ends a step of so many seconds: gives windows to bodies, and moves all waves on.
  void step(double dt_s);
  // From here on the surface is that of the last step, carried on by this time.
  void look_ahead(double ahead_s);
  // All windows go: of a jump of the time.
  void calm();

  // Waves that there are; null where all windows rest. It stays as it is, whatever steps follow.
  std::shared_ptr<const WakeSurface> shared_surface();
  // Counts up whenever the surface changes, from 1.
  std::uint64_t version() const { return version_; }
  void know_velocity(bool known) { velocity_ = known; }
  // Takes other settings of the same windows, gravity and depth. Throws as validate() does, and stays as it was then.
  void apply(const WakeSettings& settings);
  const WakeSettings& settings() const { return settings_; }

  // What a window does, for tests and for plans. `trails`: astern of its body's own.
  enum class State : std::uint8_t { free, held, kept, leaving, trails };
  State state(int window) const { return windows_[std::size_t(window)].state; }
  std::uint64_t body(int window) const { return windows_[std::size_t(window)].body; }  // 0: none
  const DynamicWaves& waves(int window) const { return windows_[std::size_t(window)].waves; }
  // The middle of a level's window, m.
  glm::dvec2 middle_m(int window, int level) const {
    return windows_[std::size_t(window)].middle_m[std::size_t(level)];
  }
  double presence(int window) const;  // 0 to 1, smooth over time
  bool active() const;                // whether any window has waves

  // Every number that steps depend on, for a hash: take(an integer, or a double).
  template <class Take>
  void each_number(const Take& take) const;
  std::optional<std::string> take_fault();

 private:
  struct Window {
    explicit Window(const DynamicWavesSettings& settings) : waves(settings) {}
    State state = State::free;
    std::uint64_t body = 0;
    glm::dvec2 place_m{0.0};  // of its body
    WakeTrack track;          // of its body; not kept by one astern
    std::array<glm::dvec2, gpu::max_wake_levels> middle_m{};
    bool astern = false;
    std::int64_t steps = 0;  // since it began
    double faded = 0.0;      // along the way from 0 to 1
    DynamicWaves waves;
    std::vector<WaveSource> sources;  // of a step
    void release() {
      waves.calm();
      state = State::free, body = 0, faded = 0.0, astern = false;
    }
  };
  struct Body {
    WakeBody is;
    double heads_m3 = 0.0, push = 0.0, average = 0.0, waits = 0.0;
    bool said = false, asks = false;
  };
  struct Said {
    WakeBody body;
    std::size_t first, count;  // of sources_
  };
  void hear(double dt_s);
  void follow();
  void go_with(Window& window, const WakeBody& body);
  void hand_out(double dt_s);
  Window* first_to_go();
  void hand_on_astern();
  void give(Window& window);
  void flow_astern(const Window& own, Window& astern) const;
  void fade(double dt_s);
  void move_on(double dt_s);
  Body* known(std::uint64_t id);
  Window* of(std::uint64_t id);
  Window* before(const Window& astern);
  double half_m(int level) const;
  double back_m(double length_m, int level) const;
  LodPlacement placement(const Window& window) const;
  WakeSettings settings_;
  std::vector<Window> windows_;
  std::vector<Body> bodies_;  // by id
  std::vector<Said> said_;
  std::vector<WaveSource> sources_;
  std::vector<std::shared_ptr<WakeSurface>> surfaces_;  // the current one, and those that somebody keeps
  std::size_t current_ = 0;
  std::uint64_t version_ = 1;
  double ahead_s_ = 0.0;
  bool stale_ = true, velocity_ = false;
  std::string fault_;
};

template <class Take>
void WakeWindows::each_number(const Take& take) const {
  for (const Body& body : bodies_) {
    take(body.is.id);
    for (const double number : {body.heads_m3, body.average, body.waits}) take(number);
  }
  for (const Window& window : windows_) {
    take(std::uint64_t(window.state));
    take(window.body);
    for (const double number : {window.faded, window.place_m.x, window.place_m.y}) take(number);
    for (const glm::dvec2& middle : window.middle_m) take(middle.x), take(middle.y);
    take(std::uint64_t(window.steps));
    for (int i = 0; window.waves.active() && i < window.waves.levels(); ++i)
      for (const std::complex<double>& mode : window.waves.level(i).modes()) take(mode.real()), take(mode.imag());
  }
}

}  // namespace seascape
