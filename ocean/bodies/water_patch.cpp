#include "ocean/bodies/water_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seascape {
namespace {

constexpr int fewest_samples = 6;

// The cosine transform of the first kind as a symmetric matrix but for its ends: row m holds cos(pi m i / (count - 1)),
// the samples at either end counted half.
std::vector<double> cosines(int count) {
  const int turn = 2 * (count - 1);
  std::vector<double> out(std::size_t(count * count));
  for (int m = 0; m < count; ++m)
    for (int i = 0; i < count; ++i)
      out[std::size_t(m * count + i)] =
          (i == 0 || i == count - 1 ? 0.5 : 1.0) * std::cos(2.0 * std::numbers::pi * double(i * m % turn) / turn);
  return out;
}

// Catmull and Rom's weights (1974) of four samples.
std::array<double, 4> weights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1.0, -1.5 * t3 + 2.0 * t2 + 0.5 * t, 0.5 * t3 - 0.5 * t2};
}

// The grid goes on mirrored about its border's samples, as its cosines do.
int mirrored(int i, int count) {
  if (i < 0) i = -i;
  return i >= count ? 2 * (count - 1) - i : i;
}

// What is left at a depth of waves of number k over a bed: cosh k(h - d) / cosh kh, for any numbers.
double left_at(double k, double d, double bed) {
  d = std::min(d, bed);
  if (k * bed > 20.0 && k * (bed - d) > 20.0) return std::exp(-k * d);
  const double e = std::exp(-2.0 * k * bed);
  return std::exp(-k * d) * (1.0 + e * std::exp(2.0 * k * d)) / (1.0 + e);
}

// c = a b, of n x m and m x p values. Eight of a row at a time, so that they stay in registers.
void multiply(const double* a, const double* b, double* c, std::size_t n, std::size_t m, std::size_t p) {
  constexpr std::size_t block = 8;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t k = 0;
    for (; k + block <= p; k += block) {
      double sum[block] = {};
      for (std::size_t j = 0; j < m; ++j)
        for (std::size_t l = 0; l < block; ++l) sum[l] += a[i * m + j] * b[j * p + k + l];
      for (std::size_t l = 0; l < block; ++l) c[i * p + k + l] = sum[l];
    }
    for (; k < p; ++k) {
      double sum = 0.0;
      for (std::size_t j = 0; j < m; ++j) sum += a[i * m + j] * b[j * p + k];
      c[i * p + k] = sum;
    }
  }
}

void or_none(double& value, double otherwise) {
  if (!std::isfinite(value)) value = otherwise;
}

void keep_numbers(WaterHere& a) {
  or_none(a.still_m, 0.0);
  or_none(a.height_m, a.still_m);
  or_none(a.depth_m, 1e6);
  for (int axis = 0; axis < 3; ++axis) or_none(a.velocity_mps[axis], 0.0);
  for (int axis = 0; axis < 2; ++axis) or_none(a.current_mps[axis], 0.0);
}

}  // namespace

void WaterPatch::ask(const BodyWater& water, double time_s, const PatchBox& box, int most) {
  box_ = box;
  const double longer = std::max(box.half_m.x, box.half_m.y);
  const auto samples = [&](double half) {
    return std::clamp(int(std::ceil(double(most) * half / longer)), fewest_samples, std::max(most, fewest_samples));
  };
  const int columns = samples(box.half_m.x), rows = samples(box.half_m.y);
  if (columns != columns_) {
    const std::vector<double> rows_of = cosines(columns);
    cosines_x_.resize(rows_of.size());
    for (int m = 0; m < columns; ++m)  // transposed: along a row of the grid the inner loop runs over what comes out
      for (int i = 0; i < columns; ++i)
        cosines_x_[std::size_t(i * columns + m)] = rows_of[std::size_t(m * columns + i)];
  }
  if (rows != rows_) cosines_z_ = cosines(rows);
  columns_ = columns, rows_ = rows;
  step_m_ = 2.0 * box.half_m / glm::dvec2(columns - 1, rows - 1);
  per_step_ = 1.0 / step_m_;
  places_.clear();
  const glm::dvec2 across(-box.along.y, box.along.x);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      places_.push_back(box.centre_m + box.along * (i * step_m_.x - box.half_m.x) +
                        across * (j * step_m_.y - box.half_m.y));
  answers_.resize(places_.size());
  water.ask(time_s, std::max(step_m_.x, step_m_.y), places_, answers_);

  double depth = 0.0, highest = -1e300, lowest = 1e300, wet = 0.0;
  mean_ = still_ = 0.0, slope_ = {}, current_ = {};
  for (WaterHere& a : answers_) {
    keep_numbers(a);
    depth += a.depth_m, mean_ += a.height_m, still_ += a.still_m, current_ += a.current_mps;
    wet += a.dry ? 0.0 : 1.0;
    highest = std::max(highest, a.height_m), lowest = std::min(lowest, a.height_m);
  }
  const double count = double(answers_.size());
  depth /= count, mean_ /= count, still_ /= count, current_ /= count;
  dry_ = wet == 0.0, any_dry_ = wet < count;
  flat_ = highest == lowest;
  if (flat_) mean_ = highest;
  for (int level = 0; level < levels; ++level) {
    const double part = double(level) / (levels - 1);
    depths_m_[std::size_t(level)] = box.deepest_m * part * part;
  }
  rises_ = {};
  if (!flat_) fade(std::max(depth, 1e-3), water.wave_number());
}

void WaterPatch::fade(double bed_m, double wave_number) {
  bed_m_ = bed_m;
  long_number_ = std::clamp(wave_number, 0.0, std::numbers::pi / std::max(box_.half_m.x, box_.half_m.y));
  const std::size_t count = answers_.size();
  waves_.resize(count), faded_.resize(count);
  for (std::vector<double>& waves : faded_waves_) waves.resize(count);
  glm::dvec2 moment(0.0), square(0.0);
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec2 at(double(n % std::size_t(columns_)) * step_m_.x - box_.half_m.x,
                        double(n / std::size_t(columns_)) * step_m_.y - box_.half_m.y);
    moment += at * (answers_[n].height_m - mean_), square += at * at;
  }
  slope_ = moment / square;
  for (std::vector<double>& heads : heads_) heads.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec2 at(double(n % std::size_t(columns_)) * step_m_.x - box_.half_m.x,
                        double(n / std::size_t(columns_)) * step_m_.y - box_.half_m.y);
    heads_[0][n] = answers_[n].height_m - mean_ - glm::dot(slope_, at);
  }
  transform(heads_[0], waves_);
  // The transform is its own inverse but for a factor. What is left at the depths is kept for each wave.
  const double inverse = 4.0 / ((columns_ - 1.0) * (rows_ - 1.0));
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      const glm::dvec2 number(i / (2.0 * box_.half_m.x), j / (2.0 * box_.half_m.y));
      const std::array<double, levels> share = left(std::numbers::pi * glm::length(number), bed_m);
      const std::size_t n = std::size_t(j * columns_ + i);
      for (std::size_t level = 1; level < levels; ++level) faded_waves_[level][n] = waves_[n] * inverse * share[level];
    }
  for (std::size_t level = 1; level < levels; ++level) {
    transform(faded_waves_[level], heads_[level]);
    double rise = 0.0;
    for (std::size_t n = 0; n < count; ++n) rise += heads_[level][n] - heads_[level - 1][n];
    rise =
        rise / double(count) + (mean_ - still_) * (plane_fades(depths_m_[level]) - plane_fades(depths_m_[level - 1]));
    rises_[level] = rise / (depths_m_[level] - depths_m_[level - 1]);
  }
}

// What is left of waves of number k at each depth. The depths are D (l / 4)^2, so all follow from two exponentials:
// exp(-k D / 16) to the power of l^2, and to that of 16 - l^2 for what the bed sends back.
std::array<double, WaterPatch::levels> WaterPatch::left(double k, double bed) const {
  std::array<double, levels> out{};
  const double deepest = box_.deepest_m;
  if (bed < deepest) {
    for (std::size_t level = 0; level < levels; ++level) out[level] = left_at(k, depths_m_[level], bed);
    return out;
  }
  const double q = std::exp(-k * deepest / 16.0), q2 = q * q, q4 = q2 * q2, q8 = q4 * q4;
  out = {1.0, q, q4, q8 * q, q8 * q8};
  if (k * (2.0 * bed - deepest) > 40.0) return out;  // the bed is not felt, to rounding
  const double back = std::exp(-k * (2.0 * bed - deepest)), whole = 1.0 + back * out[4];
  const std::array<double, levels> returns{out[4], q8 * q4 * q2 * q, q8 * q4, q4 * q2 * q, 1.0};
  for (std::size_t level = 0; level < levels; ++level) out[level] = (out[level] + back * returns[level]) / whole;
  return out;
}

// A cosine transform of the first kind along both axes, as two products with matrices: for so few samples they beat any
// fast transform.
void WaterPatch::transform(const std::vector<double>& from, std::vector<double>& to) {
  const std::size_t columns = std::size_t(columns_), rows = std::size_t(rows_);
  multiply(from.data(), cosines_x_.data(), faded_.data(), rows, columns, columns);
  multiply(cosines_z_.data(), faded_.data(), to.data(), rows, rows, columns);
}

glm::dvec2 WaterPatch::from_centre(const glm::dvec2& place) const {
  const glm::dvec2 d = place - box_.centre_m;
  return {glm::dot(d, box_.along), d.y * box_.along.x - d.x * box_.along.y};
}

glm::dvec3 WaterPatch::plane_normal() const {
  const glm::dvec2 slope = box_.along * slope_.x + glm::dvec2(-box_.along.y, box_.along.x) * slope_.y;
  return glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
}

WaterPatch::Cell WaterPatch::cell(const glm::dvec2& place) const {
  const glm::dvec2 within = glm::clamp(from_centre(place), -box_.half_m, box_.half_m),
                   at = (within + box_.half_m) * per_step_;
  const int i = std::clamp(int(at.x), 0, columns_ - 2), j = std::clamp(int(at.y), 0, rows_ - 2);
  return {within, i, j, at.x - i, at.y - j};
}

WaterPatch::Taps WaterPatch::taps(const Cell& c) const {
  Taps out;
  out.x = weights(c.u), out.z = weights(c.v);
  for (int n = 0; n < 4; ++n) {
    out.column[std::size_t(n)] = std::size_t(mirrored(c.i + n - 1, columns_));
    out.row[std::size_t(n)] = std::size_t(mirrored(c.j + n - 1, rows_) * columns_);
  }
  return out;
}

double WaterPatch::smooth(const std::vector<double>& grid, const Taps& taps) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    const double* row = &grid[taps.row[j]];
    sum += taps.z[j] * (taps.x[0] * row[taps.column[0]] + taps.x[1] * row[taps.column[1]] +
                        taps.x[2] * row[taps.column[2]] + taps.x[3] * row[taps.column[3]]);
  }
  return sum;
}

double WaterPatch::plane_fades(double depth) const { return left_at(long_number_, depth, bed_m_); }

// Between two depths evenly; below the deepest as there.
double WaterPatch::faded(const Cell& c, const Taps& taps, double depth) const {
  const double part = std::sqrt(std::min(depth / box_.deepest_m, 1.0)) * (levels - 1);
  const std::size_t level = std::size_t(std::min(int(part), levels - 2));
  const double t = std::min((depth - depths_m_[level]) / (depths_m_[level + 1] - depths_m_[level]), 1.0);
  return still_ + (mean_ - still_ + glm::dot(slope_, c.within)) * plane_fades(depth) +
         (1.0 - t) * smooth(heads_[level], taps) + t * smooth(heads_[level + 1], taps);
}

double WaterPatch::head(const glm::dvec2& place, double depth) const {
  if (flat_) return mean_;
  const Cell c = cell(place);
  return depth > 0.0 ? faded(c, taps(c), depth) : mean_ + glm::dot(slope_, c.within) + smooth(heads_[0], taps(c));
}

WaterPatch::Met WaterPatch::meets(const glm::dvec3& at) const {
  const Cell c = cell({at.x, at.z});
  if (dry(c)) return {-1.0, -1.0, velocity(c)};
  if (flat_) return {mean_ - at.y, mean_ - at.y, velocity(c)};
  const Taps t = taps(c);
  const double depth = mean_ + glm::dot(slope_, c.within) + smooth(heads_[0], t) - at.y;
  // At the surface the pressure is the air's: the head is the depth, less what waves have faded by.
  return {depth, depth > 0.0 ? std::max(faded(c, t, depth) - at.y, 0.0) : depth, velocity(c)};
}

glm::dvec3 WaterPatch::velocity(const glm::dvec2& place) const { return velocity(cell(place)); }

glm::dvec3 WaterPatch::velocity(const Cell& c) const {
  const auto at = [&](int i, int j) { return answers_[std::size_t((c.j + j) * columns_ + c.i + i)].velocity_mps; };
  return (1.0 - c.v) * ((1.0 - c.u) * at(0, 0) + c.u * at(1, 0)) + c.v * ((1.0 - c.u) * at(0, 1) + c.u * at(1, 1));
}

bool WaterPatch::dry(const glm::dvec2& place) const { return any_dry_ && dry(cell(place)); }

bool WaterPatch::dry(const Cell& c) const {
  return any_dry_ && answers_[std::size_t((c.j + (c.v > 0.5 ? 1 : 0)) * columns_ + c.i + (c.u > 0.5 ? 1 : 0))].dry;
}

double WaterPatch::rise(double depth, double gravity) const {
  if (flat_) return 0.0;
  const double part = std::sqrt(std::clamp(depth / box_.deepest_m, 0.0, 1.0)) * (levels - 1);
  return gravity * rises_[std::size_t(std::min(int(part), levels - 2)) + 1];
}

}  // namespace seascape
