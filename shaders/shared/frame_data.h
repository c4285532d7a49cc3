// What every shader of a frame is told: the eyes, the light, the place.
#ifndef SEASCAPE_FRAME_DATA_H
#define SEASCAPE_FRAME_DATA_H
#include "foam_data.h"
#include "gpu_types.h"
#include "lamp_data.h"
#include "mesh_data.h"
#include "sea_data.h"
#include "slots.h"
#include "solid_data.h"
#include "water_line.h"
SEASCAPE_SHARED_BEGIN

struct ViewData {
  mat4 clip_from_relative;   // from metres relative to the viewer
  vec4 ray_x, ray_y, ray_z;  // world direction of a pixel at normalised device (x, y): x ray_x + y ray_y + ray_z
  vec4 eye;                  // xyz: the eye relative to the viewer in metres; w: radians a pixel at the centre
};

struct FrameData {
  ViewData view[2];
  vec4 viewer;  // xy: the viewer's x, z relative to the grid origin; z: its height above the still sea; w: the
                // Earth's curvature, 1/m (0: flat)
  vec4 sun;     // xyz: towards the sun; w: cosine of its angular radius
  vec4 air;  // x: extinction of haze a metre; y: exposure, stops; z: distance of the near plane in metres; w: at most
             // so many times longer than wide is what a pixel asks of the waves (water.anisotropy)
  vec4 water_absorption;   // rgb: 1/m; w: strength of light through crests
  vec4 water_backscatter;  // rgb: 1/m; w: strength of glitter
  vec4 water_reflectance;  // rgb: radiance from below over irradiance that enters, 1/sr; w: share of the sun's that
                           // enters a level sea
  vec4 water_scattering;   // rgb: all of it, 1/m; w: height of the still water at the viewer, m
  vec4 water_at_eye[2];    // of each eye: x: how high over it the water is felt, m; y, z: its slopes; w: unused
  vec4 whitecap;           // x: strength; y: Jacobian below which foam forms; z, w: unused
  // Where a place (x, z: metres from the viewer along the still sea; y: above it) is in the map of the sun: rows of its
  // column and row from 0 to 1, and of how near the sun, 1 nearest.
  vec4 sun_map_column, sun_map_row, sun_map_near;
  vec4 sun_map;  // x: a texel, m; y: its reach from the viewer, m; z: from nearest to farthest, m; w: share of its side
                 // that is drawn, 0: it is not there
  ivec4 shown;   // x: a debug view; y: where the eyes are; z, w: unused
  MeshData mesh;
  MeshData bed_mesh;  // likewise of the bed, where eyes may be in the water over one
  SeaData sea;
  FoamData foam;              // where it is simulated
  SolidsThroughWater solids;  // where there are any
  LampData lamp;              // that the viewer carries
  WaterShapes shapes;         // likewise
};

// Values of shown.y: all in air; near the surface, so that each pixel decides; all in water.
SEASCAPE_CONST int eyes_in_air = 0;
SEASCAPE_CONST int eyes_in_either = 1;
SEASCAPE_CONST int eyes_in_water = 2;

// Values of shown.x, in the order of app/render_settings.h's DebugView.
SEASCAPE_CONST int debug_none = 0;
SEASCAPE_CONST int debug_holes = 1;
SEASCAPE_CONST int debug_lod = 2;
SEASCAPE_CONST int debug_wireframe = 3;
SEASCAPE_CONST int debug_normals = 4;
SEASCAPE_CONST int debug_slices = 5;

// What the sky gives the sea: written by sky_light.comp, read by every shader that needs light.
struct SkyLight {
  vec4 sun_irradiance;  // rgb: on a plane facing the sun at sea level, W/m^2 per channel up to a constant
  vec4 sky_irradiance;  // rgb: on a level plane, from the sky without the sun
  vec4 exposure;        // x: factor from radiance to picture
};

// Push constants of everything drawn: which view, where no multiview pass says it.
struct DrawPush {
  uint eye;
};

SEASCAPE_SHARED_END
#endif
