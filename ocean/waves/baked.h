// A recorded loop of waves, played at any time: the source of the effect baked.
#pragma once
#include <memory>

#include "ocean/waves/baked_loop.h"
#include "ocean/waves/baked_settings.h"
#include "ocean/waves/tile_source.h"

namespace seascape {

// Between frames displacement follows Lagrange's polynomial through the three before and the three after, so that a
// wave of w radians a frame keeps within 1 - g(w) of its amplitude at every time: 0.0001 at w = 0.5, 0.004 at 1, 0.04
// at 1.5 (straight lines: 0.03, 0.12, 0.27, a pulse as often as frames come). Velocity is that polynomial's derivative.
// Slopes are differences of sixth order over texels, and second moments their squares: a loop needs only its
// displacement.
class Baked final : public TileSource {
 public:
  // Throws Error as validate() does; the loop's sizes are checked by whoever read it. With `loop_s` above 0 it is
  // played a whole number of times in that time, as fast as that needs.
  Baked(BakedLoop loop, const BakedSettings& settings, double loop_s = 0.0);
  // The same loop in other settings, shared with `same`.
  Baked(const Baked& same, const BakedSettings& settings, double loop_s = 0.0);

  std::string_view name() const override { return "baked"; }
  int samples() const override { return loop_->samples; }
  bool still() const override { return still_; }
  std::span<const Laying> layings() const override { return {&laying_, 1}; }
  SourceStatistics statistics() const override { return statistics_; }
  std::size_t workspace_floats(bool velocity) const override;
  void evaluate(std::int64_t ticks, bool velocity, std::span<const PlaneLevel> levels,
                std::span<float> workspace) const override;
  std::size_t bytes() const override { return loop_->texels.size() * sizeof(float); }

  // Seconds of the sea's time until it repeats; 0 where it stands still.
  double period_s() const;

 private:
  // As recorded, but that its waves are raised by what sampling between texels takes.
  struct Raised : BakedLoop {
    SourceStatistics statistics;  // as recorded
    float moment_share = 1.0f;    // of the slopes' variance over that of the texels'
  };
  static std::shared_ptr<const Raised> raised(BakedLoop loop);
  Baked(std::shared_ptr<const Raised> loop, const BakedSettings& settings, double loop_s);
  std::shared_ptr<const Raised> loop_;
  float by_;  // what is played is so many times as far displaced as recorded
  Laying laying_;
  SourceStatistics statistics_;
  double period_ticks_ = 0.0;
  std::uint64_t turns_ = 0;  // of the loop a tick, times 2^64
  double frames_a_second_ = 0.0;
  bool still_ = false;
};

// What remains of a wave of w radians a frame in the middle between two of them.
double kept_between_frames(double w);

}  // namespace seascape
