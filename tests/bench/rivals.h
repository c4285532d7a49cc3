// What benchmarks of transforms share: ours and FFTW's of the same spectrum, and times of several rivals within one
// loop.
#pragma once
#include <fftw3.h>
#include <tbb/cache_aligned_allocator.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "ocean/waves/fft.h"

namespace seascape::bench {

constexpr int fields = 4;  // complex fields of a cascade

// Beginning with a cache line, as FFTW's own allocation does.
using Floats = std::vector<float, tbb::cache_aligned_allocator<float>>;

// A band of random amplitudes, none of them zero.
struct Spectrum {
  Spectrum(int width, unsigned seed) : band(width), re(std::size_t(band) * std::size_t(band)), im(re.size()) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    const auto value = [&] {
      const float v = uniform(random);
      return v + std::copysign(0.1f, v);
    };
    for (float& part : re) part = value();
    for (float& part : im) part = value();
  }
  int band;
  Floats re, im;
};

struct OurTransform {
  OurTransform(int size, int band)
      : plan(make_fft_plan(size, band)),
        n(size),
        stride(size + 16),
        re(std::size_t(n) * std::size_t(stride)),
        im(re.size()),
        workspace(inverse_fft_floats(plan)) {}
  void run(const Spectrum& spectrum) {
    inverse_fft(plan, spectrum.re.data(), spectrum.im.data(), re.data(), im.data(), stride, workspace);
  }
  FftPlan plan;
  int n, stride;
  Floats re, im, workspace;
};

enum class Layout { in_place, out_of_place };

// One thread, every bin of the grid, planned by measurement.
class FftwTransform {
 public:
  FftwTransform(int size, Layout layout)
      : n_(size), in_(grid()), out_(layout == Layout::in_place ? nullptr : fftwf_alloc_complex(cells()), &fftwf_free) {
    plan_ = fftwf_plan_dft_2d(n_, n_, in_.get(), result(), FFTW_BACKWARD, FFTW_MEASURE);
  }
  ~FftwTransform() { fftwf_destroy_plan(plan_); }
  FftwTransform(FftwTransform&& from) noexcept
      : n_(from.n_), in_(std::move(from.in_)), out_(std::move(from.out_)), plan_(std::exchange(from.plan_, nullptr)) {}
  void fill(const Spectrum& spectrum) {
    const int band = spectrum.band;
    std::fill_n(&in_.get()[0][0], cells() * 2, 0.0f);
    for (int z = 0; z < band; ++z)
      for (int x = 0; x < band; ++x) {
        const std::size_t to =
            std::size_t((z - band / 2 + n_) % n_) * std::size_t(n_) + std::size_t((x - band / 2 + n_) % n_);
        const std::size_t from = std::size_t(z) * std::size_t(band) + std::size_t(x);
        in_.get()[to][0] = spectrum.re[from];
        in_.get()[to][1] = spectrum.im[from];
      }
  }
  void run() { fftwf_execute(plan_); }
  fftwf_complex* result() { return out_ ? out_.get() : in_.get(); }

 private:
  std::size_t cells() const { return std::size_t(n_) * std::size_t(n_); }
  std::unique_ptr<fftwf_complex, decltype(&fftwf_free)> grid() { return {fftwf_alloc_complex(cells()), &fftwf_free}; }
  int n_;
  std::unique_ptr<fftwf_complex, decltype(&fftwf_free)> in_, out_;
  fftwf_plan plan_;
};

// Microseconds of each call of one of several rivals.
struct Times {
  std::vector<double> us;
  template <class Work>
  void take(Work work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  double median() {
    std::nth_element(us.begin(), us.begin() + std::ptrdiff_t(us.size() / 2), us.end());
    return us[us.size() / 2];
  }
  double least() const { return *std::min_element(us.begin(), us.end()); }
};

}  // namespace seascape::bench
