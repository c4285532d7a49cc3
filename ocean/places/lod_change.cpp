#include "ocean/places/lod_change.h"

#include <cstdint>

namespace seascape {

namespace {

int wrapped(std::int64_t texel, int side) { return int(((texel % side) + side) % side); }

// What comes in along one axis, by less than the side.
LodSpan entered(std::int64_t before, std::int64_t now, int side) {
  return now > before ? LodSpan{wrapped(before, side), int(now - before)}
                      : LodSpan{wrapped(now, side), int(before - now)};
}

std::vector<LodRun> runs(const LodSpan& span, int side) {
  std::vector<LodRun> result;
  if (span.count <= 0) return result;
  result.push_back({span.from, std::min(span.from + span.count, side)});
  if (span.from + span.count > side) result.push_back({0, span.from + span.count - side});
  return result;
}

LodSpan with_neighbours(const LodSpan& span, int side) {
  if (span.count == 0) return span;
  return span.count + 2 >= side ? LodSpan{0, side} : LodSpan{wrapped(span.from - 1, side), span.count + 2};
}

}  // namespace

std::uint32_t changed_slices(const LodChanges& changes) {
  std::uint32_t slices = 0;
  for (std::size_t i = 0; i < changes.size(); ++i)
    if (changes[i].any()) slices |= 1u << i;
  return slices;
}

LodChange lod_entered(LodIndex before, LodIndex now, int side) {
  const LodIndex by = glm::abs(now - before);
  if (by.x >= side || by.y >= side) return whole_change(side);
  return {entered(before.x, now.x, side), entered(before.y, now.y, side)};
}

void join(LodChanges& changes, const LodChanges& others, int side) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (!others[i].any() || others[i] == changes[i]) continue;
    changes[i] = changes[i].any() ? whole_change(side) : others[i];
  }
}

LodChange with_neighbours(const LodChange& change, int side) {
  return {with_neighbours(change.columns, side), with_neighbours(change.rows, side)};
}

std::vector<LodRect> rects(const LodChange& change, int side) {
  std::vector<LodRect> result;
  for (const LodRun& z : runs(change.rows, side)) result.push_back({{0, side}, z});
  const LodSpan others{wrapped(std::int64_t(change.rows.from) + change.rows.count, side), side - change.rows.count};
  for (const LodRun& z : runs(others, side))
    for (const LodRun& x : runs(change.columns, side)) result.push_back({x, z});
  return result;
}

LodRanges::LodRanges(int slices, int side) : side_(side), slices_(std::size_t(slices)) {
  for (Slice& slice : slices_) slice.squares.resize(std::size_t(side / square) * std::size_t(side / square));
}

void LodRanges::sum_up(int slice) {
  Range all;
  for (const Range& range : slices_[std::size_t(slice)].squares) all.add(range.least), all.add(range.most);
  slices_[std::size_t(slice)].all = all;
}

}  // namespace seascape
