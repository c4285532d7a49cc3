// Sun, sky and air. Plain values.
#pragma once

namespace seascape {

struct SkySettings {
  double sun_elevation_deg = 35.0;  // -5 to 90
  double sun_to_deg = 200.0;        // where the sun stands, degrees clockwise from -z seen from above
  double haze = 1.0;                // aerosol: 0 pure air, 1 a clear day at sea, up to 8 milky
  double visibility_m = 40e3;       // distance at which haze leaves 2 % of the contrast
  double exposure_ev = 0.0;         // stops added to the automatic exposure of the scene's light
};

}  // namespace seascape
