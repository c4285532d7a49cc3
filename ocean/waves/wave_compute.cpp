#include "ocean/waves/wave_compute.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/wave_compute.h"

namespace seascape {

WaveCompute::WaveCompute(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveQuality& quality,
                         const WaveBins& bins, WaveImages& images)
    : sea_(sea), quality_(quality), ladder_(bins.ladder), images_(images) {
  const EffectScope scope(device, "waves");
  const auto n = std::uint32_t(quality.resolution), cascades = std::uint32_t(bins.cascades);
  Image &displacement = images.displacement_, &derivatives = images.derivatives_, &moments = images.moments_;
  bins_ = make_filled_buffer(device, "wave bins", bins.bins.data(), bins.bins.size() * sizeof(gpu::WaveBin),
                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  rows_ = Buffer(device, "wave rows", VkDeviceSize(cascades) * gpu::wave_fields * gpu::wave_bins * n * 8,
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  fetch_sampler_ = make_sampler(device, "waves, mips", {false, true, 1.0f});

  const std::string format = images.half_storage() ? "half" : "full";
  rows_pipeline_ = make_compute_pipeline(device, shaders, "wave_rows.comp");
  columns_pipeline_ = make_compute_pipeline(device, shaders, "wave_columns_" + format + ".comp");
  mips_pipeline_ = make_compute_pipeline(device, shaders, "wave_mips_" + format + ".comp");
  rows_bindings_ = Bindings(device, rows_pipeline_, {{.binding = 0, .buffer = &bins_}, {.binding = 1, .buffer = &rows_}}, "wave rows");
  columns_bindings_ = Bindings(device, columns_pipeline_,
                               {{.binding = 0, .buffer = &rows_},
                                {.binding = 1, .view = displacement.subview(0, 1, 0, cascades)},
                                {.binding = 2, .view = derivatives.subview(0, 1, 0, cascades)},
                                {.binding = 3, .view = moments.subview(0, 1, 0, cascades)}},
                               "wave columns");
  const int levels = images.levels();
  for (int level = 0; level + 1 < levels; level += 3) {
    MipStep step;
    step.source_level = level;
    step.levels = std::min(3, levels - 1 - level);
    step.groups = std::max(1, (int(n) >> (level + 1)) / 8);
    int i = 0;
    for (Image* image : {&displacement, &derivatives, &moments}) {
      auto target = [&](int l) { return image->subview(std::uint32_t(std::min(level + l, levels - 1)), 1, 0, cascades); };
      step.bindings[i++] = Bindings(device, mips_pipeline_,
                                    {{.binding = 0, .view = image->subview(std::uint32_t(level), 1, 0, cascades),
                                      .sampler = fetch_sampler_.get(), .layout = VK_IMAGE_LAYOUT_GENERAL},
                                     {.binding = 1, .view = target(1)},
                                     {.binding = 2, .view = target(2)},
                                     {.binding = 3, .view = target(3)}},
                                    "wave mips");
    }
    mip_steps_.push_back(std::move(step));
  }
}

void WaveCompute::update(Frame& frame, std::int64_t ticks) {
  if (computed_ && ticks == ticks_) return;
  computed_ = true;
  ticks_ = ticks;
  gpu::WavePush push{};
  push.ticks_high = std::uint32_t(std::uint64_t(ticks) >> 32);
  push.ticks_low = std::uint32_t(std::uint64_t(ticks));
  push.resolution = quality_.resolution;
  push.chop = float(sea_.chop);
  const auto cascades = std::uint32_t(images_.cascades());
  for (std::uint32_t c = 0; c < cascades; ++c) {
    const double dk = 2.0 * M_PI / ladder_[c].side_m;
    push.wave_vector[c] = glm::vec4(float(dk * std::cos(ladder_[c].rotation_rad)), float(dk * std::sin(ladder_[c].rotation_rad)), 0, 0);
    // Two fields of one transform share its rounding: the shear is carried at the size of the shift.
    const float length = std::exp2(std::round(std::log2(float(1.0 / (12.0 * dk)))));
    push.wave_vector[c].z = length;
    push.wave_vector[c].w = 1.0f / length;
  }
  const auto n = std::uint32_t(quality_.resolution), phases = std::max(1u, n / 64u);
  frame.pass("wave rows", {use(bins_, Access::compute_read), use(rows_, Access::compute_write)}, [&](Commands& c) {
    c.bind(rows_pipeline_, rows_bindings_);
    c.push(push);
    c.dispatch(8 * phases, cascades, 1);
  });
  frame.pass("wave columns",
             {use(rows_, Access::compute_read), use(images_.displacement(), Access::compute_write, true),
              use(images_.derivatives(), Access::compute_write, true), use(images_.moments(), Access::compute_write, true)},
             [&](Commands& c) {
               c.bind(columns_pipeline_, columns_bindings_);
               c.push(push);
               c.dispatch(n / 8, phases, cascades);
             });
  for (const MipStep& step : mip_steps_)
    frame.pass("wave mips",
               {use(images_.displacement(), Access::compute_write), use(images_.derivatives(), Access::compute_write),
                use(images_.moments(), Access::compute_write)},
               [&](Commands& c) {
                 for (const Bindings& bindings : step.bindings) {
                   c.bind(mips_pipeline_, bindings);
                   c.push(gpu::MipPush{quality_.resolution >> step.source_level, step.levels});
                   c.dispatch(std::uint32_t(step.groups), std::uint32_t(step.groups), cascades);
                 }
               });
}

}  // namespace seascape
