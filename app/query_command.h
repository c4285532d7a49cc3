// The surface at given points of a scene, as CSV: the command `query`, with no GPU.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "app/scene.h"

namespace seascape {

struct QueryRequest {
  std::vector<double> times_s;  // of the sea, not falling
  bool time_column = false;     // each row begins with its time
  bool all_columns = false;     // and not only those that are always there
  double footprint_m = 0.0;     // QueryOptions::footprint_m
};

// Of rays: where they begin (m) and where they go to (any length but 0).
struct QueryRay {
  glm::dvec3 origin_m, direction;
};

// Columns `x,z,height_m,normal_x,normal_y,normal_z,velocity_x,velocity_y,velocity_z,converged`: metres; the velocity is
// the orbital one, of the water at the surface, in metres a second; converged is 1 or 0 (0 where the surface folds over
// itself or the search found no point within a millimetre). The Eulerian rate of change of the height at the fixed
// place, a wave staff's, is velocity_y + (normal_x velocity_x + normal_z velocity_z) / normal_y but in a current, where
// the water goes another way than the waves; eulerian_y has it anywhere. With `all_columns` then
// `displacement_x,_y,_z,eulerian_x,_y,_z,flow_x,flow_z,depth_m,still_m,clipped,contraction,residual_m,left_out_m`
// (QueryAnswer). Time after time a row a point in the order given. Where the scene has dynamic waves they are as replay
// has them from the scene's camera, stepped from where it begins. The text depends on nothing but the arguments: not on
// the number of cores. Throws Error where that is over an hour away.
std::string query_csv(const Scene& scene, const QueryRequest& request, std::span<const glm::dvec2> points);

// The same of where rays first meet the surface, and a last column `distance_m`: along the ray, -1 where it meets none
// within 10 km.
std::string query_csv(const Scene& scene, const QueryRequest& request, std::span<const QueryRay> rays);

}  // namespace seascape
