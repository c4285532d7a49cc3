// A field kept in windows around the viewer (lod_windows.h), on the processor: moved with the viewer, doubled with the
// height, read at any place.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "ocean/places/lod_windows.h"

namespace seascape {

// Between four texels, of which `at(LodIndex from the first)` gives each; `f`: how far from the first, 0 to 1.
template <class At>
auto lod_bilinear(glm::vec2 f, const At& at) {
  const auto a = at({0, 0}), b = at({1, 0}), c = at({0, 1}), d = at({1, 1});
  const auto low = a + (b - a) * f.x, high = c + (d - c) * f.x;
  return low + (high - low) * f.y;
}

// A row of a slice's texels, counted from one of them: without the divisions that their numbers in the world cost.
template <class T>
struct LodRow {
  const T* texels;
  std::int64_t side, column;  // of the first
  const T& operator[](std::int64_t i) const { return texels[column + i < side ? column + i : column + i - side]; }
};

// T has +, - and * with a float, as float and glm's vectors of floats have. Nothing that stays in a window is moved or
// changed, whichever way the window goes: texels lie where their number modulo the resolution says, slices where their
// octave modulo the number of slices does.
//
// Error of what is read between texels, for a wave of n texels, relative and rms along one axis: sqrt(1 - 2 s^4 + (2 +
// cos(2 pi / n)) / 3), s = sin(pi / n) / (pi / n): 21 % at n = 4, 5.6 % at 8, 1.4 % at 16; of a field f at most texel^2
// / 8 (max |f_xx| + max |f_zz|).
template <class T>
class LodField {
 public:
  // `outside`: what is read beyond all windows. All is `outside` at first. Throws as validate() does.
  LodField(const LodWindowSettings& settings, T outside, const LodPlacement& placement)
      : settings_(settings), outside_(outside), placement_(placement), side_(settings.resolution) {
    validate(settings);
    texels_.assign(std::size_t(settings.slices) * side_ * side_, outside);
    windows_ = lod_windows(settings_, placement_, placement_.viewer);
  }

  // What is read beyond all windows from now on.
  void set_outside(T outside) { outside_ = outside; }

  // Moves the windows. What leaves one is lost, and so is, if all texels double, what only the finest had. A texel that
  // comes in gets fill(middle, texel, inherited): its middle (dvec2, m), its side (m) and what the next coarser slice
  // has there, or `outside` where none does; of a slice that was not there before, inherited is the mean of the finer
  // texels, or what lies between the coarser ones.
  template <class Fill>
  void follow(const LodPlacement& next, const Fill& fill) {
    while (placement_.scale.octave < next.scale.octave) widen(fill);
    while (placement_.scale.octave > next.scale.octave) narrow(fill);
    const LodPlacement before = placement_;
    placement_ = next;
    windows_ = lod_windows(settings_, placement_, placement_.viewer);
    for (int i = settings_.slices - 1; i >= 0; --i) {
      each_entered(i, before.first[std::size_t(i)], [&](LodIndex w) { enter(i, w, inherited(i, w), fill); });
    }
  }
  void follow(const LodPlacement& next) {
    follow(next, [](glm::dvec2, double, const T& inherited) { return inherited; });
  }

  // A texel by its number in the world; it has to be inside the slice's window.
  T& texel(int slice, LodIndex w) { return texels_[place(slice, w)]; }
  const T& texel(int slice, LodIndex w) const { return texels_[place(slice, w)]; }
  // All texels of a slice, resolution rows of as many: number w of the world at w modulo resolution, by row and column.
  const T* texels(int slice) const { return texels_.data() + std::size_t(layer(slice)) * side_ * side_; }
  T* texels(int slice) { return texels_.data() + std::size_t(layer(slice)) * side_ * side_; }
  // The row of a texel in the slice's window, from it on.
  LodRow<T> row(int slice, LodIndex w) const {
    const std::int64_t column = ((w.x % side_) + side_) % side_;
    return {&texel(slice, w) - column, side_, column};
  }
  LodIndex first(int slice) const { return placement_.first[std::size_t(slice)]; }
  double texel_m(int slice) const { return lod_texel_m(settings_, placement_, slice); }
  glm::dvec2 middle(int slice, LodIndex w) const { return (glm::dvec2(w) + 0.5) * texel_m(slice); }
  // Calls work(w) for each texel of a slice's window.
  template <class Work>
  void each(int slice, const Work& work) const {
    const LodIndex from = first(slice);
    for (std::int64_t z = 0; z < side_; ++z)
      for (std::int64_t x = 0; x < side_; ++x) work(from + LodIndex(x, z));
  }

  // At a place (m), for a footprint (m), as lod_read() has it.
  T sample(glm::dvec2 place_m, double footprint_m) const {
    const gpu::LodRead read =
        gpu::lod_read(windows_.reach, settings_.slices, gpu::lod_distance(glm::vec2(place_m - placement_.viewer)),
                      float(footprint_m));
    if (!(read.present > 0.0f)) return outside_;
    T value = bilinear(read.fine, place_m);
    if (read.coarser > 0.0f) value = value + (bilinear(read.fine + 1, place_m) - value) * read.coarser;
    return outside_ + (value - outside_) * read.present;
  }
  // Of one slice; its window has to cover the place and half a texel around.
  T bilinear(int slice, glm::dvec2 place_m) const {
    const glm::dvec2 at = place_m / texel_m(slice) - 0.5, cell = glm::floor(at);
    const LodIndex w(cell);
    return lod_bilinear(glm::vec2(at - cell), [&](LodIndex from_first) { return texel(slice, w + from_first); });
  }

  const LodPlacement& placement() const { return placement_; }
  const gpu::LodWindows& windows() const { return windows_; }  // places from the viewer
  int slices() const { return settings_.slices; }
  std::int64_t side() const { return side_; }  // texels of a slice
  const T& outside() const { return outside_; }
  int layer(int slice) const { return gpu::lod_layer(windows_.first_layer, slice, settings_.slices); }

 private:
  std::size_t place(int slice, LodIndex w) const {
    const auto wrap = [&](std::int64_t v) { return std::size_t(((v % side_) + side_) % side_); };
    return (std::size_t(layer(slice)) * side_ + wrap(w.y)) * side_ + wrap(w.x);
  }
  bool inside(LodIndex from, LodIndex w) const {
    return w.x >= from.x && w.y >= from.y && w.x < from.x + side_ && w.y < from.y + side_;
  }
  // Calls work(w) for each texel of a slice's window that is not in the one from `was` on.
  template <class Work>
  void each_entered(int slice, LodIndex was, const Work& work) const {
    const LodIndex from = first(slice), to = from + side_;
    const std::int64_t kept_from = std::clamp(was.x, from.x, to.x), kept_to = std::clamp(was.x + side_, from.x, to.x);
    for (std::int64_t z = from.y; z < to.y; ++z) {
      const bool kept = z >= was.y && z < was.y + side_ && kept_from < kept_to;
      for (std::int64_t x = from.x; x < (kept ? kept_from : to.x); ++x) work({x, z});
      if (!kept) continue;
      for (std::int64_t x = kept_to; x < to.x; ++x) work({x, z});
    }
  }
  template <class Fill>
  void enter(int slice, LodIndex w, const T& inherited, const Fill& fill) {
    texel(slice, w) = fill(middle(slice, w), texel_m(slice), inherited);
  }
  // What the next coarser slice has at the middle of a texel. Its window covers all of the finer one's but where both
  // are far from snapped alike.
  T inherited(int slice, LodIndex w) const {
    if (slice + 1 >= settings_.slices) return outside_;
    const LodIndex low(glm::floor(middle(slice, w) / texel_m(slice + 1) - 0.5));
    if (!inside(first(slice + 1), low) || !inside(first(slice + 1), low + std::int64_t(1))) return outside_;
    return bilinear(slice + 1, middle(slice, w));
  }
  void at_octave(int octave) {
    placement_ = lod_placement(settings_, placement_.viewer, {octave, 0.0});
    windows_ = lod_windows(settings_, placement_, placement_.viewer);
  }
  template <class Fill>
  void widen(const Fill& fill) {
    at_octave(placement_.scale.octave + 1);
    const int last = settings_.slices - 1, finer = last - 1;
    each(last, [&](LodIndex w) {
      const LodIndex low = w * std::int64_t(2), high = low + std::int64_t(1);
      const bool known = inside(first(finer), low) && inside(first(finer), high);
      enter(last, w,
            known ? (texel(finer, low) + texel(finer, low + LodIndex(1, 0)) + texel(finer, low + LodIndex(0, 1)) +
                     texel(finer, high)) *
                        0.25f
                  : outside_,
            fill);
    });
  }
  template <class Fill>
  void narrow(const Fill& fill) {
    at_octave(placement_.scale.octave - 1);
    each(0, [&](LodIndex w) { enter(0, w, inherited(0, w), fill); });
  }

  LodWindowSettings settings_;
  T outside_;
  LodPlacement placement_;
  gpu::LodWindows windows_{};
  std::int64_t side_;
  std::vector<T> texels_;
};

}  // namespace seascape
