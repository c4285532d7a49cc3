// Adaptive quality in a loop of frames: pairs timings with the levels that made them, and says what the next frame is
// drawn with. Pure, as AdaptiveQuality is.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/adaptive/adaptive.h"
#include "app/adaptive/live_levers.h"
#include "app/adaptive/loading_levers.h"

namespace seascape {

// What is known before a frame. A frame is told by its number in the loop that draws it (Frame::number).
struct KnownOfFrames {
  double period_ms = 0.0;         // of the display, where settings ask for no other rate; 0: it does not say
  double interval_ms = 0.0;       // between the last two frames; 0: not known
  bool focused = true;            // else the display shows another program
  std::uint64_t timed_frame = 0;  // the newest whose GPU time is known; 0: none
  double gpu_ms = 0.0;            // of it
};

// A frame that was handed over.
struct HandedOver {
  std::uint64_t number = 0;
  double cpu_ms = 0.0, end_ms = 0.0;  // the processor's work on it, and how long the display then had it
  bool under_water = false;           // an eye was
  bool whole = false;                 // drawn at the finest levels, whatever was decided
  std::optional<double> wind_mps;     // of the sea; none while it becomes another wave by wave
};

class RateKeeper {
 public:
  // Starts at the finest levels, or at `start`.
  explicit RateKeeper(std::vector<Lever> levers, const LeverLevels& start = {});

  // Before each frame. Does nothing, and leaves the finest levels, where settings.on is false.
  const Decision& decide(const KnownOfFrames& known, const AdaptiveSettings& settings);
  // After each frame.
  void drawn(const HandedOver& frame);

  // What another scene should be loaded with, whose frames take so many times as long as this one's; nothing where the
  // rate is not held or there are no such levers.
  std::optional<LoadedWith> for_scene(double gpu_ratio, double cpu_ratio);

  // Frames that a scene begins with tell nothing: a driver may still be at work on its pipelines.
  static constexpr std::uint64_t first_frames = 4;

  const DrawnQuality& quality() const { return quality_; }  // of the frame decided last
  const LeverLevels& levels() const { return controller_.last().levels; }
  const Decision& last() const { return controller_.last(); }
  const AdaptiveQuality& controller() const { return controller_; }
  // One line: "quality 0.83, picture 0.91, GPU 10.4 of 11.1 ms: over budget".
  std::string text() const;

 private:
  struct Drawn {
    std::uint64_t number = 0, frame = 0;
    LeverLevels levels{};
    double cpu_ms = 0.0, end_ms = 0.0;
  };
  void take(const Drawn& timed, double gpu_ms);
  // What the load depends on besides the picture: an eye under water, and the sea by the wind's Beaufort number.
  struct Water {
    bool under = false;
    int force = 0;
    bool operator==(const Water&) const = default;
  };
  static constexpr int forces = 13;  // 0 to 12
  void meet(bool under_water, const std::optional<double>& wind_mps);
  using Loads = std::array<std::array<std::optional<double>, forces>, 2>;  // logarithms

  AdaptiveQuality controller_;
  DrawnQuality quality_;
  bool on_ = false;
  double serial_ms_ = 0.0;  // of a frame's time that comes before and after the GPU's, where a display waits for that
  std::uint64_t frame_ = 0, timed_ = 0;  // of the controller; the newest told of
  std::array<Drawn, 16> drawn_{};
  std::vector<FrameTiming> timings_;
  std::vector<ForeseenChange> foreseen_;
  std::optional<Water> water_;
  bool settled_ = true;        // the sea of the frame before was not on its way to another
  Loads gpu_load_, cpu_load_;  // as they last were in each water
};

}  // namespace seascape
