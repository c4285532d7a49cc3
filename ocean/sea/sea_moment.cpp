#include "ocean/sea/sea_moment.h"

#include <algorithm>
#include <cassert>

namespace seascape {

namespace {
constexpr std::size_t least_kept = 2;  // moments of a detail: of this frame and the one before

// The tile of `from` that is this tile of a field: cascades are alike by their samples, other sources by themselves.
std::optional<int> same_tile(const WaveField& field, int tile, const WaveField& of_from, const WaveTiles& from) {
  const int cascades = field.quality().cascades;
  if (tile < cascades) {
    const bool same = tile < of_from.quality().cascades && tile_samples(field.quality(), tile) == from.samples(tile);
    return same ? std::optional(tile) : std::nullopt;
  }
  for (std::size_t s = 0; s < of_from.others().size(); ++s)
    if (of_from.others()[s] == field.others()[std::size_t(tile - cascades)]) return of_from.quality().cascades + int(s);
  return std::nullopt;
}
}  // namespace

const WaveTiles& SeaMoment::tiles() const {
  if (made_.load(std::memory_order_acquire)) return tiles_;
  tbb::collaborative_call_once(*once_, [this] {
    std::array<BorrowedTile, gpu::max_cascades + most_sources> borrowed;
    std::size_t count = 0;
    const int all = field->tile_count();
    for (auto& lender : lenders_) {
      if (prepared_ > 0) break;
      bool lends = false;
      const bool able = lender != nullptr && lender->made_.load(std::memory_order_acquire) &&
                        (lender->tiles_.has_velocity() || !tiles_.has_velocity());
      for (int tile = 0; able && tile < all; ++tile) {
        // What lies in lent memory is computed there: a copy would take as long.
        if (slot >= 0 && tile < field->quality().cascades) continue;
        const auto end = borrowed.begin() + std::ptrdiff_t(count);
        if (std::any_of(borrowed.begin(), end, [&](const BorrowedTile& b) { return b.tile == tile; })) continue;
        if (tile < field->quality().cascades && has_slopes() && !lender->has_slopes()) continue;
        if (const auto from = same_tile(*field, tile, *lender->field, lender->tiles_))
          borrowed[count++] = {tile, &lender->tiles_, *from}, lends = true;
      }
      if (!lends) lender.reset();
    }
    if (prepared_ == 0) {
      field->begin(ticks, tiles_, {borrowed.data(), count});
      if (int(count) < all) store_->count(ticks, detail);
    }
    field->fill(tiles_, prepared_, field->piece_count(), makes_slopes());
    made_.store(true, std::memory_order_release);
  });
  return tiles_;
}

void SeaMoment::prepare(double share) const {
  if (made_.load(std::memory_order_acquire)) return;
  const int due = field->pieces_within(share);
  if (due <= prepared_) return;
  if (prepared_ == 0) {
    for (auto& lender : lenders_) lender.reset();
    field->begin(ticks, tiles_);
    store_->count(ticks, detail);
  }
  field->fill(tiles_, prepared_, due, makes_slopes());
  prepared_ = due;
}

void MomentStore::keep_drawn_in(std::span<const WaveTiles::Lent> memories, const WaveTileLayout& layout, int cascades) {
  const std::lock_guard lock(mutex_);
  release_lenders();
  std::erase_if(moments_, [](const auto& moment) { return moment->detail == SeaDetail::drawn; });
  for (std::size_t i = 0; i < memories.size(); ++i) {
    moments_.push_back(std::shared_ptr<SeaMoment>(new SeaMoment(false)));
    moments_.back()->slot = int(i);
    moments_.back()->tiles_.keep_in(memories[i], layout, cascades);
  }
}

// Moments that nobody looks at let go of those that they borrowed tiles from, and are of no time any more.
void MomentStore::release_lenders() {
  for (const auto& moment : moments_) {
    if (moment.use_count() > 1) continue;
    bool lent = false;
    for (auto& lender : moment->lenders_) lent = lent || lender != nullptr, lender.reset();
    if (lent && moment->made_) moment->waves_ = 0;
  }
}

void MomentStore::forget_now() {
  const std::lock_guard lock(mutex_);
  for (const auto& moment : moments_)
    if (moment.use_count() == 1) moment->now = {};
}

std::shared_ptr<SeaMoment> MomentStore::free_moment(const Key& key) {
  const auto oldest = [&](bool lent) {
    std::shared_ptr<SeaMoment> found;
    std::size_t kept = 0;
    for (const auto& moment : moments_) {
      if (moment->detail != key.detail || (moment->slot >= 0) != lent || moment->tiles_.has_velocity() != key.velocity)
        continue;
      ++kept;
      if (moment.use_count() == 1 && (found == nullptr || moment->asked_ < found->asked_)) found = moment;
    }
    return lent || kept >= least_kept ? found : nullptr;
  };
  if (key.detail == SeaDetail::drawn && !key.velocity)
    for (int tries = 0; tries < 2; ++tries) {
      if (auto lent = oldest(true)) return lent;
      release_lenders();
    }
  for (int tries = 0; tries < 2; ++tries) {
    if (auto own = oldest(false)) return own;
    release_lenders();
  }
  return moments_.emplace_back(std::shared_ptr<SeaMoment>(new SeaMoment(key.velocity)));
}

std::shared_ptr<const SeaMoment> MomentStore::moment(const Key& key, std::shared_ptr<const WaveField> field,
                                                     std::shared_ptr<const PlaceSea> places, SeaNow now,
                                                     double left_out_m) {
  const std::lock_guard lock(mutex_);
  ++asked_;
  std::shared_ptr<SeaMoment> same;
  for (const auto& kept : moments_)
    if (kept->ticks == key.ticks && kept->detail == key.detail && kept->waves_ == key.waves &&
        kept->tiles_.has_velocity() == key.velocity) {
      kept->asked_ = asked_;
      if (kept->now == now) return kept;
      same = same == nullptr && kept.use_count() == 1 ? kept : same;
    }
  // The tiles are the same whatever steps have done since; who holds a view keeps what it has.
  if (same != nullptr) {
    same->now = std::move(now);
    return same;
  }
  const std::shared_ptr<SeaMoment> moment = free_moment(key);
  moment->ticks = key.ticks;
  moment->detail = key.detail;
  moment->waves_ = key.waves;
  moment->asked_ = asked_;
  moment->store_ = this;
  moment->field = std::move(field);
  moment->places = std::move(places);
  moment->now = std::move(now);
  moment->left_out_m = left_out_m;
  moment->prepared_ = 0;
  moment->once_.emplace();
  moment->made_.store(false, std::memory_order_relaxed);
  std::size_t lenders = 0;
  for (auto& lender : moment->lenders_) lender.reset();
  for (const auto& other : moments_)
    if (other != moment && other->waves_ == key.waves && other->ticks == key.ticks && other->field != nullptr &&
        (other->slot < 0 || key.detail == SeaDetail::felt) && lenders < moment->lenders_.size())
      moment->lenders_[lenders++] = other;
  return moment;
}

}  // namespace seascape
