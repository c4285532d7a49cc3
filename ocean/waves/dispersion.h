// How fast waves of a length run over water of a depth: linear (Airy) dispersion, with and without surface tension.
#pragma once

namespace seascape {

// Surface tension of sea water over its density, m^3/s^2 (0.0735 N/m over 1025 kg/m^3, 20 degrees C). With Earth's
// gravity the slowest wave then has 370 rad/m and 0.23 m/s, as Elfouhaily et al. (1997) have it.
inline constexpr double water_tension_m3_s2 = 7.17e-5;

// Angular frequency (rad/s) of wave number k (rad/m): w^2 = g k tanh(k h) (Airy 1845). 0 where k or the depth is 0 or
// less.
double airy_frequency(double k, double gravity_mps2, double depth_m);
// Its derivative dw/dk, the speed of energy (m/s); sqrt(g h) for k = 0, 0 on dry land.
double airy_group_speed(double k, double gravity_mps2, double depth_m);
// The wave number of an angular frequency within 3e-5: Guo's (2002) explicit form, eq. 13, off by up to 0.76 %, and one
// Newton step. 0 where the frequency or the depth is 0 or less.
double airy_wave_number(double w, double gravity_mps2, double depth_m);

// How much wider than high the orbit of the water at the surface is: coth(k h) (Airy 1845), 1 in deep water; held at 8,
// below a depth of an eighth of 1 / k, where waves of any height are no linear waves any more. 1 where k is 0 or less.
double orbit_width(double k, double depth_m);

// With surface tension, which makes waves shorter than about 10 cm faster: w^2 = (g k + (sigma / rho) k^3) tanh(k h)
// (Lamb 1932, art. 267). This is what the drawn waves run by.
double wave_frequency(double k, double gravity_mps2, double depth_m);
long double wave_frequency(long double k, long double gravity_mps2, long double depth_m);

}  // namespace seascape
