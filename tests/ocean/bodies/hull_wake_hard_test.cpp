// The wake of Wigley's hull in dynamic waves on deep water against Kelvin, Michell and Noblesse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "ocean/bodies/hull_wake.h"
#include "ocean/places/dynamic_waves.h"
#include "tests/support/body_waves.h"
#include "tests/support/hull_wake_truth.h"
#include "tests/support/wake_truth.h"

namespace seascape {
namespace {

using namespace test;
using Complex = std::complex<double>;
constexpr double length_m = 10.0, beam_m = 1.0, draught_m = 0.625;

struct Tow {
  double froude = 0.4, course_deg = 0.0, seconds = 30.0;
  std::vector<double> frames_s{1.0 / 60.0};  // one after the other, over and over
  glm::dvec2 viewer_m{4.0, 0.0};             // behind the hull's middle, and to its right
  int samples = 256;
  double texel_m = 0.125;
  int levels = 3;
};

// The waves behind the hull after its way, in a frame of its own: x behind its middle, y to its right.
class TowedHull {
 public:
  explicit TowedHull(const Tow& tow) : waves_(settings(tow)), speed(tow.froude * std::sqrt(g * length_m)) {
    static const HullWake wake(wigley_hull(length_m, beam_m, draught_m, 0.4, 64, 40), 20);
    const double turn = tow.course_deg * truth::pi / 180.0;
    ahead_ = {std::sin(turn), -std::cos(turn)}, right_ = {-ahead_.y, ahead_.x};
    HullMotion motion;
    motion.pose.to_world = about({0.0, 1.0, 0.0}, -turn);
    motion.velocity.linear = speed * glm::dvec3(ahead_.x, 0.0, ahead_.y);
    std::vector<HullSection> cut(std::size_t(wake.sections()));
    std::vector<WaveSource> sources;
    double time_s = 0.0;
    for (std::size_t i = 0; time_s < tow.seconds - 1e-9; ++i) {
      const double frame_s = tow.frames_s[i % tow.frames_s.size()];
      time_s += frame_s;
      middle_ = (speed * time_s) * ahead_;
      motion.pose.centre_m = {middle_.x, 0.0, middle_.y};
      sources.clear();
      wake.cut(
          motion, [](const glm::dvec2&) { return 0.0; }, cut);
      wake.add_sources(motion, cut, 8.0 * tow.texel_m, sources);
      waves_.advance(frame_s, lod_placement(waves_.settings().windows, at(tow.viewer_m), {}), sources);
    }
  }
  // Height and quarter there: the sum of all waves of all levels, exactly.
  Complex wave(double behind, double right) const {
    Complex sum = 0.0;
    for (int l = 0; l < waves_.levels(); ++l) {
      const WaveLevel& level = waves_.level(l);
      const int n = level.samples(), band = n / 4;
      const glm::dvec2 p = at({behind, right}) / level.texel_m() - 0.5;
      std::vector<Complex> of_x(std::size_t(band), 0.0);
      for (int i = 0; i < band; ++i) of_x[std::size_t(i)] = std::polar(1.0, 2.0 * truth::pi * (i - band / 2) * p.x / n);
      for (int j = 0; j < band; ++j) {
        Complex row = 0.0;
        const Complex* modes = level.modes().data() + std::ptrdiff_t(j) * band;
        for (int i = 0; i < band; ++i) {
          const Complex a = modes[i], b = of_x[std::size_t(i)];
          row += Complex(a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real());
        }
        sum += row * std::polar(1.0, 2.0 * truth::pi * (j - band / 2) * p.y / n);
      }
    }
    return sum;
  }
  // The drag (N) that the waves take along a cut across the wake: of each wave's energy what it is left behind by, E
  // (1 - cos^2 theta / 2), for its energy goes at half of its speed U cos theta (Eggers, Sharma and Ward 1967). A wave
  // of number k across the cut is the one that stands still behind the hull: k = (g / U^2) sin theta / cos^2 theta.
  double drag(double behind, double half_m) const {
    constexpr int count = 192;
    std::vector<Complex> cut;
    for (int i = 0; i < count; ++i) cut.push_back(wave(behind, ((i + 0.5) / count * 2.0 - 1.0) * half_m));
    const double k0 = g / (speed * speed);
    double sum = 0.0;
    for (int m = -count / 2 + 1; m < count / 2; ++m) {
      Complex a = 0.0;
      for (int i = 0; i < count; ++i)
        a += cut[std::size_t(i)] * std::polar(1.0 / count, -2.0 * truth::pi * m * i / count);
      const double k = truth::pi * std::abs(m) / half_m,
                   s = m == 0 ? 0.0 : (std::sqrt(k0 * k0 + 4.0 * k * k) - k0) / (2.0 * k);
      sum += std::norm(a) * (1.0 - 0.5 * (1.0 - s * s));
    }
    return 0.5 * rho * g * sum * 2.0 * half_m;
  }
  // Of the waves along its way, m: how far it is from where they have turned once to where they have again.
  double wavelength(double from, double to) const {
    double turned = 0.0;
    constexpr double step = 0.1;
    for (double x = from; x < to; x += step) turned += std::arg(wave(x + step, 0.0) / wave(x, 0.0));
    const double way = std::ceil((to - from) / step - 1e-9) * step;
    return 2.0 * truth::pi * way / std::abs(turned);
  }
  // What all levels together carry of a wave of number k.
  double share(double k) const {
    double sum = 0.0;
    for (int i = 0; i < waves_.levels(); ++i)
      sum += wave_share(2.0 * truth::pi / (k * waves_.level(i).texel_m()), i + 1 == waves_.levels(),
                        waves_.level(i).samples());
    return sum;
  }

 private:
  static DynamicWavesSettings settings(const Tow& tow) {
    DynamicWavesSettings s;
    s.windows = {.resolution = tow.samples, .slices = tow.levels, .texel_m = tow.texel_m};
    s.damping_per_s = 0.0, s.idle_m = 0.0;
    return s;
  }
  glm::dvec2 at(const glm::dvec2& place) const { return middle_ - place.x * ahead_ + place.y * right_; }
  DynamicWaves waves_;
  glm::dvec2 ahead_, right_, middle_{0.0};

 public:
  const double speed;
};

double michell(double u) {
  return truth::wave_drag(
      u, g, rho, [&](double kx, double kz) { return truth::wigley_sends(length_m, beam_m, draught_m, u, kx, kz); });
}

// How high the waves of Michell's hull are by Havelock's integral over all that stand still behind it, but for a
// factor.
double havelock(double u, double behind, double across, const std::function<double(double)>& share) {
  const double k0 = g / (u * u);
  constexpr int pieces = 8000;
  Complex sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double t = 16.0 * (i + 0.5) / pieces - 8.0, c = 1.0 / std::sqrt(1.0 + t * t), k = k0 / (c * c),
                 part = share(k);
    if (part > 0.0)
      sum += part / c * truth::wigley_sends(length_m, beam_m, draught_m, u, k * c, k * c * t) *
             std::polar(1.0, k * c * (behind + across * t));
  }
  return std::abs(sum);
}

double degrees(double across, double behind) { return std::atan2(across, behind) * 180.0 / truth::pi; }

// Where a height is greatest along a line across the wake.
double greatest(const std::function<double(double)>& height, double to_m, double step_m) {
  double best = 0.0, at = 0.0;
  for (double y = 0.0; y < to_m; y += step_m)
    if (const double here = height(y); here > best) best = here, at = y;
  return at;
}

bool asked_for_long() {
  const char* asked = std::getenv("SEASCAPE_LONG");
  return asked && std::string(asked) == "1";
}

// Kelvin's angle, seen from the bow: where beyond the outermost crest the waves fall to what they are on the line where
// rays fold over.
double envelope_degrees(const TowedHull& hull) {
  double sum = 0.0;
  int lines = 0;
  for (double behind = 16.0; behind < 33.0; behind += 4.0, ++lines) {
    constexpr double step = 0.1;
    std::vector<double> high;
    double best = 0.0;
    for (double y = 0.0; y < 19.0; y += step)
      high.push_back(std::abs(hull.wave(behind, y))), best = std::max(best, high.back());
    std::size_t at = 0;
    for (std::size_t i = 1; i + 1 < high.size(); ++i)
      if (high[i] > high[i - 1] && high[i] >= high[i + 1] && high[i] > 0.4 * best) at = i;
    const double crest = high[at];
    while (at + 1 < high.size() && high[at] > truth::airy_at_fold() * crest) ++at;
    sum += degrees(double(at) * step, behind + 0.5 * length_m);
  }
  return sum / lines;
}

// Issue 11's bars on deep water: the envelope of the wake 19.47 +- 1.5 degrees, transverse waves 2 pi U^2 / g +- 3 %,
// the waves' energy Michell's drag within 10 %. Measured: 20.1 and 19.6 degrees at Froude 0.4 and 0.25, -1.3 and +1.3
// %, and 1.04, 0.93, 1.05 and 0.98 of Michell's drag at 0.4, 0.25, 0.30 and 0.35. Froude 0.4; with SEASCAPE_LONG four
// speeds. Where bow and stern waves cancel each other (Froude 0.35) the rest has no wavelength of its own: it is not
// asked for. Controls: sources' depth forgotten (drag); gravity a tenth lower (drag and wavelength); water 0.8 m deep
// (all three); sources three times as long (drag). All seen.
TEST(HullWakeHard, IsKelvinsAndTakesMichellsDrag) {
  for (const double froude : {0.40, 0.25, 0.30, 0.35}) {
    Tow tow{.froude = froude, .viewer_m = {10.0, 0.0}, .samples = 512};
    tow.seconds = std::round(160.0 / (froude * std::sqrt(g * length_m)));
    const TowedHull hull(tow);
    const double transverse = 2.0 * truth::pi * hull.speed * hull.speed / g, want = michell(hull.speed);
    for (const double behind : {14.0, 19.0, 24.0}) {
      EXPECT_NEAR(hull.drag(behind, 21.0) / want, 1.0, 0.1) << froude << " at " << behind;
    }
    const double wave = hull.wavelength(7.0, 32.0) / transverse;
    if (froude == 0.40 || froude == 0.25) {
      EXPECT_NEAR(envelope_degrees(hull), truth::kelvin_degrees(), 1.5) << froude;
      EXPECT_NEAR(wave, 1.0, 0.03) << froude;
    }
    if (!asked_for_long()) break;
  }
}

// At Froude 0.8 and 1 the highest waves stand where Havelock's integral has them for this hull, within 0.7 degrees on
// average over 16 to 36 m behind it, waves of the same lengths counted; and narrow as 1 / Fr^2. Issue 11's 0.14 / Fr^2
// rad (Noblesse et al. 2014) within 15 % holds there for waves from 2 m on. That is this hull's near wake: by the
// integral the peak of all its waves far behind stands at 0.10 / Fr^2 rad. Controls: gravity a tenth lower; sources
// three times as long; both seen.
TEST(HullWakeHard, NarrowsAtSpeed) {
  double first = 0.0;
  for (const double froude : {0.8, 1.0}) {
    Tow tow{.froude = froude, .viewer_m = {16.0, 0.0}, .texel_m = 0.25};
    tow.seconds = std::round(150.0 / (froude * std::sqrt(g * length_m)));
    const TowedHull hull(tow);
    double is = 0.0, want = 0.0;
    int lines = 0;
    for (double behind = 16.0; behind < 37.0; behind += 4.0, ++lines) {
      is += degrees(greatest([&](double y) { return std::abs(hull.wave(behind, y)); }, 12.0, 0.1), behind);
      want += degrees(
          greatest([&](double y) { return havelock(hull.speed, behind, y, [&](double k) { return hull.share(k); }); },
                   12.0, 0.2),
          behind);
    }
    is /= lines, want /= lines;
    EXPECT_NEAR(is, want, 0.7) << froude;
    if (froude == 0.8) {
      EXPECT_NEAR(is * truth::pi / 180.0, 0.14 / (froude * froude), 0.15 * 0.14 / (froude * froude));
      first = is;
    } else {
      EXPECT_LT(is, 0.9 * first);
    }
  }
}

// How far the waves behind two hulls differ, as a share of them.
double difference(const TowedHull& one, const TowedHull& other, double from_right, double to_right) {
  double sum = 0.0, all = 0.0;
  for (double x = 6.5; x < 13.0; x += 0.7)
    for (double y = from_right; y <= to_right; y += 0.5) {
      sum += std::norm(one.wave(x, y) - other.wave(x, y));
      all += std::norm(one.wave(x, y));
    }
  return std::sqrt(sum / all);
}

// The same wake on any course, at any frame rate, and near a window's border: of the waves' height 1 % other on another
// course, 0.3 % at other frame rates, and 1.5 % where the border begins 1 m before the bow or takes one side of the
// wake. Controls: north counted a tenth shorter (course); sources that do not move within a frame (0.07); sources that
// fade a third of the window before its border. All seen.
TEST(HullWakeHard, IsTheSameOnAnyCourseAtAnyRateAndNearTheBorder) {
  const Tow plain{.froude = 0.35, .seconds = 20.0};
  const TowedHull hull(plain);
  for (const double course : {17.0, 45.0, 90.0}) {
    Tow tow = plain;
    tow.course_deg = course;
    const double d = difference(hull, TowedHull(tow), -6.0, 6.0);
    EXPECT_LT(d, 0.01) << course;
  }
  for (const std::vector<double>& frames :
       {std::vector<double>{1.0 / 20.0}, {1.0 / 72.0}, {1.0 / 90.0}, {1.0 / 40.0, 1.0 / 120.0, 1.0 / 60.0}}) {
    Tow tow = plain;
    tow.frames_s = frames;
    const double d = difference(hull, TowedHull(tow), -6.0, 6.0);
    EXPECT_LT(d, 0.003) << frames[0];
  }
  for (const glm::dvec2& viewer : {glm::dvec2(6.0, 0.0), glm::dvec2(4.0, 6.0), glm::dvec2(4.0, 9.0)}) {
    Tow tow = plain;
    tow.viewer_m = viewer;
    const double d = difference(hull, TowedHull(tow), viewer.y > 0.0 ? 0.0 : -6.0, 6.0);
    EXPECT_LT(d, 0.015) << viewer.x << " " << viewer.y;
  }
}

}  // namespace
}  // namespace seascape
