// One sea becoming another over some seconds: the new waves are made on a thread of their own, then every wave passes
// to its new amplitude in its place and phase.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "ocean/waves/wave_field.h"

namespace seascape {

struct MadePlace;  // ocean/places/bed_change.h

// Statistics of what a quality keeps of a sea's waves.
SeaStatistics statistics_in(const SeaState& sea, const WaveBins& bins, const WaveQuality& quality);

// A sea with its waves.
struct MadeSea {
  SeaState state;
  WaveBins bins;
  SeaStatistics statistics;
  std::shared_ptr<MadePlace> place = nullptr;  // what its bed makes of them; null where none is known
};
// Asked on the maker's thread.
using MakePlace = std::function<std::shared_ptr<MadePlace>(const SeaState&, const WaveBins&)>;

// Whether `to` can grow out of `from` wave by wave: gravity, depth and loop, by which waves run, are the same.
bool grows_out_of(const SeaState& from, const SeaState& to);

// Makes the waves of other seas on a thread of its own, with the ladder of the sea that is there, so that no wave
// moves.
class SeaMaker {
 public:
  // Waves are made in `quality`.
  SeaMaker(const Ladder& ladder, const WaveQuality& quality);
  ~SeaMaker();  // waits for the sea it is making
  SeaMaker(const SeaMaker&) = delete;
  SeaMaker& operator=(const SeaMaker&) = delete;

  // Asks for a sea; one asked for before and not yet made is forgotten. Throws Error as validate() does. Never waits
  // for the making. Its statistics are those of what `drawn` keeps of it. `place`: makes what its bed makes of it; none
  // where no bed is known.
  void ask(const SeaState& sea, const WaveQuality& drawn, MakePlace place = nullptr);
  // The sea asked for last, once, when it is made; never waits for the making.
  std::optional<MadeSea> take();

 private:
  void work(std::stop_token stop);
  const Ladder ladder_;
  const WaveQuality quality_;
  std::mutex mutex_;
  std::condition_variable_any asked_;
  std::optional<SeaState> wanted_;
  WaveQuality drawn_;  // of it
  MakePlace place_;    // of it
  std::optional<MadeSea> made_;
  std::jthread thread_;  // last: it ends before what it uses
};

// From one sea to another between two times: a function of the time alone. Seas of one seed share each wave's phase,
// and its amplitude goes straight from one to the other; of two seeds the waves have nothing in common, and their
// squares do.
class SeaBlend {
 public:
  // Both of one ladder, quality and dispersion; end_ticks > begin_ticks. `same_waves`: of one seed.
  SeaBlend(MadeSea from, MadeSea to, std::int64_t begin_ticks, std::int64_t end_ticks, bool same_waves);

  // `bins`, of the same shape, take the amplitudes at a time. No allocation.
  void amplitudes(std::int64_t ticks, WaveBins& bins) const;
  double chop(std::int64_t ticks) const;
  // Takes the statistics of both seas in another quality of the picture.
  void measure(const WaveQuality& drawn) {
    for (MadeSea* sea : {&from_, &to_}) sea->statistics = statistics_in(sea->state, sea->bins, drawn);
  }
  // The new sea's share of the variance, 0 to 1.
  double share(std::int64_t ticks) const { return weights(ticks).variance; }
  // Bounds and variances: those of both seas in the share each has of the variance, never below the truth.
  SeaStatistics statistics(std::int64_t ticks) const;
  bool over(std::int64_t ticks) const { return ticks >= end_; }
  const MadeSea& to() const { return to_; }

 private:
  struct Weights {
    double from, to;  // of amplitudes
    double variance;  // the share of the new sea's
  };
  Weights weights(std::int64_t ticks) const;
  MadeSea from_, to_;
  std::int64_t begin_, end_;
  bool same_waves_;
};

}  // namespace seascape
