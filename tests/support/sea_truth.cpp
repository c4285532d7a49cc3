#include "tests/support/sea_truth.h"

namespace truth {

namespace {
// Swell's shape, gamma 6, which fades by a smooth step over ln w from sqrt(10) to sqrt(40) peak frequencies.
double swell_shape(double w, double alpha, double peak, double g) {
  const double t = std::clamp(std::log(w * w / (10.0 * peak * peak)) / std::log(4.0), 0.0, 1.0);
  return (1.0 - t * t * (3.0 - 2.0 * t)) * jonswap(w, alpha, peak, 6.0, g);
}
// dw/dk of Airy's dispersion without tension (Lamb 1932, art. 236).
double group_speed(double k, double g, double h) {
  const double kh = k * h, w = airy(k, g, h);
  return 0.5 * w / k * (1.0 + (kh > 300.0 ? 0.0 : 2.0 * kh / std::sinh(2.0 * kh)));
}
}  // namespace

SeaSpectrum::SeaSpectrum(const SeaCauses& causes)
    : causes_(causes),
      wind_(causes.u10, causes.fetch, causes.g, causes.gamma),
      short_waves_(causes.u10, std::clamp(causes.u10 * wind_.peak / causes.g, 0.84, 5.0), causes.g) {
  for (const SeaCauses::Swell& s : causes.swell) {
    const double peak = 2.0 * pi / s.period_s, g = causes.g;
    const auto over_log = [&](double x) { return std::exp(x) * swell_shape(std::exp(x), 1.0, peak, g); };
    const double unit =
        integral(over_log, std::log(0.3 * peak), std::log(7.0 * peak), 1e-9 * g * g * std::pow(peak, -4), 200);
    swell_alpha_.push_back(s.height * s.height / 16.0 / unit);
  }
  fourier_.resize(std::size_t(components()));
  for (int c = 0; c < components(); ++c)
    for (int i = 0; i < nodes; ++i) {
      Fourier f;
      f.variance = over_k(c, k_of(i));
      double sum = 0.0;
      // Half a turn, the other being its mirror; ends count half.
      for (int a = 0; f.variance > 0.0 && a <= angles / 2; ++a) {
        const double angle = 2.0 * pi * a / angles;
        const double d = spread(c, k_of(i), angle) * (a == 0 || a == angles / 2 ? 1.0 : 2.0);
        sum += d;
        f.first += d * std::cos(angle);
        f.second += d * std::cos(2.0 * angle);
      }
      if (sum > 0.0) {
        f.first /= sum;
        f.second /= sum;
        f.norm = 1.0 / (sum * 2.0 * pi / angles);
      }
      fourier_[std::size_t(c)].push_back(f);
    }
}

double SeaSpectrum::to_rad(int component) const {
  return (component < 2 ? causes_.wind_to_deg : causes_.swell[std::size_t(component - 2)].to_deg) * pi / 180.0;
}

double SeaSpectrum::over_k(int component, double k) const {
  const double g = causes_.g, h = causes_.depth, w = airy(k, g, h), deep_k = w * w / g;
  if (component >= 2) {
    const std::size_t i = std::size_t(component - 2);
    return swell_shape(w, swell_alpha_[i], 2.0 * pi / causes_.swell[i].period_s, g) * group_speed(k, g, h);
  }
  const double share = short_share(deep_k, wind_.peak * wind_.peak / g);
  if (component == 0)
    return share == 1.0
               ? 0.0
               : (1.0 - share) * wind_.at(w) * (causes_.tma ? depth_factor(w, g, h) : 1.0) * group_speed(k, g, h);
  if (share == 0.0) return 0.0;
  return share * (short_waves_.low(deep_k) * short_waves_.fed(deep_k) + short_waves_.high(deep_k)) / (k * k * k);
}

double SeaSpectrum::spread(int component, double k, double angle) const {
  const double w = airy(k, causes_.g, causes_.depth);
  if (component == 0) return donelan_banner(angle, w / wind_.peak);
  if (component >= 2) return std::pow(std::abs(std::cos(angle / 2.0)), 50.0);
  const double c = std::cos(angle), sense = (15.0 * c - 10.0 * c * c * c + 3.0 * std::pow(c, 5.0)) / 8.0;
  return (1.0 + short_waves_.delta(k) * std::cos(2.0 * angle)) * (1.0 + sense);
}

double SeaSpectrum::over_vector(double kx, double kz) const {
  const double k = std::hypot(kx, kz), direction = std::atan2(kx, -kz), at = std::log(k / 1e-4) / step;
  if (!(at >= 0.0 && at < nodes - 1)) return 0.0;
  const std::size_t i = std::size_t(at);
  double sum = 0.0, all = 0.0;
  for (const std::vector<Fourier>& f : fourier_) all += f[i].variance;
  for (int c = 0; c < components(); ++c) {
    const Fourier &low = fourier_[std::size_t(c)][i], &high = fourier_[std::size_t(c)][i + 1];
    if (low.variance <= 1e-4 * all) continue;
    const double t = at - double(i), norm = low.norm + t * (high.norm - low.norm);
    const double variance = low.variance + t * (high.variance - low.variance);
    sum += variance / k * norm * spread(c, k, std::remainder(direction - to_rad(c), 2.0 * pi));
  }
  return sum;
}

void SeaSpectrum::add(SeaMoments& sum, int component, int node, double share) const {
  const double k = k_of(node);
  const Fourier& f = fourier_[std::size_t(component)][std::size_t(node)];
  const double variance = share > 0.0 ? share * step * k * f.variance : 0.0;
  if (!(variance > 0.0)) return;
  const double w = airy(k, causes_.g, causes_.depth, 7.17e-5), to = to_rad(component);
  sum.m0 += variance;
  sum.w2 += variance * w * w;
  const double width = std::min(1.0 / std::tanh(k * causes_.depth), 8.0);
  sum.u2 += variance * w * w * width * width;
  sum.w1.x += variance * w * width * f.first * std::sin(to);
  sum.w1.z -= variance * w * width * f.first * std::cos(to);
  // Unit vectors (sin, -cos): twice them, averaged, is half of 1 -+ second cos 2 to, and -half of second sin 2 to.
  const double c2 = f.second * std::cos(2.0 * to), s2 = f.second * std::sin(2.0 * to);
  const auto add_to = [&](Tensor& t, double power) {
    t.xx += 0.5 * variance * power * (1.0 - c2);
    t.zz += 0.5 * variance * power * (1.0 + c2);
    t.xz -= 0.5 * variance * power * s2;
  };
  add_to(sum.k0_wide, width * width);
  add_to(sum.k1, k);
  add_to(sum.k2, k * k);
  add_to(sum.k1_wide, k * width);
  add_to(sum.k2_wide, k * k * width * width);
}

}  // namespace truth
