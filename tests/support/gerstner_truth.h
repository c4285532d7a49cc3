// Gerstner's waves in closed form, in double: Gerstner (1804), Fournier and Reeves (1986). Nothing here includes or
// repeats a line of the code it judges.
#pragma once
#include <cmath>
#include <vector>

namespace truth {

inline constexpr double pi_of_gerstner = 3.14159265358979323846264338327950288;

struct Trochoid {
  double kx = 0.0, kz = 0.0;  // rad/m
  double a = 0.0;             // metres
  double phase = 0.0;         // rad, of a crest at the origin and time 0: 0
  double chop = 1.0;          // horizontal over vertical radius
  long double w = 0.0L;       // rad/s
};

// Airy (1845) with the tension of sea water (Lamb 1932, art. 267): 7.17e-5 m^3/s^2.
inline long double trochoid_frequency(long double k, long double g, long double depth) {
  const long double kh = k * depth;
  return std::sqrt((g * k + 7.17e-5L * k * k * k) * (kh > 100.0L ? 1.0L : std::tanh(kh)));
}

struct Trochoids {
  double x = 0.0, y = 0.0, z = 0.0;     // displacement from rest
  double hx = 0.0, hz = 0.0;            // dy/dx, dy/dz over the rest position
  double xx = 0.0, zz = 0.0, xz = 0.0;  // of the horizontal displacement
  double vx = 0.0, vy = 0.0, vz = 0.0;  // of the water
  double jacobian() const { return (1.0 + xx) * (1.0 + zz) - xz * xz; }
};

inline Trochoids trochoids(const std::vector<Trochoid>& waves, long double t, double x, double z) {
  Trochoids sum;
  for (const Trochoid& wave : waves) {
    const double k = std::hypot(wave.kx, wave.kz), ux = wave.kx / k, uz = wave.kz / k;
    // The phase of time modulo a turn first, so that a great time costs no digits.
    const long double turns = wave.w * t / (2.0L * 3.14159265358979323846264338327950288L);
    const double angle =
        wave.kx * x + wave.kz * z + wave.phase - 2.0 * pi_of_gerstner * double(turns - std::floor(turns));
    const double c = wave.a * std::cos(angle), s = wave.a * std::sin(angle), r = wave.chop, w = double(wave.w);
    sum.x -= r * ux * s;
    sum.y += c;
    sum.z -= r * uz * s;
    sum.hx -= wave.kx * s;
    sum.hz -= wave.kz * s;
    sum.xx -= r * ux * wave.kx * c;
    sum.zz -= r * uz * wave.kz * c;
    sum.xz -= r * ux * wave.kz * c;
    sum.vx += r * ux * w * c;
    sum.vy += w * s;
    sum.vz += r * uz * w * c;
  }
  return sum;
}

}  // namespace truth
