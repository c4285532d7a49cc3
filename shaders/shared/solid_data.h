// Solid things: what their shaders are told of corners, places and materials.
#ifndef SEASCAPE_SOLID_DATA_H
#define SEASCAPE_SOLID_DATA_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

// A corner of a model, in its mesh's own axes.
struct SolidVertex {
  vec4 place;   // xyz: metres; w: unused
  vec4 normal;  // xyz: of unit length; w: unused
  vec4 uv;      // xy: the first places in textures; zw: the second
  vec4 colour;  // of the base colour a factor
};

// Where a mesh is drawn: rows of the transform from its axes to metres from the viewer along the curved still sea, and
// above that sea.
struct SolidInstance {
  vec4 row_x, row_y, row_z;
  vec4 picture;  // x: the side of what stands above the water that it is drawn for (solids_above.h), else 0
};

SEASCAPE_CONST int solid_base_colour = 0, solid_metallic_roughness = 1, solid_normal = 2, solid_occlusion = 3,
                   solid_emissive = 4, solid_textures = 5;

struct SolidMaterialData {
  vec4 base_colour;
  vec4 emissive_cutoff;  // rgb: factor; w: alpha below which nothing is there, negative: everything is
  vec4 surface;          // x: metallic; y: roughness; z: strength of the normal map; w: of the occlusion map
  ivec4 kind;            // x: 1 unlit; y: 1 has a normal map; z, w: unused
  vec4 uv_axes[5];       // of each texture, by columns
  vec4 uv_offset[5];     // xy; z: which places, 0 or 1; w: unused
};

// The sky and the sea below it as surfaces of some roughness mirror them, in an octahedral map a layer. The first is of
// solid_least_rough, each further one rougher by a step, up to 1; the last is what a white wall sends back.
SEASCAPE_CONST int solid_sky_side = 64, solid_sky_layers = 7;
SEASCAPE_CONST float solid_least_rough = 0.15f;
SEASCAPE_CONST int solid_albedo_side = 32;  // of the table of what is mirrored in all directions

// Things under water are drawn into a picture of their own, which the water's surface shows where it refracts the eye's
// rays. It sees by so much more on each side than the eye, as such rays leave what the eye sees.
SEASCAPE_CONST float solid_margin = 1.2f;

// And things above it into pictures around a place over the viewer (shared/solids_above.h), for eyes in the water.
struct SolidsThroughWater {
  vec4 seen[2];  // of each eye, where its picture may show them: least x, y and most in clip space; none: least > most
  vec4 reach;  // x: their lowest point; y: the water's highest, metres above the still sea; zw: pixels of that picture
  vec4 above;  // xyz: the middle of the pictures of things above it, m from the viewer; w: no thing there is nearer to
               // that, m; 0: there are none
};

struct SolidSkyPush {
  vec4 water_reflectance;  // FrameData
};

SEASCAPE_SHARED_END
#endif
