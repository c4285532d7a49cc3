// The light of a solid thing: sun, sky and sea on glTF's metallic-roughness material. Included after the uniform block
// `frame` has been declared.
#ifndef SEASCAPE_SOLID_LIGHT_GLSL
#define SEASCAPE_SOLID_LIGHT_GLSL
#include "shared/earth_curve.h"
#include "shared/fresnel.h"
#include "shared/solid_data.h"
#include "lib/ggx.glsl"
#include "lib/octahedron.glsl"
#include "lib/sky_light.glsl"
#include "lib/sun_map.glsl"
#include "lib/tone.glsl"
#include "lib/underwater.glsl"

layout(binding = slot_solid_material) uniform Material { SolidMaterialData material; };
layout(binding = slot_solid_sky) uniform sampler2DArray solid_sky;
layout(binding = slot_solid_albedo) uniform sampler2D solid_albedo;
layout(binding = slot_solid_base_colour) uniform sampler2D base_colour_texture;
layout(binding = slot_solid_metallic_roughness) uniform sampler2D metallic_roughness_texture;
layout(binding = slot_solid_normal) uniform sampler2D normal_texture;
layout(binding = slot_solid_occlusion) uniform sampler2D occlusion_texture;
layout(binding = slot_solid_emissive) uniform sampler2D emissive_texture;

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 uv;
// Beside a thin triangle its colours would go on below 0, or to many times their own.
layout(location = 3) centroid in vec4 tint;

vec2 place_in(int texture_number) {
  const vec2 from = material.uv_offset[texture_number].z > 0.5 ? uv.zw : uv.xy;
  const vec4 axes = material.uv_axes[texture_number];
  return axes.xy * from.x + axes.zw * from.y + material.uv_offset[texture_number].xy;
}

// The normal map's normal, with tangents from derivatives (Schüler 2013, "Normal mapping without precomputed
// tangents"; its y goes up the picture, ours down). Green is up in the texture, against v. From behind a bump is a
// dent: normals are reversed there (glTF 2.0, section 3.9).
vec3 mapped_normal(vec3 n, vec2 at, bool front) {
  const vec3 along = dFdx(relative), across = dFdy(relative);
  const vec2 uv_along = dFdx(at), uv_across = dFdy(at);
  const vec3 q = cross(n, across), p = cross(along, n);
  const vec3 t = q * uv_along.x + p * uv_across.x, b = q * uv_along.y + p * uv_across.y;
  const float longest = max(dot(t, t), dot(b, b));
  if (longest <= 0.0) return n;
  // Its z follows from the others, which are all that textures in blocks keep.
  vec3 map = vec3(2.0 * texture(normal_texture, at).xy - 1.0, 0.0);
  map.z = sqrt(max(1.0 - dot(map.xy, map.xy), 0.0));
  map.xy *= front ? material.surface.z : -material.surface.z;
  return normalize((t * map.x - b * map.y) * inversesqrt(longest) + n * max(map.z, 1e-3));
}

// What comes from all around, of one roughness.
vec3 surroundings(vec3 d, float rough) {
  const float level = (rough - solid_least_rough) / (1.0 - solid_least_rough) * float(solid_sky_layers - 2);
  const vec2 at = octahedron_place(d);
  const float below = clamp(floor(level), 0.0, float(solid_sky_layers - 2)), share = clamp(level - below, 0.0, 1.0);
  const vec3 smoother = textureLod(solid_sky, vec3(at, below), 0.0).rgb;
  const vec3 rougher = textureLod(solid_sky, vec3(at, min(below + 1.0, float(solid_sky_layers - 2))), 0.0).rgb;
  return mix(smoother, rougher, share);
}

// What its material is in a pixel.
struct SolidPoint {
  vec4 base;
  vec3 emissive, normal;  // radiance over exposure; towards the eye's side
  vec3 smooth_normal;     // the same without the normal map
  vec3 flat_normal;       // of its triangle
  float metallic, rough, occlusion;
};

// Discards what its material's mask takes away.
SolidPoint solid_point() {
  SolidPoint p;
  p.base = material.base_colour * tint * texture(base_colour_texture, place_in(solid_base_colour));
  const vec3 surface_map = texture(metallic_roughness_texture, place_in(solid_metallic_roughness)).rgb;
  const float occlusion_map = texture(occlusion_texture, place_in(solid_occlusion)).r;
  p.emissive = material.emissive_cutoff.rgb * texture(emissive_texture, place_in(solid_emissive)).rgb;
  // Towards the eye by the picture's own axes. Corners' order does not say which side is seen: a sail on its other tack
  // is mirrored.
  p.flat_normal = cross(dFdy(relative), dFdx(relative));
  p.flat_normal /= max(length(p.flat_normal), 1e-12);
  const bool front = dot(p.flat_normal, normal) >= 0.0;
  p.normal = p.smooth_normal = normalize(normal) * (front ? 1.0 : -1.0);
  if (material.kind.y != 0) p.normal = mapped_normal(p.normal, place_in(solid_normal), front);
  if (p.base.a < material.emissive_cutoff.w) discard;
  p.metallic = material.surface.x * surface_map.b;
  p.rough = max(material.surface.y * surface_map.g, 0.045);
  p.occlusion = 1.0 + material.surface.w * (occlusion_map - 1.0);
  return p;
}

// How much of the sun's light the map of the sun leaves. A round thing's triangles turn from the sun before its normals
// do, or after, and hide from it what those have lit: a jagged band. So where a triangle is turned from the sun no
// farther than it is from its round shape, the shape counts (the shadow terminator: Woo, Pearce and Ouellette 1996),
// and only what stands farther towards the sun than its own triangles reach: some chords of the round shape, of as much
// of a turn as normal and triangle are apart.
float sun_reaches_thing(SolidPoint p) {
  const vec3 at = flattened(relative + vec3(0.0, frame.viewer.z, 0.0), frame.viewer.w), l = frame.sun.xyz;
  const float reaches = sun_reaches(at, p.smooth_normal);
  const float turns_along = length(dFdx(p.smooth_normal)) / max(length(dFdx(relative)), 1e-9),
              turns_across = length(dFdy(p.smooth_normal)) / max(length(dFdy(relative)), 1e-9);  // 1/m
  const float apart = length(p.flat_normal - p.smooth_normal);
  if (apart < 0.01) return reaches;
  const float turned = 1.0 - clamp(dot(p.flat_normal, l) / apart, 0.0, 1.0),
              round = clamp(10.0 * dot(p.smooth_normal, l) / apart, 0.0, 1.0);
  if (turned * round <= reaches) return reaches;
  const float farther = min(4.0 * apart / max(max(turns_along, turns_across), 1e-6), frame.sun_map.y);
  return max(reaches, turned * round * sun_reaches(at + farther * l, p.smooth_normal));
}

// Irradiance of what comes evenly through the surface, on a plane under water over that on a level one: the sky fills a
// cone of 48.6 degrees there, of which a wall has a fifth (integral of the cosine over the cone).
float of_sky_in_water(float up) { return max(0.2 + up * (0.5 + 0.3 * up), 0.0); }

// Radiance beneath the water of a thing that lies just under it, without what it shines by itself. Around it all is
// dim, which metals would mirror: they are taken for paint of their colour.
vec3 solid_sent_in_water(SolidPoint p) {
  const vec3 l = -refract(-frame.sun.xyz, vec3(0.0, 1.0, 0.0), 1.0 / water_index);
  const vec3 sun = light.sun_irradiance.rgb * frame.water_reflectance.w, sky = 0.93 * light.sky_irradiance.rgb;
  // What the water around sends back comes from below, through the surface as radiance_from_below() has it.
  const vec3 back = 3.14159265 * frame.water_reflectance.rgb * (water_index * water_index / 0.98) * (sun + sky);
  float reaches = 1.0;
  if (sun_map_there) reaches = sun_reaches_thing(p);
  vec3 there = sun * (reaches * max(dot(p.normal, l), 0.0) / l.y) + sky * of_sky_in_water(p.normal.y);
  there += back * (0.5 - 0.5 * p.normal.y);
  return p.base.rgb * there * (p.occlusion / 3.14159265);
}

// What a thing sends towards `v` of light that comes from `l` to a plane that faces it: 1/sr, the plane's cosine `nl`
// left out. `a`: width of its facets (lib/ggx.glsl); `f0`: what they mirror of light along their normals; `spread`:
// share of the light that goes anywhere.
vec3 solid_sent(vec3 n, vec3 l, vec3 v, float nl, float nv, float a, vec3 f0, vec3 spread) {
  const vec3 h = normalize(v + l);
  const float nh = max(dot(n, h), 0.0), vh = max(dot(v, h), 0.0);
  const vec3 f = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0);
  const vec3 by_facets = f * (ggx_facets(nh, a) * ggx_seen(nl, nv, a));
  return by_facets + spread / 3.14159265;
}

// Of the lamp's light.
vec3 solid_of_lamp(SolidPoint p, vec3 v, float nv, vec3 f0, vec3 spread) {
  const LampThere there = lamp_there(relative);
  const float nl = dot(p.normal, there.towards);
  if (nl <= 0.0) return vec3(0.0);
  return there.irradiance * nl * solid_sent(p.normal, there.towards, v, nl, nv, p.rough * p.rough, f0, spread);
}

// The same under water, where paint, wood and stone (of index 1.5) mirror less.
vec3 solid_of_lamp_in_water(SolidPoint p, ViewData view) {
  const vec3 v = normalize(view.eye.xyz - relative);
  const vec3 f0 = mix(vec3(0.0035), p.base.rgb, p.metallic);
  return solid_of_lamp(p, v, max(abs(dot(p.normal, v)), 1e-3), f0, p.base.rgb * (1.0 - p.metallic));
}

// Radiance towards the eye, what the air or the water before it makes of it included, exposed, and how much of what
// lies behind it hides. Discards what its material's mask takes away.
vec4 solid_light() {
  const ViewData view = frame.view[eye_index()];
  const SolidPoint p = solid_point();
  // In a scene with portals what is not seen in their water is lit as in the air.
  const vec3 sight = normalize(relative - view.eye.xyz);
  if (underwater && !hidden_by_portals(relative - 0.03 * sight, view.eye.xyz)) {
    const bool unlit = material.kind.x != 0;
    const vec3 sent = unlit ? vec3(0.0) : solid_sent_in_water(p),
               own = (unlit ? p.base.rgb : p.emissive) / light.exposure.x;
    vec3 of_lamp = vec3(0.0);
    if (lamp_carried && lamp_shines() && !unlit) of_lamp = solid_of_lamp_in_water(p, view);
    return vec4(light_in_water(sent, own, of_lamp, relative, view) * (light.exposure.x * exp2(frame.air.y)), p.base.a);
  }
  const vec3 n = p.normal, to_eye = view.eye.xyz - relative, l = frame.sun.xyz;
  const float range = length(to_eye);
  const vec3 v = to_eye / range;
  const float a = p.rough * p.rough, nv = max(abs(dot(n, v)), 1e-3);

  // What is mirrored of white surroundings, once and after further bounces between facets (Fdez-Aguera 2019).
  const vec3 f0 = mix(vec3(0.04), p.base.rgb, p.metallic), albedo = p.base.rgb * (1.0 - p.metallic);
  const vec2 in_table = (vec2(nv, p.rough) * float(solid_albedo_side - 1) + 0.5) / float(solid_albedo_side);
  const vec2 table = textureLod(solid_albedo, in_table, 0.0).xy;
  const float once = table.x + table.y;
  const vec3 mirrored = f0 * table.x + table.y, mean = f0 + (1.0 - f0) / 21.0;
  const vec3 again = mirrored * mean / (1.0 - mean * (1.0 - once)) * (1.0 - once);
  const vec3 spread = albedo * (1.0 - mirrored - again);

  const vec3 wall = textureLod(solid_sky, vec3(octahedron_place(n), float(solid_sky_layers - 1)), 0.0).rgb;
  // Rough facets mirror most of what lies nearer the normal (Lagarde and de Rousiers 2014, section 4.9.3).
  const vec3 mirrored_from = normalize(mix(n, reflect(-v, n), (1.0 - a) * (sqrt(1.0 - a) + a)));
  vec3 lit = p.occlusion * (mirrored * surroundings(mirrored_from, p.rough) + (again + spread) * wall);

  const float nl = dot(n, l);
  if (nl > 0.0) {
    float reaches = 1.0;
    if (sun_map_there) reaches = sun_reaches_thing(p);
    lit += reaches * light.sun_irradiance.rgb * nl * solid_sent(n, l, v, nl, nv, a, f0, again + spread);
  }
  if (lamp_carried && lamp_shines()) lit += solid_of_lamp(p, v, nv, f0, again + spread);
  lit += p.emissive / light.exposure.x;
  if (material.kind.x != 0) lit = p.base.rgb / light.exposure.x;
  lit = through_air(lit, v, range);
  if (underwater) lit = seen_behind_water(lit, relative, view);
  return vec4(lit * (light.exposure.x * exp2(frame.air.y)), p.base.a);
}

// Radiance beneath the water of a thing that lies just under it, times the exposure: what the water takes away is left
// to who knows how much of it there is (lib/solids_in_water.glsl).
vec3 solid_in_water() {
  const SolidPoint p = solid_point();
  if (material.kind.x != 0) return p.base.rgb;
  return solid_sent_in_water(p) * light.exposure.x + p.emissive;
}
#endif
