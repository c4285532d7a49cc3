#include "ocean/drawn/wave_compute.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {
gpu::WavePush push_of(const SeaState& sea, const WaveBins& bins, const WaveImages::Set& set) {
  gpu::WavePush push{};
  push.samples = set.samples;
  push.chop = float(sea.chop);
  push.depth_m = sea.depth_m < deep_water_m ? float(sea.depth_m) : 0.0f;
  for (int i = 0; i < set.cascades; ++i) {
    const Cascade& cascade = bins.ladder[std::size_t(set.first + i)];
    const double dk = 2.0 * M_PI / cascade.side_m;
    // Two fields of one transform share its rounding: the shear is carried at the size of the shift.
    const float length = std::exp2(std::round(std::log2(float(1.0 / (12.0 * dk)))));
    push.wave_vector[i] =
        glm::vec4(float(dk * std::cos(cascade.rotation_rad)), float(dk * std::sin(cascade.rotation_rad)), length,
                  moment_share(bins, set.first + i, set.samples));
  }
  return push;
}

// The bins of a set's cascades as their tiles carry them, one table after the other.
void write_drawn(const WaveBins& bins, const WaveImages::Set& set, gpu::WaveBin* to) {
  const int half = bins_of(set.first) / 2, rows = 2 * half * set.cascades;
  tbb::parallel_for(0, rows, [&](int row) {
    const int c = set.first + row / (2 * half), mz = row % (2 * half) - half;
    gpu::WaveBin* out = to + std::ptrdiff_t(row) * 2 * half;
    for (int mx = -half; mx < half; ++mx) {
      gpu::WaveBin bin = bins.at(c, mx, mz);
      if (bin.amplitude != glm::vec2(0.0f)) bin.amplitude = drawn_amplitude(bin, mx, mz, set.samples);
      *out++ = bin;
    }
  });
}
}  // namespace

std::uint32_t transform_group(std::uint32_t radix, const DeviceFacts& facts) {
  std::uint32_t group = 8 * radix;  // eight transforms side by side: whole cache lines of columns
  while (group > radix && (group > facts.max_workgroup || group * (radix + 1) * 8 > facts.shared_memory)) group /= 2;
  return group;
}

WaveCompute::WaveCompute(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveBins& bins,
                         WaveImages& images)
    : device_(device), images_(images) {
  const EffectScope scope(device, "waves");
  fetch_sampler_ = make_sampler(device, "waves, mips", {false, true, 1.0f});
  mips_pipeline_ =
      make_compute_pipeline(device, shaders, images.half_storage() ? "wave_mips_half.comp" : "wave_mips_full.comp");
  for (WaveImages::Set& set : images.copies_.front()) work_.push_back(make_work(device, shaders, sea, bins, set));
}

WaveCompute::Work WaveCompute::make_work(Device& device, ShaderLibrary& shaders, const SeaState& sea,
                                         const WaveBins& bins, WaveImages::Set& set) const {
  const auto n = std::uint32_t(set.samples), cascades = std::uint32_t(set.cascades),
             table = std::uint32_t(bins_of(set.first));
  Work work;
  work.set = &set;
  work.band = std::min(table, std::max(n, 64u));
  work.push = push_of(sea, bins, set);
  std::vector<gpu::WaveBin> drawn(std::size_t(cascades) * table * table);
  write_drawn(bins, set, drawn.data());
  work.bins = make_filled_buffer(device, "wave bins", drawn.data(), drawn.size() * sizeof(gpu::WaveBin),
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  work.rows = Buffer(device, "wave rows", VkDeviceSize(cascades) * gpu::wave_fields * work.band * n * 8,
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  // Many bins are transformed 256 at a time, by 16 invocations; fewer 64 at a time, by 8.
  const bool wide = work.band >= 256;
  const std::uint32_t radix = wide ? 16 : 8, group = transform_group(radix, device.facts());
  work.core = radix * radix;
  work.slots = group / radix;
  const std::string kind = wide ? "_wide" : "", format = images_.half_storage() ? "_half" : "_full";
  const std::vector<SpecValue> sizes{{0, table}, {1, work.band}, {2, group}};
  work.rows_pipeline = make_compute_pipeline(device, shaders, "wave_rows" + kind + ".comp", sizes);
  work.columns_pipeline = make_compute_pipeline(device, shaders, "wave_columns" + kind + format + ".comp", sizes);
  work.rows_bindings =
      Bindings(device, work.rows_pipeline, {{.binding = 0, .buffer = &work.bins}, {.binding = 1, .buffer = &work.rows}},
               "wave rows");
  work.columns_bindings = Bindings(device, work.columns_pipeline,
                                   {{.binding = 0, .buffer = &work.rows},
                                    {.binding = 1, .view = set.displacement.subview(0, 1, 0, cascades)},
                                    {.binding = 2, .view = set.derivatives.subview(0, 1, 0, cascades)},
                                    {.binding = 3, .view = set.moments.subview(0, 1, 0, cascades)}},
                                   "wave columns");
  for (int level = 0; level + 1 < set.levels; level += 3) {
    MipStep step;
    step.source_level = level;
    step.levels = std::min(3, set.levels - 1 - level);
    step.groups = std::max(1, (set.samples >> (level + 1)) / 8);
    int i = 0;
    for (Image* image : {&set.displacement, &set.derivatives, &set.moments}) {
      auto target = [&](int l) {
        return image->subview(std::uint32_t(std::min(level + l, set.levels - 1)), 1, 0, cascades);
      };
      step.bindings[i++] = Bindings(device, mips_pipeline_,
                                    {{.binding = 0,
                                      .view = image->subview(std::uint32_t(level), 1, 0, cascades),
                                      .sampler = fetch_sampler_.get(),
                                      .layout = VK_IMAGE_LAYOUT_GENERAL},
                                     {.binding = 1, .view = target(1)},
                                     {.binding = 2, .view = target(2)},
                                     {.binding = 3, .view = target(3)}},
                                    "wave mips");
    }
    work.mip_steps.push_back(std::move(step));
  }
  return work;
}

void WaveCompute::take(Frame& frame, const WaveBins& bins, double chop) {
  const EffectScope scope(device_, "waves");
  computed_ = false;
  for (Work& work : work_) {
    work.push.chop = float(chop);
    Buffer& staging = work.staging[std::size_t(frame.slot())];
    if (!staging)
      staging = Buffer(device_, "wave bins, changing", work.bins.bytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                       HostAccess::write);
    write_drawn(bins, *work.set, staging.mapped<gpu::WaveBin>());
  }
  Uses uses{};
  for (const Work& work : work_) {
    uses.add(use(work.staging[std::size_t(frame.slot())], Access::transfer_read));
    uses.add(use(work.bins, Access::transfer_write));
  }
  frame.pass("wave bins", uses, [&](Commands& c) {
    for (const Work& work : work_) c.copy(work.staging[std::size_t(frame.slot())], work.bins);
  });
}

void WaveCompute::update(Frame& frame, std::int64_t ticks) {
  if (computed_ && ticks == ticks_) return;
  computed_ = true;
  ticks_ = ticks;
  for (Work& work : work_) {
    work.push.ticks_high = std::uint32_t(std::uint64_t(ticks) >> 32);
    work.push.ticks_low = std::uint32_t(std::uint64_t(ticks));
  }
  // The tiles of both shapes side by side: they do not wait for each other.
  Uses rows{}, columns{}, mips{};
  for (const Work& work : work_) {
    rows.add(use(work.bins, Access::compute_read));
    rows.add(use(work.rows, Access::compute_write));
    columns.add(use(work.rows, Access::compute_read));
  }
  images_.add_uses(columns, Access::compute_write, true);
  images_.add_uses(mips, Access::compute_write);
  frame.pass("wave rows", rows, [&](Commands& c) {
    for (const Work& work : work_) {
      c.bind(work.rows_pipeline, work.rows_bindings);
      c.push(work.push);
      // Eight short transforms a workgroup, one for each row and phase; or `slots` rows with all their phases.
      const std::uint32_t groups = work.core == 64
                                       ? work.band * std::max(1u, std::uint32_t(work.set->samples) / 64u) / 8
                                       : work.band / work.slots;
      c.dispatch(groups, std::uint32_t(work.set->cascades), 1);
    }
  });
  frame.pass("wave columns", columns, [&](Commands& c) {
    for (const Work& work : work_) {
      const auto n = std::uint32_t(work.set->samples);
      c.bind(work.columns_pipeline, work.columns_bindings);
      c.push(work.push);
      c.dispatch(n / work.slots, std::max(1u, n / work.core), std::uint32_t(work.set->cascades));
    }
  });
  for (std::size_t i = 0; i < work_[0].mip_steps.size(); ++i)
    frame.pass("wave mips", mips, [&](Commands& c) {
      for (const Work& work : work_) {
        if (i >= work.mip_steps.size()) continue;
        const MipStep& step = work.mip_steps[i];
        for (const Bindings& bindings : step.bindings) {
          c.bind(mips_pipeline_, bindings);
          c.push(gpu::MipPush{work.set->samples >> step.source_level, step.levels});
          c.dispatch(std::uint32_t(step.groups), std::uint32_t(step.groups), std::uint32_t(work.set->cascades));
        }
      }
    });
}

}  // namespace seascape
