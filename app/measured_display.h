// Where capture shows its frames: nowhere, in a window, or in the simulated headset.
#pragma once
#include <memory>
#include <optional>

#include "app/arguments.h"
#include "app/experience.h"
#include "platform/display.h"
#include "platform/headless.h"
#include "platform/headset_system.h"
#include "platform/simulated_runtime.h"
#include "platform/window.h"

namespace seascape {

// Made before the device, and outlives it.
class MeasuredDisplay {
 public:
  // Adds to `options` what the display needs of the device. Throws Error where there is no such display.
  MeasuredDisplay(DisplayKind kind, DeviceOptions& options);

  // The display of a device made so. A window may hold frames to its screen's rate; the others hold none. `shown`: of
  // what has no size or lens of its own. `size`: of a headset's pictures; 0: as it recommends.
  std::unique_ptr<Display> make(Device& device, const HeadlessOptions& shown, const Settings& settings,
                                const glm::uvec2& size);

 private:
  std::optional<WindowSystem> windows_;
  std::optional<SimulatedRuntime> runtime_;
  std::optional<HeadsetSystem> system_;
};

// What an experience has to be made with for a display.
void suit_display(ExperienceOptions& options, const Display& display);

// Where to stand for the head to be at `head`, in this frame.
Pose carrier_for(const Display& display, const Pose& head);

}  // namespace seascape
