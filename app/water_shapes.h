// A scene's pockets of air and portals as a frame's shaders are told of them. Pure.
#pragma once
#include "app/scene_shapes.h"
#include "ocean/mesh/portal_sight.h"
#include "ocean/sea/sea_view.h"
#include "ocean/surface/eyes_in.h"
#include "ocean/surface/water_line.h"

namespace seascape {

// Shapes where their things stand now, relative to the viewer. `sea`: what is felt of it; null: it lies still at y = 0.
gpu::WaterShapes placed_shapes(const SceneShapes& shapes, const SceneObjects& objects, const glm::dvec3& viewer_m,
                               const SeaView* sea);

// Whether a place of the world (m) is kept dry: in a pocket's air, or in a scene with portals outside of volumes that
// one flies through.
bool kept_dry(const SceneShapes& shapes, const SceneObjects& objects, const glm::dvec3& at_m, const SeaView& sea);

// How high water stands in a shape that is open below, m: its air, which filled it at the surface, has
// 10.08/(10.08 + d) of its volume where that water is d metres deep (Boyle 1662; 10.08 m of sea water press as the
// atmosphere does). `number`: of shapes.air, without water of its own; `sea_m`: height of the still sea. All relative
// to the viewer.
double level_by_boyle_m(const WaterLines& lines, int number, double radius_m, double sea_m);

// Where eyes are among shapes: pixels decide where the surface is cut away.
struct EyesAmongShapes {
  EyesIn eyes = EyesIn::air;
  bool from_above = true;  // some may see the surface from above
  bool high_air = false;   // a pocket of air comes up to where the surface may stand
  PortalSight portals;     // what they see through them; of a scene without any: nothing
};
// Where Ocean::eyes_in() has said `eyes`, of water that stands nowhere higher than `highest_m`, nor as deep in troughs.
EyesAmongShapes eyes_among(EyesIn eyes, const SceneShapes& shapes, const gpu::WaterShapes& placed,
                           const Viewpoint& viewpoint, double highest_m);

}  // namespace seascape
