// Slots of the shaders that draw: where each binding and each specialisation constant is. Each has its number to
// itself, so that shaders may be put together of any of the files that declare them.
#ifndef SEASCAPE_SLOTS_H
#define SEASCAPE_SLOTS_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

// Bindings. Where a tile has three images, the displacement's slot is named; derivatives and moments follow it.
SEASCAPE_CONST int slot_frame = 0;  // FrameData
SEASCAPE_CONST int slot_sky_map = 4, slot_sky_light = 5;
SEASCAPE_CONST int slot_lit_picture = 6;
SEASCAPE_CONST int slot_probe = 8;
SEASCAPE_CONST int slot_smooth_sampler = 50, slot_pixel_sampler = 51;
SEASCAPE_CONST int slot_longest_tile = 1, slot_tiles = 9;
SEASCAPE_CONST int slot_particles = 12, slot_gerstner = 19, slot_baked = 22, slot_shore = 44;
SEASCAPE_CONST int slot_shore_lines = 47, slot_shore_ways = 48;
SEASCAPE_CONST int slot_dynamic_shift = 25, slot_dynamic_slope = 26;
SEASCAPE_CONST int slot_wakes = 66;
SEASCAPE_CONST int slot_level = 27, slot_bed = 15, slot_bed_waves = 28, slot_flow = 29;
SEASCAPE_CONST int slot_clip = 30, slot_clip_nodes = 38, slot_clip_volumes = 39, slot_clip_hulls = 40;
SEASCAPE_CONST int slot_albedo = 31, slot_shadow = 32;
SEASCAPE_CONST int slot_foam = 34, slot_foam_lace = 35;
SEASCAPE_CONST int slot_points = 16, slot_footprints = 17, slot_point_depths = 18, slot_point_sides = 68;
SEASCAPE_CONST int slot_sea_depths = 36;
SEASCAPE_CONST int slot_sun_map = 54, slot_comfort = 55;
SEASCAPE_CONST int slot_solid_material = 56, slot_solid_sky = 57, slot_solid_albedo = 58;
SEASCAPE_CONST int slot_solid_base_colour = 59, slot_solid_metallic_roughness = 60, slot_solid_normal = 61,
                   slot_solid_occlusion = 62, slot_solid_emissive = 63;
SEASCAPE_CONST int slot_solids_in_water = 64, slot_solids_above = 65;
SEASCAPE_CONST int slot_near_patches = 69, slot_near_found = 70, slot_near_listed = 71, slot_near_draw = 72;

// Specialisation constants. Those that say how much there is of an effect are 0 without it, and nothing of it is left
// in a shader then.
SEASCAPE_CONST int value_multiview = 0;
SEASCAPE_CONST int value_tile_shape = 2, value_debug = 4, value_sky_ray = 6;
SEASCAPE_CONST int value_deferred = 10, value_anisotropy = 5, value_probe = 1;
SEASCAPE_CONST int value_cascades = 7, value_warp = 20;
SEASCAPE_CONST int value_particles = 8, value_gerstner = 11, value_baked = 12, value_shore_waves = 28;  // layings
SEASCAPE_CONST int value_dynamic_levels = 13, value_wake_levels = 32;
SEASCAPE_CONST int value_level = 14, value_bed = 15, value_flow = 16;
SEASCAPE_CONST int value_clip = 17, value_clip_kinds = 24, value_clip_samples = 9;
SEASCAPE_CONST int value_albedo = 18, value_shadow = 19;
SEASCAPE_CONST int value_foam = 3, value_foam_kept = 21, value_foam_spared = 29;
SEASCAPE_CONST int value_depth_sampled = 22, value_hidden = 23, value_blend = 26, value_models = 25,
                   value_solids_in_water = 27, value_wide = 31, value_solids_above = 46, value_sun_map = 30,
                   value_underwater = 33, value_lamp = 36;
// How many there are, of those that the frame is told of.
SEASCAPE_CONST int value_air_pockets = 44, value_portals = 45;

// Of the stencil of the sea's points: from here on the eye's line of sight begins in the air.
SEASCAPE_CONST uint side_in_air = 128u;

// Of the points of the sea that are lit later: the last word of one that is a solid thing, no two half floats that a
// sea's point has there.
SEASCAPE_CONST uint kept_solid = 0xffffffffu;

SEASCAPE_SHARED_END
#endif
