#include "ocean/drawn/drawn_wakes.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

namespace seascape {

DrawnWakes::DrawnWakes(Device& device, const WakeSettings& settings)
    : levels_of_window_(settings.waves.windows.slices),
      images_(device, "wakes", settings.waves.windows.resolution, gpu::max_wake_windows * gpu::max_wake_levels, true) {
  mesh_errors_.reserve(std::size_t(images_.layers()));
}

void DrawnWakes::update(Frame& frame, const DrawnMoment& moment) {
  Sea& sea = moment.sea;
  const std::uint64_t version = sea.wakes()->version();
  if (version != version_) {
    version_ = version;
    surface_ = nullptr;  // whose memory the next one may take
    surface_ = sea.wake_surface();
    if (const auto fault = sea.take_fault()) spdlog::warn("{}", *fault);
    reach_ = {};
    levels_.clear();
    for (int i = 0; surface_ != nullptr && i < surface_->levels(); ++i) {
      const DynamicSurface::Extent extent = surface_->extent(i);
      reach_.height_m += extent.height_m;
      reach_.shift_m += extent.shift_m;
      for (std::size_t window = 0; window < surface_->parts().size(); ++window) {
        const DynamicSurface& waves = surface_->parts()[window].surface;
        if (!waves.still(i)) levels_.push_back({&waves, i, int(window) * gpu::max_wake_levels + i});
      }
    }
    images_.fill(frame, levels_);
  }
  find_mesh_errors({moment.viewer_m.x, moment.viewer_m.z});
}

// A window lies anywhere: what is known of meshes counts around the viewer, from the window's nearest place as far as
// its farthest corner. In steps of an eighth, so that it seldom changes. Windows of a level are weighed against each
// other: together they are bent no more than the one that is most.
void DrawnWakes::find_mesh_errors(glm::dvec2 viewer) {
  mesh_errors_.clear();
  if (surface_ == nullptr) return;
  for (const WakeSurface::Part& part : surface_->parts())
    for (int i = 0; i < surface_->levels(); ++i) {
      if (part.surface.still(i)) continue;
      const double half_m = double(gpu::wake_end) * surface_->half_m(i);
      const glm::dvec2 off = glm::abs(part.middle_m[std::size_t(i)] - viewer);
      const double from_m = glm::length(glm::max(off - half_m, glm::dvec2(0.0))), reach_m = glm::length(off + half_m);
      const double stepped_m = std::exp2(std::ceil(8.0 * std::log2(reach_m)) / 8.0);
      auto near = near_mesh_error(part.surface.extent(i), stepped_m, 4);
      if (!near) continue;
      near->from_m = from_m > 1.0 ? std::exp2(std::floor(8.0 * std::log2(from_m)) / 8.0) : 0.0;
      near->shares = i;
      mesh_errors_.push_back(*near);
    }
  std::sort(mesh_errors_.begin(), mesh_errors_.end(),
            [](const NearMeshError& a, const NearMeshError& b) { return a.reach_m < b.reach_m; });
}

void DrawnWakes::declare(SurfaceSlots& slots, std::size_t) const {
  slots.set("wakes", gpu::value_wake_levels, std::uint32_t(levels_of_window_));
  slots.bind(gpu::slot_wakes, images_.shift());
}

void DrawnWakes::describe(gpu::FrameData& frame, glm::dvec2 grid_origin_m) const {
  gpu::WakeData& data = frame.sea.wakes;
  data = {};
  if (surface_ == nullptr) return;
  const WakeSurface& surface = *surface_;
  data.count.x = int(surface.parts().size());
  for (int i = 0; i < surface.levels(); ++i) data.half_m[i] = float(surface.half_m(i));
  data.half_m.w = float(surface.share());
  for (std::size_t n = 0; n < surface.parts().size(); ++n) {
    const WakeSurface::Part& part = surface.parts()[n];
    gpu::WakeWindow& window = data.window[n];
    const gpu::LodWindows windows = part.surface.windows(grid_origin_m);
    for (int i = 0; i < surface.levels(); ++i) {
      window.middle[i] =
          glm::vec4(glm::vec2(part.middle_m[std::size_t(i)] - grid_origin_m), float(part.presence), 0.0f);
      window.slice[i] = windows.slice[i];
      window.level[i] = glm::vec4(glm::vec3(part.surface.extent(i).slope_moments), part.surface.still(i) ? 0.0f : 1.0f);
    }
  }
}

}  // namespace seascape
