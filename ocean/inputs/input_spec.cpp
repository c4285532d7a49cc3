#include "ocean/inputs/input_spec.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/gltf.h"
#include "engine/image_file.h"
#include "engine/text.h"
#include "ocean/inputs/hull_check.h"
#include "ocean/inputs/hull_map.h"

namespace seascape {

namespace {

struct Checker {
  const InputSpec& spec;

  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw Error(spec.where, what, remedy);
  }
  void number(double value, const std::string& key, InputRange range, std::string_view unit) const {
    if (!(value >= range.least && value <= range.most))
      refuse(key + ": " + text_from(value) + " is out of range", "give a number from " + text_from(range.least) +
                                                                     " to " + text_from(range.most) +
                                                                     (unit.empty() ? "" : " ") + std::string(unit));
  }
  void pair(glm::dvec2 value, const std::string& key, InputRange range, std::string_view unit) const {
    number(value.x, key + "[0]", range, unit);
    number(value.y, key + "[1]", range, unit);
  }
  void value(glm::vec4 v, const std::string& key) const {
    const InputTargetTraits& target = traits(spec.to);
    const int channels = value_channels(spec);
    for (int c = 0; c < channels; ++c)
      number(double(v[c]), channels == 1 ? key : key + "[" + std::to_string(c) + "]",
             spec.blend == InputBlend::scale ? input_factor_range : InputRange{target.least, target.most},
             spec.blend == InputBlend::scale ? "" : target.unit);
  }
  void only_for(InputTarget to, const std::string& what) const {
    if (spec.to != to)
      refuse(what + " is no input of " + std::string(traits(spec.to).name),
             "give it \"to\": \"" + std::string(traits(to).name) + "\"");
  }

  // Gerstner waves run along curves, and patterns of waves do not join as numbers do (ocean/places/shore_lines.h).
  void curve() const {
    const SplineInput* spline = std::get_if<SplineInput>(&spec.shape);
    if (spline == nullptr) refuse("kind: Gerstner waves run along splines alone", "give \"kind\": \"spline\"");
    if (spline->filled)
      refuse("filled: Gerstner waves run along the spline and not over what it surrounds", "remove \"filled\"");
    if (spec.blend != InputBlend::add)
      refuse("blend: waves of two splines do not join; the stronger is left where they meet", "remove \"blend\"");
    if (spec.follow_waves)
      refuse("follow_waves: waves that run along a spline stay in their place", "remove \"follow_waves\"");
  }
  void operator()(const SplineInput& s) const {
    if (s.points.size() > most_input_points)
      refuse("points: " + std::to_string(s.points.size()) + " of them",
             "give at most " + std::to_string(most_input_points));
    if (s.filled && !s.closed) refuse("filled: the spline is not closed", "add \"closed\": true");
    if (s.filled && spec.to == InputTarget::flow && spec.blend != InputBlend::scale)
      refuse("filled: no flow along a spline goes through what it surrounds", "remove \"filled\", or take a vortex");
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const std::string key = "points[" + std::to_string(i) + "]";
      pair(s.points[i].at_m, key + ".at_m", input_place_range, "m");
      number(s.points[i].width_m, key + ".width_m", input_size_range, "m");
      value(s.points[i].value, key + ".value");
    }
  }
  void operator()(const AreaInput& s) const {
    pair(s.at_m, "at_m", input_place_range, "m");
    pair(s.size_m, "size_m", input_size_range, "m");
    number(s.turn_deg, "turn_deg", input_angle_range, "deg");
  }
  void operator()(const VortexInput& s) const {
    only_for(InputTarget::flow, "a vortex");
    if (spec.blend == InputBlend::scale) refuse("blend: a vortex is no factor", "give \"add\" or \"replace\"");
    pair(s.at_m, "at_m", input_place_range, "m");
    number(s.core_m, "core_m", input_size_range, "m");
    number(s.reach_m, "reach_m", {s.core_m, input_size_range.most}, "m");
    number(s.swirl_mps, "swirl_mps", {-100.0, 100.0}, "m/s");
    number(s.inflow_mps, "inflow_mps", {-100.0, 100.0}, "m/s");
  }
  void operator()(const ShapeInput& s) const {
    pair(s.at_m, "at_m", input_place_range, "m");
    number(s.turn_deg, "turn_deg", input_angle_range, "deg");
    number(s.scale, "scale", input_model_range, "");
    if (s.from == ShapeInput::From::height && (traits(spec.to).channels > 1 || spec.blend == InputBlend::scale))
      refuse("from: a height is no value of " +
                 std::string(spec.blend == InputBlend::scale ? "a factor" : traits(spec.to).name),
             "remove it, and give a \"value\"");
    if (s.from == ShapeInput::From::material) {
      only_for(InputTarget::albedo, "a material");
      if (spec.blend == InputBlend::scale)
        refuse("from: a material is no factor", "give the blend \"add\" or \"replace\"");
    }
    if (s.from == ShapeInput::From::hull) {
      volume("a hull");
      number(s.at_height_m, "at_height_m", input_height_range, "m");
      number(s.pitch_deg, "pitch_deg", input_angle_range, "deg");
      number(s.roll_deg, "roll_deg", input_angle_range, "deg");
    }
    if (s.model == nullptr) refuse("file: " + in_quotes(s.file) + " was not read", "read the model first");
    std::size_t triangles = 0;
    for (const MeshPart& part : s.model->parts) triangles += part.indices.size() / 3;
    if (triangles > most_input_triangles)
      refuse("file: " + in_quotes(s.file) + " has " + std::to_string(triangles) + " triangles",
             "give a model of at most " + std::to_string(most_input_triangles));
  }
  // What all volumes have in common.
  void volume(const std::string& what) const {
    only_for(InputTarget::clip, what);
    if (spec.blend != InputBlend::replace)
      refuse("blend: " + what + " replaces what is there", "remove it; a \"value\" of 0 lets the water be");
    if (spec.weight != 1.0)
      refuse("weight: " + text_from(spec.weight) + " of " + what + " is neither all nor nothing", "remove it");
    if (spec.feather_m != 0.0) refuse("feather_m: " + what + " has no soft edge", "remove it");
    if (spec.follow_waves) refuse("follow_waves: " + what + " stays in its place", "remove it");
  }
  void operator()(const VolumeInput& s) const {
    const std::string name(input_kinds[7 + std::size_t(s.form)]);
    volume("a " + name);
    number(s.at_m.x, "at_m[0]", input_place_range, "m");
    number(s.at_m.y, "at_m[1]", input_height_range, "m");
    number(s.at_m.z, "at_m[2]", input_place_range, "m");
    number(s.turn_deg, "turn_deg", input_angle_range, "deg");
    number(s.pitch_deg, "pitch_deg", input_angle_range, "deg");
    number(s.roll_deg, "roll_deg", input_angle_range, "deg");
    if (s.form == VolumeInput::Form::box) {
      for (int i = 0; i < 3; ++i) number(s.size_m[i], "size_m[" + std::to_string(i) + "]", input_size_range, "m");
      number(s.round_m, "round_m", {0.0, 0.5 * std::min({s.size_m.x, s.size_m.y, s.size_m.z})},
             "m, half the least side");
      return;
    }
    number(s.radius_m, "radius_m", input_size_range, "m");
    if (s.form == VolumeInput::Form::capsule)
      number(s.length_m, "length_m", {2.0 * s.radius_m, 4e6}, "m, twice its radius and more");
    if (s.form == VolumeInput::Form::cylinder) number(s.length_m, "length_m", input_size_range, "m");
  }
  void operator()(const TextureInput& s) const {
    pair(s.at_m, "at_m", input_place_range, "m");
    pair(s.size_m, "size_m", input_size_range, "m");
    number(s.turn_deg, "turn_deg", input_angle_range, "deg");
    number(s.scale, "scale", input_map_range, "");
    number(s.offset, "offset", input_map_range, "");
    const std::size_t channels = spec.blend == InputBlend::scale ? 1 : std::size_t(traits(spec.to).channels);
    if (!s.channels.empty() &&
        (s.channels.size() != channels || s.channels.find_first_not_of("rgba") != std::string::npos))
      refuse("channels: " + in_quotes(s.channels) + " does not name " + std::to_string(channels) + " of the picture's",
             "give so many letters of r, g, b and a, as \"" + std::string("rgba").substr(0, channels) + "\"");
    if (s.image == nullptr) refuse("file: " + in_quotes(s.file) + " was not read", "read the picture first");
    const std::size_t texels = std::size_t(s.image->width) * std::size_t(s.image->height);
    if (texels == 0 || texels > most_input_texels || s.image->pixels.size() != 4 * texels)
      refuse("file: " + in_quotes(s.file) + " has " + std::to_string(s.image->width) + "x" +
                 std::to_string(s.image->height) + " pixels",
             "give a picture of at most 4096x4096");
    for (std::size_t i = 0; i < s.image->pixels.size(); ++i)
      if (!std::isfinite(s.image->pixels[i]))
        refuse("file: " + in_quotes(s.file) + " holds NaN or infinity at column " +
                   std::to_string(i / 4 % std::size_t(s.image->width)) + ", row " +
                   std::to_string(i / 4 / std::size_t(s.image->width)),
               "repair the picture");
  }
  void operator()(const TrailInput& s) const {
    if (s.keys.size() > most_input_points)
      refuse("keys: " + std::to_string(s.keys.size()) + " of them",
             "give at most " + std::to_string(most_input_points));
    for (std::size_t i = 0; i < s.keys.size(); ++i) {
      const std::string key = "keys[" + std::to_string(i) + "]";
      number(s.keys[i].time_s, key + ".time_s", input_time_range, "s");
      pair(s.keys[i].at_m, key + ".at_m", input_place_range, "m");
      if (i > 0 && !(s.keys[i].time_s >= s.keys[i - 1].time_s + 1e-3))
        refuse(
            key + ".time_s: " + text_from(s.keys[i].time_s) + " does not come after " + text_from(s.keys[i - 1].time_s),
            "give a later time, by 0.001 s at least");
    }
    number(s.radius_m, "radius_m", input_size_range, "m");
    number(s.life_s, "life_s", input_life_range, "s");
    number(s.spread_mps, "spread_mps", {0.0, 100.0}, "m/s");
    if (!s.loop || s.keys.size() < 2) return;
    if (glm::distance(s.keys.front().at_m, s.keys.back().at_m) > 1e-3)
      refuse("loop: the last key is not where the first one is", "end the keys at the first one's at_m");
    const double period = s.keys.back().time_s - s.keys.front().time_s;
    if (s.life_s > 16.0 * period)
      refuse("life_s: " + text_from(s.life_s) + " is out of range",
             "give at most 16 times the loop's " + text_from(period) + " s");
  }
};

}  // namespace

int value_channels(const InputSpec& spec) {
  const bool speed = spec.to == InputTarget::flow && std::holds_alternative<SplineInput>(spec.shape);
  return spec.blend == InputBlend::scale || speed ? 1 : traits(spec.to).channels;
}

bool is_volume(const InputSpec& spec) {
  const ShapeInput* shape = std::get_if<ShapeInput>(&spec.shape);
  return std::holds_alternative<VolumeInput>(spec.shape) || (shape != nullptr && shape->from == ShapeInput::From::hull);
}

void validate(const InputSpec& spec) {
  const Checker check{spec};
  check.number(spec.weight, "weight", input_share_range, "");
  check.number(spec.feather_m, "feather_m", input_feather_range, "m");
  check.number(spec.order, "order", input_order_range, "");
  check.value(spec.value, "value");
  if ((spec.blend == InputBlend::min || spec.blend == InputBlend::max) &&
      (spec.to == InputTarget::flow || spec.to == InputTarget::albedo))
    check.refuse("blend: neither velocities nor colours have a " + std::string(input_blends[std::size_t(spec.blend)]),
                 "give \"add\", \"replace\" or \"scale\"");
  if (spec.to == InputTarget::gerstner) check.curve();
  std::visit(check, spec.shape);
}

void validate_hull(const InputSpec& spec) {
  const ShapeInput& shape = std::get<ShapeInput>(spec.shape);
  const std::string fault = hull_fault(*shape.model);
  if (!fault.empty())
    Checker{spec}.refuse("file: " + in_quotes(shape.file) + " " + fault,
                         "close it, an open boat by a deck, or take another \"from\"");
}

}  // namespace seascape
