// The surface at given points of a scene, as CSV: the command `query`, with no GPU.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "app/scene.h"

namespace seascape {

// Header `x,z,height_m,normal_x,normal_y,normal_z,velocity_x,velocity_y,velocity_z,converged`, then a row a point in
// the order given: metres; the velocity is the orbital one, of the water at the surface, in metres a second; converged
// is 1 or 0 (0 where the surface folds over itself or the search found no point within a millimetre). The Eulerian rate
// of change of the height at the fixed place, a wave staff's, is velocity_y + (normal_x velocity_x + normal_z
// velocity_z) / normal_y. `time_s` is the sea's time. A scene without waves is flat. The text depends on nothing but
// the arguments: not on the number of cores.
std::string query_csv(const Scene& scene, double time_s, std::span<const glm::dvec2> points);

}  // namespace seascape
