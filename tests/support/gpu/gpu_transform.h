// Two-dimensional transforms by the shaders' library and nothing else, for tests and benchmarks of it.
#pragma once
#include <bit>
#include <complex>
#include <string>
#include <vector>

#include "engine/frame.h"

namespace seascape::test {

class GpuTransform {
 public:
  // Bins [mz + band/2][mx + band/2] of a band, core or a multiple of twice that, into n x n samples [z][x]; n at least
  // core = radix^2. `slots`: transforms a workgroup.
  GpuTransform(Device& device, ShaderLibrary& shaders, int n, int band, int radix, int slots,
               const std::vector<std::complex<float>>& bins)
      : device_(device),
        n_(std::uint32_t(n)),
        band_(std::uint32_t(band)),
        phases_(std::uint32_t(n / (radix * radix) == 2 ? 1 : n / (radix * radix))),
        slots_(std::uint32_t(slots)) {
    bins_ =
        make_filled_buffer(device, "transform bins", bins.data(), bins.size() * 8, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    rows_ = Buffer(device, "transform rows", VkDeviceSize(8) * n_ * band_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    samples_ = Buffer(device, "transform samples", VkDeviceSize(8) * n_ * n_,
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    const std::string name = "transform_" + std::to_string(radix) + ".comp";
    const auto pipeline = [&](std::uint32_t lanes_first) {
      return make_compute_pipeline(device, shaders, name,
                                   {{0, band_},
                                    {1, std::uint32_t(std::bit_width(n_)) - 1},
                                    {2, lanes_first},
                                    {3, std::uint32_t(radix * slots)}});
    };
    along_x_ = pipeline(1);
    along_z_ = pipeline(0);
    x_bindings_ = Bindings(device, along_x_, {{.binding = 0, .buffer = &bins_}, {.binding = 1, .buffer = &rows_}},
                           "transform rows");
    z_bindings_ = Bindings(device, along_z_, {{.binding = 0, .buffer = &rows_}, {.binding = 1, .buffer = &samples_}},
                           "transform columns");
  }
  // In a frame that has begun: two passes.
  void record(Frame& frame) {
    struct Steps {
      std::uint32_t in_transform, in_step, out_transform, out_step;
    };
    frame.pass("rows", {use(bins_, Access::compute_read), use(rows_, Access::compute_write)}, [&](Commands& c) {
      c.bind(along_x_, x_bindings_);
      c.push(Steps{band_, 1, n_, 1});
      c.dispatch(band_ / slots_, phases_, 1);
    });
    frame.pass("columns", {use(rows_, Access::compute_read), use(samples_, Access::compute_write)}, [&](Commands& c) {
      c.bind(along_z_, z_bindings_);
      c.push(Steps{1, n_, 1, n_});
      c.dispatch(n_ / slots_, phases_, 1);
    });
  }
  std::vector<std::complex<float>> samples() const {
    const std::vector<std::uint8_t> bytes = read_buffer(device_, samples_);
    std::vector<std::complex<float>> result(bytes.size() / 8);
    std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
  }

 private:
  Device& device_;
  std::uint32_t n_, band_, phases_, slots_;
  Buffer bins_, rows_, samples_;
  Pipeline along_x_, along_z_;
  Bindings x_bindings_, z_bindings_;
};

}  // namespace seascape::test
