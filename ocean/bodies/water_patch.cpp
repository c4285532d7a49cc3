#include "ocean/bodies/water_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seascape {
namespace {

constexpr int fewest_samples = 6;

std::vector<double> cosines(int count) {
  std::vector<double> out(std::size_t(2 * (count - 1)));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::cos(std::numbers::pi * double(i) / (count - 1));
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
double left(double k, double d, double bed) {
  d = std::min(d, bed);
  const double e = std::exp(-2.0 * k * bed);
  return std::exp(-k * d) * (1.0 + e * std::exp(2.0 * k * d)) / (1.0 + e);
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
  if (columns != columns_) cosines_x_ = cosines(columns);
  if (rows != rows_) cosines_z_ = cosines(rows);
  columns_ = columns, rows_ = rows;
  step_m_ = 2.0 * box.half_m / glm::dvec2(columns - 1, rows - 1);
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
  waves_.resize(count), faded_.resize(count), scratch_.resize(count), numbers_.resize(count);
  glm::dvec2 moment(0.0), square(0.0);
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec2 at(double(n % std::size_t(columns_)) * step_m_.x - box_.half_m.x,
                        double(n / std::size_t(columns_)) * step_m_.y - box_.half_m.y);
    moment += at * (answers_[n].height_m - mean_), square += at * at;
  }
  slope_ = moment / square;
  heads_[0].resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec2 at(double(n % std::size_t(columns_)) * step_m_.x - box_.half_m.x,
                        double(n / std::size_t(columns_)) * step_m_.y - box_.half_m.y);
    heads_[0][n] = answers_[n].height_m - mean_ - glm::dot(slope_, at);
  }
  transform(heads_[0], waves_);
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      const std::size_t n = std::size_t(j * columns_ + i);
      numbers_[n] = std::numbers::pi * std::hypot(i / (2.0 * box_.half_m.x), j / (2.0 * box_.half_m.y));
      waves_[n] *= 4.0 / ((columns_ - 1.0) * (rows_ - 1.0));  // the transform is its own inverse but for this
    }
  for (std::size_t level = 1; level < levels; ++level) {
    for (std::size_t n = 0; n < count; ++n) scratch_[n] = waves_[n] * left(numbers_[n], depths_m_[level], bed_m);
    heads_[level].resize(count);
    transform(scratch_, heads_[level]);
    double rise = 0.0;
    for (std::size_t n = 0; n < count; ++n) rise += heads_[level][n] - heads_[level - 1][n];
    rise =
        rise / double(count) + (mean_ - still_) * (plane_fades(depths_m_[level]) - plane_fades(depths_m_[level - 1]));
    rises_[level] = rise / (depths_m_[level] - depths_m_[level - 1]);
  }
}

// A cosine transform of the first kind along both axes, the samples at either end counted half.
void WaterPatch::transform(const std::vector<double>& from, std::vector<double>& to) {
  const int turn_x = 2 * (columns_ - 1), turn_z = 2 * (rows_ - 1);
  for (int j = 0; j < rows_; ++j)
    for (int m = 0; m < columns_; ++m) {
      const double* row = &from[std::size_t(j * columns_)];
      double sum = 0.5 * (row[0] + (m % 2 != 0 ? -1.0 : 1.0) * row[columns_ - 1]);
      for (int i = 1; i < columns_ - 1; ++i) sum += row[i] * cosines_x_[std::size_t(i * m % turn_x)];
      faded_[std::size_t(j * columns_ + m)] = sum;
    }
  for (int m = 0; m < rows_; ++m)
    for (int i = 0; i < columns_; ++i) {
      const auto at = [&](int j) { return faded_[std::size_t(j * columns_ + i)]; };
      double sum = 0.5 * (at(0) + (m % 2 != 0 ? -1.0 : 1.0) * at(rows_ - 1));
      for (int j = 1; j < rows_ - 1; ++j) sum += at(j) * cosines_z_[std::size_t(j * m % turn_z)];
      to[std::size_t(m * columns_ + i)] = sum;
    }
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
  const glm::dvec2 at = (glm::clamp(from_centre(place), -box_.half_m, box_.half_m) + box_.half_m) / step_m_;
  const int i = std::clamp(int(at.x), 0, columns_ - 2), j = std::clamp(int(at.y), 0, rows_ - 2);
  return {i, j, at.x - i, at.y - j};
}

double WaterPatch::smooth(const std::vector<double>& grid, const Cell& c) const {
  const std::array<double, 4> wx = weights(c.u), wz = weights(c.v);
  double sum = 0.0;
  for (int j = 0; j < 4; ++j) {
    const int row = mirrored(c.j + j - 1, rows_) * columns_;
    double along = 0.0;
    for (int i = 0; i < 4; ++i) along += wx[std::size_t(i)] * grid[std::size_t(row + mirrored(c.i + i - 1, columns_))];
    sum += wz[std::size_t(j)] * along;
  }
  return sum;
}

double WaterPatch::plane_fades(double depth) const { return left(long_number_, depth, bed_m_); }

double WaterPatch::head(const glm::dvec2& place, double depth) const {
  if (flat_) return mean_;
  const double plane =
      still_ + (mean_ - still_ + glm::dot(slope_, glm::clamp(from_centre(place), -box_.half_m, box_.half_m))) *
                   (depth > 0.0 ? plane_fades(depth) : 1.0);
  const Cell c = cell(place);
  if (!(depth > 0.0)) return plane + smooth(heads_[0], c);
  // Between two depths evenly; below the deepest as there.
  const double part = std::sqrt(std::min(depth / box_.deepest_m, 1.0)) * (levels - 1);
  const std::size_t level = std::size_t(std::min(int(part), levels - 2));
  const double t = std::min((depth - depths_m_[level]) / (depths_m_[level + 1] - depths_m_[level]), 1.0);
  return plane + (1.0 - t) * smooth(heads_[level], c) + t * smooth(heads_[level + 1], c);
}

glm::dvec3 WaterPatch::velocity(const glm::dvec2& place) const {
  const Cell c = cell(place);
  const auto at = [&](int i, int j) { return answers_[std::size_t((c.j + j) * columns_ + c.i + i)].velocity_mps; };
  return (1.0 - c.v) * ((1.0 - c.u) * at(0, 0) + c.u * at(1, 0)) + c.v * ((1.0 - c.u) * at(0, 1) + c.u * at(1, 1));
}

bool WaterPatch::dry(const glm::dvec2& place) const {
  if (!any_dry_) return false;
  const Cell c = cell(place);
  return answers_[std::size_t((c.j + (c.v > 0.5 ? 1 : 0)) * columns_ + c.i + (c.u > 0.5 ? 1 : 0))].dry;
}

double WaterPatch::rise(double depth, double gravity) const {
  if (flat_) return 0.0;
  const double part = std::sqrt(std::clamp(depth / box_.deepest_m, 0.0, 1.0)) * (levels - 1);
  return gravity * rises_[std::size_t(std::min(int(part), levels - 2)) + 1];
}

}  // namespace seascape
