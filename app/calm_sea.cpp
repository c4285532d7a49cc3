#include "app/calm_sea.h"

namespace seascape {

Scene calm_sea(const Scene& awaited, DeviceClass device) {
  constexpr const char* preset = "low";
  Scene calm;
  calm.title = awaited.title;
  calm.start = awaited.start;
  apply_preset(calm.settings, preset);
  suit_device(calm.settings, preset, device);
  Settings& own = calm.settings;
  own.sky = awaited.settings.sky;
  own.comfort = awaited.settings.comfort;
  own.headset = awaited.settings.headset;
  own.mirror = awaited.settings.mirror;
  own.adaptive_use = awaited.settings.adaptive_use;
  own.adaptive = awaited.settings.adaptive;
  own.render.near_m = awaited.settings.render.near_m;
  own.render.stereo = awaited.settings.render.stereo;
  own.sea.wind_speed_mps = 2.0;
  own.sea.fetch_m = 60000.0;
  own.sea.swell_height_m = 0.35;
  own.sea.swell_period_s = 13.0;
  return calm;
}

}  // namespace seascape
