#version 460
// What a material's mask takes away lets the sun through.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/solid_data.h"

layout(binding = slot_solid_material) uniform Material { SolidMaterialData material; };
layout(binding = slot_solid_base_colour) uniform sampler2D base_colour_texture;

layout(location = 0) in vec4 uv;
layout(location = 1) in float alpha;

void main() {
  const vec2 from = material.uv_offset[solid_base_colour].z > 0.5 ? uv.zw : uv.xy;
  const vec4 axes = material.uv_axes[solid_base_colour];
  const vec2 at = axes.xy * from.x + axes.zw * from.y + material.uv_offset[solid_base_colour].xy;
  const float there = material.base_colour.a * alpha * texture(base_colour_texture, at).a;
  if (there < material.emissive_cutoff.w) discard;
}
