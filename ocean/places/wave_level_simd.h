// What a level of waves does beside its transforms, vectorised. One thread; the bits do not depend on the instruction
// set.
#pragma once
#include <complex>
#include <cstddef>
#include <span>

namespace seascape {

// re[i] + i im[i] = modes[i]. As many as a multiple of 16.
void floats_from_modes(std::span<const std::complex<double>> modes, float* re, float* im);

// modes[i] += scale (re[i] + i im[i]) where share[i] is above 0. As many as a multiple of 16.
void add_to_modes(std::span<std::complex<double>> modes, const double* share, double scale, const float* re,
                  const float* im);

// to[i] += the sum over s of (of_re[s] + i of_im[s]) (along_re + i along_im)[s stride + i], one s after the other. As
// many as a multiple of 8.
void add_products(std::span<std::complex<double>> to, std::span<const double> of_re, std::span<const double> of_im,
                  const double* along_re, const double* along_im, std::ptrdiff_t stride);

// A rectangle of texels that wraps around.
struct TexelPatch {
  int x_first, x_count, z_first, z_count;  // firsts from 0 to n - 1, counts up to n
};
// to[z stride + x] += by of_z[z] of_x[x] in the patch; of_x is 0 beyond it. n is a multiple of 16.
void add_outer_product(float* to, int n, int stride, const TexelPatch& patch, const float* of_x, const float* of_z,
                       float by);

// Multiplies re and im at (x, z), n rows of `stride`, by along_x[x] along_z[z] open[z n + x] - 1 (no `open`: 1). n is a
// multiple of 16.
void multiply_by_loss(float* re, float* im, int n, int stride, const float* along_x, const float* along_z,
                      const float* open);

}  // namespace seascape
