// Solid things on a calm sea, drawn, and the rays through their pictures' pixels.
#pragma once
#include "app/scene_objects.h"
#include "engine/view.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape::test {

using Set = std::vector<std::pair<std::string, std::string>>;

// Still water under a sun 50 degrees high.
inline const Set flat_water{
    {"waves.wind_speed_mps", "0"}, {"waves.swell_height_m", "0"}, {"sky.sun_elevation_deg", "50"}};

// The scene calm at medium with these things only, of one view unless the caller adds more.
ShotOptions solid_options(const FrameLook& look, const SceneObjects& objects, std::uint32_t width, std::uint32_t height,
                          const Set& set = {});

// From an eye through a place of its picture, in pixels from the upper left; of unit length, in the world.
glm::dvec3 pixel_ray(const View& eye, double x, double y, std::uint32_t width, std::uint32_t height);

// Whether a ray meets a box, as much larger or smaller (m) as said.
bool meets_box(const glm::dvec3& from, const glm::dvec3& d, const glm::dvec3& middle, const glm::dvec3& half,
               double more);

}  // namespace seascape::test
