#include "ocean/places/dynamic_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "ocean/waves/dispersion.h"

namespace seascape {

namespace {
constexpr double most_squeeze = 0.8;
constexpr float most_half = 65504.0f;  // what textures of half floats hold
}  // namespace

DynamicSurface::DynamicSurface(const DynamicWavesSettings& settings) : settings_(settings) {
  validate(settings);
  plan_ = make_fft_plan(settings.windows.resolution, settings.windows.resolution / 4);
  levels_.resize(std::size_t(settings.windows.slices));
  const std::size_t n = std::size_t(settings.windows.resolution), texels = n * n, waves = texels / 16;
  for (Level& level : levels_) {
    level.shift.assign(texels, glm::vec4(0.0f));
    level.slope.assign(texels, glm::vec4(0.0f));
    for (auto* list : {&level.re, &level.im}) list->resize(n * (n + 16));
    for (auto* list : {&level.spectrum_re, &level.spectrum_im}) list->resize(waves);
    level.workspace.resize(inverse_fft_floats(plan_));
  }
}

void DynamicSurface::evaluate(const WaveLevel& waves, Level& level, double border_m, double ahead_s) {
  const int n = plan_.n, band = plan_.band, stride = n + 16;
  std::span<const std::complex<double>> modes = waves.modes();
  if (ahead_s > 0.0) {
    const double left = std::exp(-0.5 * settings_.damping_per_s * ahead_s);
    level.ahead.resize(modes.size());
    for (std::size_t i = 0; i < modes.size(); ++i)
      level.ahead[i] = modes[i] * std::polar(left, -waves.frequency()[i] * ahead_s);
    modes = level.ahead;
  }
  const double step = 2.0 * std::numbers::pi / (n * level.texel_m);
  if (level.widths.empty() || level.widths_texel_m != level.texel_m || level.widths_depth_m != waves.depth_m()) {
    level.widths.assign(modes.size(), 0.0);
    level.widths_texel_m = level.texel_m, level.widths_depth_m = waves.depth_m();
    for (int j = 0; j < band; ++j)
      for (int i = 0; i < band; ++i) {
        const double k = step * std::hypot(double(i - band / 2), double(j - band / 2));
        if (k > 0.0)
          level.widths[std::size_t(j) * std::size_t(band) + std::size_t(i)] =
              settings_.sharpening * orbit_width(k, waves.depth_m()) / k;
      }
  }
  for (int pair = 0; pair < (velocity_ ? 6 : 4); ++pair) {
    for (int j = 0; j < band; ++j)
      for (int i = 0; i < band; ++i) {
        const std::size_t at = std::size_t(j) * std::size_t(band) + std::size_t(i);
        double re = 0.0, im = 0.0;
        if (waves.share()[at] > 0.0) {
          // The height h is the field's real part: of each wave and its opposite the mean. Two real fields f and g are
          // sent as f + i g; D = i k (width / |k|) h.
          const std::size_t opposite = std::size_t(band - j) * std::size_t(band) + std::size_t(band - i);
          const bool rate = pair >= 4;
          const auto mode = [&](std::size_t wave) {
            return rate ? modes[wave] * std::complex<double>(-0.5 * settings_.damping_per_s, -waves.frequency()[wave])
                        : modes[wave];
          };
          const std::complex<double> one = mode(at), other = mode(opposite);
          const double h_re = 0.5 * (one.real() + other.real()), h_im = 0.5 * (one.imag() - other.imag());
          const double kx = step * (i - band / 2), kz = step * (j - band / 2), width = level.widths[at];
          if (pair == 0 || pair == 4)
            re = -kx * width * h_im - h_im, im = kx * width * h_re + h_re;  // Dx, h
          else if (pair == 1)
            re = -kz * width * h_im + kx * kz * width * h_im,
            im = kz * width * h_re - kx * kz * width * h_re;  // Dz, dDx/dz
          else if (pair == 5)
            re = -kz * width * h_im, im = kz * width * h_re;  // Dz
          else if (pair == 2)
            re = -kx * h_im - kz * h_re, im = kx * h_re - kz * h_im;  // dh/dx, dh/dz
          else
            re = width * (-kx * kx * h_re + kz * kz * h_im),
            im = width * (-kx * kx * h_im - kz * kz * h_re);  // dDx/dx, dDz/dz
        }
        level.spectrum_re[at] = float(re), level.spectrum_im[at] = float(im);
      }
    inverse_fft(plan_, level.spectrum_re.data(), level.spectrum_im.data(), level.re.data(), level.im.data(), stride,
                level.workspace);
    std::vector<glm::vec4>& plane = pair < 2 ? level.shift : pair < 4 ? level.slope : level.velocity;
    const int first = pair % 2 * 2;
    for (int z = 0; z < n; ++z)
      for (int x = 0; x < n; ++x) {
        glm::vec4& texel = plane[std::size_t(z) * std::size_t(n) + std::size_t(x)];
        const std::size_t from = std::size_t(z) * std::size_t(stride) + std::size_t(x);
        texel[first] = std::clamp(level.re[from], -most_half, most_half),
        texel[first + 1] = std::clamp(level.im[from], -most_half, most_half);
      }
  }
  // The most that the water is squeezed in any direction: minus the least eigenvalue of grad D. The fading of the
  // window adds at most D over its width.
  float squeeze = 0.0f, farthest = 0.0f, highest = 0.0f, bent = 0.0f;
  glm::dvec3 moments(0.0);
  const std::size_t side = std::size_t(n);
  for (std::size_t i = 0; i < level.shift.size(); ++i) {
    const float xx = level.slope[i].z, zz = level.slope[i].w, xz = level.shift[i].w, half = 0.5f * (xx - zz);
    // More than before? Asked of squares, for roots are dear.
    const float wider = squeeze + 0.5f * (xx + zz), across = half * half + xz * xz;
    if (wider < 0.0f || across > wider * wider) squeeze = std::sqrt(across) - 0.5f * (xx + zz);
    farthest = std::max(farthest, level.shift[i].x * level.shift[i].x + level.shift[i].z * level.shift[i].z);
    highest = std::max(highest, std::abs(level.shift[i].y));
    const glm::vec4& s = level.slope[i];
    moments += glm::dvec3(s.x * s.x, s.y * s.y, s.x * s.y);
    // What its slopes differ by from the next column's and row's: of the Hessian's norm (Frobenius) the square, times a
    // texel's.
    const glm::vec4& east = level.slope[(i + 1) % side != 0 ? i + 1 : i + 1 - side];
    const glm::vec4& north = level.slope[i + side < level.slope.size() ? i + side : i + side - level.slope.size()];
    const float across_x = east.x - s.x, across_z = north.y - s.y, twist_x = east.y - s.y, twist_z = north.x - s.x;
    bent = std::max(bent, across_x * across_x + across_z * across_z + twist_x * twist_x + twist_z * twist_z);
  }
  level.extent = {highest, std::sqrt(double(farthest)), std::sqrt(double(bent)) / level.texel_m,
                  moments / double(level.shift.size())};
  level.squeeze = double(squeeze) + std::sqrt(double(farthest)) / border_m;
}

void DynamicSurface::evaluate(const DynamicWaves& waves, double ahead_s, bool velocity) {
  velocity_ = velocity;
  placement_ = waves.placement();
  windows_ = lod_windows(settings_.windows, placement_, placement_.viewer);
  tbb::parallel_for(0, int(levels_.size()), [&](int i) {
    Level& level = levels_[std::size_t(i)];
    level.texel_m = waves.level(i).texel_m();
    level.still = waves.level(i).still();
    level.squeeze = 0.0;
    level.extent = {};
    if (velocity) level.velocity.resize(level.shift.size());
    if (!level.still) evaluate(waves.level(i), level, gpu::lod_border * windows_.reach.x * std::exp2(i), ahead_s);
  });
  double squeeze = 0.0;
  for (const Level& level : levels_) squeeze += level.squeeze;
  share_ = squeeze > most_squeeze ? most_squeeze / squeeze : 1.0;
}

DynamicSurface::Extent DynamicSurface::extent(int level) const {
  Extent result = levels_[std::size_t(level)].extent;
  result.shift_m *= share_;
  return result;
}

DynamicSample DynamicSurface::sea(glm::dvec2 rest, double footprint) const {
  DynamicSample sum;
  const float distance = gpu::lod_distance(glm::vec2(rest - placement_.viewer));
  const int n = plan_.n;
  for (int i = 0; i < int(levels_.size()); ++i) {
    const Level& level = levels_[std::size_t(i)];
    if (level.still) continue;
    double weight =
        gpu::lod_present(windows_.reach, i, distance) * std::clamp(2.0 - footprint / (4.0 * level.texel_m), 0.0, 1.0);
    if (i == 0) weight *= 1.0 - double(windows_.reach.z);
    if (!(weight > 0.0)) continue;
    const glm::dvec2 at = rest / level.texel_m - 0.5, cell = glm::floor(at), f = at - cell;
    const LodIndex w(cell);
    glm::dvec4 shift(0.0), slope(0.0);
    for (int k = 0; k < 4; ++k) {
      const std::size_t texel =
          std::size_t((w.y + (k >> 1)) & (n - 1)) * std::size_t(n) + std::size_t((w.x + (k & 1)) & (n - 1));
      const double share = weight * ((k & 1) != 0 ? f.x : 1.0 - f.x) * ((k >> 1) != 0 ? f.y : 1.0 - f.y);
      shift += share * glm::dvec4(level.shift[texel]);
      slope += share * glm::dvec4(level.slope[texel]);
    }
    sum.displacement += glm::dvec3(share_ * shift.x, shift.y, share_ * shift.z);
    sum.height_gradient += glm::dvec2(slope.x, slope.y);
    sum.shift_gradient += share_ * glm::dvec3(slope.z, slope.w, shift.w);
  }
  return sum;
}

}  // namespace seascape
