#include "ocean/waves/wave_compute.h"

#include <spdlog/spdlog.h>

#include <bit>
#include <cmath>

#include "shaders/shared/wave_compute.h"

namespace seascape {

namespace {
constexpr VkDeviceSize bins_a_cascade = VkDeviceSize(gpu::wave_bins) * gpu::wave_bins;

// Mean squares of slope over a cascade's whole tile: sums over its bins, in time average.
glm::dvec3 tile_moments(const Cascade& cascade, const gpu::WaveBin* bins) {
  glm::dvec3 sum(0.0);
  const double dk = 2.0 * M_PI / cascade.side_m, c = std::cos(cascade.rotation_rad), s = std::sin(cascade.rotation_rad);
  for (int mz = -31; mz < 32; ++mz)
    for (int mx = -31; mx < 32; ++mx) {
      const gpu::WaveBin& bin = bins[(mz + 32) * gpu::wave_bins + mx + 32];
      const double power = 0.5 * (double(bin.amplitude.x) * bin.amplitude.x + double(bin.amplitude.y) * bin.amplitude.y);
      const double kx = dk * (c * mx - s * mz), kz = dk * (s * mx + c * mz);
      sum += power * glm::dvec3(kx * kx, kz * kz, kx * kz);
    }
  return sum;
}
}  // namespace

WaveCompute::WaveCompute(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveQuality& quality,
                         const WaveBins& bins, const SeaStatistics& statistics, double anisotropy)
    : sea_(sea), quality_(quality), ladder_(bins.ladder), statistics_(statistics) {
  const EffectScope scope(device, "waves");
  const auto n = std::uint32_t(quality.resolution), cascades = std::uint32_t(bins.cascades);
  levels_ = std::bit_width(n);
  half_ = quality.half_storage || !device.facts().float32_linear;
  if (half_ && !quality.half_storage)
    spdlog::info("waves: {} cannot filter 32-bit tiles; they are stored as 16-bit floats", device.facts().name);
  for (std::uint32_t c = 0; c < cascades; ++c)
    cascade_moments_.push_back(tile_moments(ladder_[c], bins.bins.data() + c * bins_a_cascade));

  bins_ = make_filled_buffer(device, "wave bins", bins.bins.data(), bins.bins.size() * sizeof(gpu::WaveBin),
                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  rows_ = Buffer(device, "wave rows", VkDeviceSize(cascades) * gpu::wave_fields * gpu::wave_bins * n * 8,
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  ImageSpec tile;
  tile.width = tile.height = n;
  tile.layers = cascades;
  tile.levels = std::uint32_t(levels_);
  tile.format = half_ ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
  tile.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  displacement_ = Image(device, "wave displacement", tile);
  derivatives_ = Image(device, "wave derivatives", tile);
  moments_ = Image(device, "wave moments", tile);
  vertex_sampler_ = make_sampler(device, "waves, vertices", {true, true, 1.0f});
  pixel_sampler_ = make_sampler(device, "waves, pixels", {true, true, float(anisotropy)});
  fetch_sampler_ = make_sampler(device, "waves, mips", {false, true, 1.0f});

  const std::string format = half_ ? "half" : "full";
  rows_pipeline_ = make_compute_pipeline(device, shaders, "wave_rows.comp");
  columns_pipeline_ = make_compute_pipeline(device, shaders, "wave_columns_" + format + ".comp");
  mips_pipeline_ = make_compute_pipeline(device, shaders, "wave_mips_" + format + ".comp");
  rows_bindings_ = Bindings(device, rows_pipeline_, {{.binding = 0, .buffer = &bins_}, {.binding = 1, .buffer = &rows_}}, "wave rows");
  columns_bindings_ = Bindings(device, columns_pipeline_,
                               {{.binding = 0, .buffer = &rows_},
                                {.binding = 1, .view = displacement_.subview(0, 1, 0, cascades)},
                                {.binding = 2, .view = derivatives_.subview(0, 1, 0, cascades)},
                                {.binding = 3, .view = moments_.subview(0, 1, 0, cascades)}},
                               "wave columns");
  for (int level = 0; level + 1 < levels_; level += 3) {
    MipStep step;
    step.source_level = level;
    step.levels = std::min(3, levels_ - 1 - level);
    step.groups = std::max(1, (int(n) >> (level + 1)) / 8);
    int i = 0;
    for (Image* image : {&displacement_, &derivatives_, &moments_}) {
      auto target = [&](int l) { return image->subview(std::uint32_t(std::min(level + l, levels_ - 1)), 1, 0, cascades); };
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
  const auto cascades = std::uint32_t(cascade_moments_.size());
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
             {use(rows_, Access::compute_read), use(displacement_, Access::compute_write, true),
              use(derivatives_, Access::compute_write, true), use(moments_, Access::compute_write, true)},
             [&](Commands& c) {
               c.bind(columns_pipeline_, columns_bindings_);
               c.push(push);
               c.dispatch(n / 8, phases, cascades);
             });
  for (const MipStep& step : mip_steps_)
    frame.pass("wave mips",
               {use(displacement_, Access::compute_write), use(derivatives_, Access::compute_write),
                use(moments_, Access::compute_write)},
               [&](Commands& c) {
                 for (const Bindings& bindings : step.bindings) {
                   c.bind(mips_pipeline_, bindings);
                   c.push(gpu::MipPush{quality_.resolution >> step.source_level, step.levels});
                   c.dispatch(std::uint32_t(step.groups), std::uint32_t(step.groups), cascades);
                 }
               });
}

gpu::SeaData WaveCompute::sea_data(glm::dvec2 grid_origin_m) const {
  gpu::SeaData data{};
  for (std::size_t i = 0; i < cascade_moments_.size(); ++i) {
    const Cascade& cascade = ladder_[i];
    const double c = std::cos(cascade.rotation_rad) / cascade.side_m, s = std::sin(cascade.rotation_rad) / cascade.side_m;
    const glm::dvec2 origin(c * grid_origin_m.x + s * grid_origin_m.y, -s * grid_origin_m.x + c * grid_origin_m.y);
    gpu::CascadeData& d = data.cascade[i];
    d.tile_from_rest = glm::vec4(float(c), float(s), float(-s), float(c));
    const double half_texel = 0.5 / quality_.resolution;
    d.origin = glm::vec4(float(origin.x - std::floor(origin.x) + half_texel), float(origin.y - std::floor(origin.y) + half_texel),
                         float(cascade.side_m / quality_.resolution), float(cascade.side_m));
    d.moments = glm::vec4(glm::vec3(cascade_moments_[i]), float(longest_wave(cascade)));
  }
  data.tail = glm::vec4(glm::vec3(statistics_.tail_slope_moments), float(sea_.chop));
  data.shape = glm::ivec4(int(cascade_moments_.size()), levels_, quality_.resolution, 0);
  data.footprint.z = float(statistics_.largest_height_m);
  return data;
}

}  // namespace seascape
