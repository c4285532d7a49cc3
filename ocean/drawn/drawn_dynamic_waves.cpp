#include "ocean/drawn/drawn_dynamic_waves.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seascape {

DrawnDynamicWaves::DrawnDynamicWaves(Device& device, const DynamicSeaSettings& settings)
    : images_(device, "dynamic_waves", settings.waves.windows.resolution, settings.waves.windows.slices) {
  mesh_errors_.reserve(std::size_t(settings.waves.windows.slices));
}

void DrawnDynamicWaves::update(Frame& frame, const DrawnMoment& moment) {
  Sea& sea = moment.sea;
  const std::uint64_t version = sea.dynamic_waves()->surface_version();
  if (surface_ != nullptr && version == version_) return;
  version_ = version;
  surface_ = nullptr;  // whose memory the next one may take
  surface_ = sea.dynamic_surface();
  if (const auto fault = sea.take_fault()) spdlog::warn("{}", *fault);
  const DynamicSurface& surface = *surface_;
  const gpu::LodWindows windows = surface.windows(glm::dvec2(0.0));
  reach_ = {};
  levels_.clear();
  mesh_errors_.clear();
  for (int i = 0; i < surface.levels(); ++i) {
    if (surface.still(i)) continue;
    const DynamicSurface::Extent extent = surface.extent(i);
    reach_.height_m += extent.height_m;
    reach_.shift_m += extent.shift_m;
    levels_.push_back({&surface, i, i});
    // Squares: their corners are the farthest.
    const double reach_m =
        std::numbers::sqrt2 * std::min(double(windows.reach.x) * std::exp2(i), double(windows.reach.y));
    if (const auto near = near_mesh_error(extent, reach_m)) mesh_errors_.push_back(*near);
  }
  images_.fill(frame, levels_);
}

void DrawnDynamicWaves::declare(SurfaceSlots& slots, std::size_t) const {
  slots.set("dynamic_waves", gpu::value_dynamic_levels, std::uint32_t(images_.layers()));
  slots.bind(gpu::slot_dynamic_shift, images_.shift());
  slots.bind(gpu::slot_dynamic_slope, images_.slope());
}

void DrawnDynamicWaves::describe(gpu::FrameData& frame, glm::dvec2 grid_origin_m) const {
  gpu::DynamicData& data = frame.sea.dynamic;
  const DynamicSurface& surface = *surface_;
  data.windows = surface.windows(grid_origin_m);
  for (int i = 0; i < surface.levels(); ++i) {
    const bool still = surface.still(i);
    data.level[i] = glm::vec4(glm::vec3(surface.extent(i).slope_moments), still    ? 0.0f
                                                                          : i == 0 ? 1.0f - data.windows.reach.z
                                                                                   : 1.0f);
  }
  data.share = glm::vec4(float(surface.share()), 0.0f, 0.0f, 0.0f);
}

}  // namespace seascape
