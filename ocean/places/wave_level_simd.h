// What a level of waves does beside its transforms, vectorised. One thread; the bits do not depend on the instruction
// set.
#pragma once
#include <complex>
#include <span>

namespace seascape {

// re[i] + i im[i] = modes[i]. As many as a multiple of 16.
void floats_from_modes(std::span<const std::complex<double>> modes, float* re, float* im);

// modes[i] += scale (re[i] + i im[i]) where share[i] is above 0. As many as a multiple of 16.
void add_to_modes(std::span<std::complex<double>> modes, const double* share, double scale, const float* re,
                  const float* im);

// Multiplies re and im at (x, z), n rows of `stride`, by along_x[x] along_z[z] open[z n + x] - 1 (no `open`: 1). n is a
// multiple of 16.
void multiply_by_loss(float* re, float* im, int n, int stride, const float* along_x, const float* along_z,
                      const float* open);

}  // namespace seascape
