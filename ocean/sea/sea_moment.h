// The waves of a sea at one time in one detail, made when they are first asked for, and the store that keeps the last
// of them so that nobody makes them twice.
#pragma once
#include <tbb/collaborative_call_once.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "ocean/sea/place_sea.h"
#include "ocean/sea/sea_spec.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

class DynamicSurface;  // ocean/places/dynamic_surface.h
class WakeSurface;     // ocean/places/wake_surface.h
class MomentStore;

// What steps of the sea have made and who holds a moment keeps, as it is now.
struct SeaNow {
  std::shared_ptr<const DynamicSurface> dynamic;  // null: none, or of another time
  std::shared_ptr<const WakeSurface> wakes;       // null: none, or all rest, or of another time
  std::shared_ptr<const ClipVolumes> volumes;     // with the bodies of actors, or of another time the scene's; null:
                                                  // none
  bool operator==(const SeaNow&) const = default;
};

// What all questions of one moment ask.
class SeaMoment {
 public:
  // The tiles, which the first caller computes on all cores; others wait, or help. Any thread. Of `felt` moments, and
  // of those that a picture has as 16-bit floats, the cascades' may lack slopes and moments, which queries do not read.
  const WaveTiles& tiles() const;
  // Does this share (0 to 1) of the tiles' work, so that the first question finds less to do. Nobody asks meanwhile.
  void prepare(double share) const;

  std::int64_t ticks = 0;
  SeaDetail detail = SeaDetail::drawn;
  std::shared_ptr<const WaveField> field;
  std::shared_ptr<const PlaceSea> places;
  SeaNow now;
  double left_out_m = 0.0;
  int slot = -1;  // which of the memories that were lent the tiles lie in (MomentStore::keep_drawn_in); -1: their own

 private:
  friend class MomentStore;
  explicit SeaMoment(bool velocity) : tiles_(velocity) {}
  bool makes_slopes() const { return detail != SeaDetail::felt; }
  bool has_slopes() const { return makes_slopes() && !tiles_.in_halves(); }
  std::uint64_t waves_ = 0, asked_ = 0;  // which waves, and when last, as the store counts
  MomentStore* store_ = nullptr;
  mutable WaveTiles tiles_;
  mutable int prepared_ = 0;  // pieces of WaveField::fill() that are done before the first question
  mutable std::optional<tbb::collaborative_once_flag> once_;
  mutable std::atomic<bool> made_{false};
  // Moments of the same time and waves, some of whose tiles may serve here.
  mutable std::array<std::shared_ptr<const SeaMoment>, sea_details> lenders_;
};

class MomentStore {
 public:
  // What a moment is of. `waves` counts up with every change of the field's amplitudes.
  struct Key {
    std::int64_t ticks;
    SeaDetail detail;
    bool velocity;
    std::uint64_t waves;
  };
  // The moment of this key: one that is kept, or one whose memory is free. `field` and `places` are those of the waves.
  std::shared_ptr<const SeaMoment> moment(const Key& key, std::shared_ptr<const WaveField> field,
                                          std::shared_ptr<const PlaceSea> places, SeaNow now, double left_out_m);

  // Has the cascades of `drawn` moments go to these memories while one of them is free (WaveTiles::keep_in). `felt`
  // moments of the same time borrow from them, others do not, since foam keeps its view for several frames. None: no
  // more; then nobody may hold a moment that lies in one or borrows from it.
  void keep_drawn_in(std::span<const WaveTiles::Lent> memories, const WaveTileLayout& layout, int cascades);

  // Moments that nobody looks at keep nothing that steps have made.
  void forget_now();

  // How often tiles of a detail have been computed.
  std::uint64_t made(SeaDetail detail) const { return made_[std::size_t(detail)]; }
  // Has each computation of tiles reported from now on. Called on the thread that computes them.
  using Report = std::function<void(std::int64_t ticks, SeaDetail detail)>;
  void report_to(Report report) { report_ = std::move(report); }

 private:
  friend class SeaMoment;
  void count(std::int64_t ticks, SeaDetail detail) {
    ++made_[std::size_t(detail)];
    if (report_) report_(ticks, detail);
  }
  std::shared_ptr<SeaMoment> free_moment(const Key& key);
  void release_lenders();
  std::mutex mutex_;
  std::vector<std::shared_ptr<SeaMoment>> moments_;
  std::array<std::atomic<std::uint64_t>, sea_details> made_{};
  Report report_;
  std::uint64_t asked_ = 0;
};

}  // namespace seascape
