// What a scene says of one input: where it lies, what it gives to which of the sea's local data, and how that joins
// what is there. Plain values, in SI units.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace seascape {

struct ImageF;  // engine/image_file.h
struct Model;   // engine/gltf.h

// The local data an input can feed, each of the name of its effect.
enum class InputTarget { level, sea_depth, flow, foam, clip, albedo, shadow, dynamic_waves, gerstner };

struct InputTargetTraits {
  std::string_view name;
  int channels;           // of a value: 1 to 4, the first ones of a vec4
  double least, most;     // of every channel, so that a half float holds it
  std::string_view unit;  // "" for shares of 1
  std::string_view means;
  bool asked = false;  // the sea of this version asks for it; else an input of it changes nothing, and a remark says so
};
// In the order of InputTarget.
inline constexpr std::array<InputTargetTraits, 9> input_targets{{
    {"level", 1, -10000.0, 10000.0, "m", "the still water's height above y = 0", true},
    {"sea_depth", 1, -12000.0, 12000.0, "m", "the bed's height above the still sea, above 0 on land", true},
    {"flow", 2, -100.0, 100.0, "m/s", "the water's velocity along x and z", true},
    {"foam", 1, 0.0, 100.0, "1/s", "the share of the water that foam comes to cover in a second", true},
    {"clip", 1, 0.0, 1.0, "", "1 where there is no water", true},
    {"albedo", 4, 0.0, 1.0, "",
     "a colour that lies on the water: red, green, blue (linear) and cover; the sea keeps them multiplied by the cover",
     true},
    {"shadow", 2, 0.0, 1.0, "", "light kept away: from within the water (soft) and from its surface (hard)", true},
    {"dynamic_waves", 1, -100.0, 100.0, "m", "a pressure on the water, as a head", true},
    {"gerstner", 1, 0.0, 1.0, "", "how high the waves stand, as a share of what their sets say", true},
}};
inline constexpr const InputTargetTraits& traits(InputTarget to) { return input_targets[std::size_t(to)]; }

// How a value v, at a share m = weight x coverage, joins what earlier inputs have left there, b.
enum class InputBlend {
  add,      // b + m v
  replace,  // b + m (v - b); colours lie over what is there (Porter and Duff 1984)
  scale,    // b (1 + m (v - 1)): v is a factor
  min,      // b + m (min(b, v) - b)
  max,      // b + m (max(b, v) - b)
};
inline constexpr std::array<std::string_view, 5> input_blends{"add", "replace", "scale", "min", "max"};

struct InputRange {
  double least, most;
};
inline constexpr InputRange input_place_range{-1e7, 1e7}, input_size_range{1e-3, 1e6}, input_feather_range{0.0, 1e6},
    input_share_range{0.0, 1.0}, input_angle_range{-360.0, 360.0}, input_factor_range{0.0, 1000.0},
    input_map_range{-1e6, 1e6}, input_time_range{-1e9, 1e9}, input_life_range{1e-3, 1e6}, input_order_range{-1e6, 1e6},
    input_model_range{1e-6, 1e6}, input_height_range{-1e4, 1e4};
inline constexpr std::size_t most_inputs = 4096, most_input_points = 65536, most_input_triangles = 262144,
                             most_input_texels = 4096 * 4096, most_input_hulls = 64;

// Angles are clockwise from -z seen from above. Places are x and z.

// A band along a curve through points, as a river. Without its points' own values it has the input's.
struct SplinePoint {
  glm::dvec2 at_m{0.0};
  double width_m = 10.0;
  glm::vec4 value{0.0f};  // of flow x alone: the speed along the curve
};
struct SplineInput {
  std::vector<SplinePoint> points;
  bool closed = false;  // back to the first point
  bool filled = false;  // of a closed one: what lies within the curve, whatever its width, as a lake
};

// An ellipse or a rectangle.
struct AreaInput {
  bool round = true;
  glm::dvec2 at_m{0.0}, size_m{10.0};  // its middle; from side to side
  double turn_deg = 0.0;
};

// Of flow: the vortex of Rankine (1858). Its feather is where it ends.
struct VortexInput {
  glm::dvec2 at_m{0.0};
  double core_m = 5.0;      // radius of the water that turns as a solid
  double reach_m = 50.0;    // radius beyond which there is nothing
  double swirl_mps = 1.0;   // at the core's edge, clockwise seen from above
  double inflow_mps = 0.0;  // at the core's edge, towards the middle
};

// Of clip: a body in the water, turned about its middle as a ship is: first rolled (above 0 its +x side goes down),
// then pitched (its -z end rises), then turned.
struct VolumeInput {
  enum class Form { sphere, box, capsule, cylinder };  // the last two upright
  Form form = Form::sphere;
  glm::dvec3 at_m{0.0};                    // x, height, z of its middle
  glm::dvec3 size_m{10.0};                 // of a box, from side to side
  double round_m = 0.0;                    // radius of a box's edges
  double radius_m = 5.0, length_m = 20.0;  // of the others; of capsule and cylinder from end to end
  double turn_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
};

// A model's triangles seen from above; or of clip, what it encloses.
struct ShapeInput {
  enum class From {
    value,
    height,
    material,
    hull
  };  // height adds the highest point's to the value; material is a base colour
  std::string file;
  std::shared_ptr<const Model> model;
  glm::dvec2 at_m{0.0};
  double turn_deg = 0.0, scale = 1.0;
  From from = From::value;
  double at_height_m = 0.0, pitch_deg = 0.0, roll_deg = 0.0;  // of a hull (VolumeInput)
};

// A picture laid on the sea, its top to -z where it is not turned. value = offset + scale texel.
struct TextureInput {
  std::string file;
  std::shared_ptr<const ImageF> image;
  glm::dvec2 at_m{0.0}, size_m{100.0};
  double turn_deg = 0.0;  // a flow's vectors turn with it
  double scale = 1.0, offset = 0.0;
  std::string channels;  // a letter of r, g, b, a for each of the value's channels; "" takes the first ones
};

// What a moving thing leaves behind it: discs that fade away evenly over their life.
struct TrailKey {
  double time_s = 0.0;
  glm::dvec2 at_m{0.0};
};
struct TrailInput {
  std::vector<TrailKey> keys;
  double radius_m = 2.0, life_s = 10.0;
  double spread_mps = 0.0;  // by which a disc's radius grows
  bool loop = false;        // from the last key on to the first, which are at one place
};

struct InputSpec {
  InputTarget to = InputTarget::level;
  double weight = 1.0;
  InputBlend blend = InputBlend::add;
  int order = 0;           // lower ones first; those alike as they come
  double feather_m = 0.0;  // width of the soft edge, which lies inside of the shape
  bool follow_waves =
      false;  // it goes to and fro with the waves that pass under it, as foam does; else it stays in its place
  glm::vec4 value{0.0f};  // as many channels as the target has; a factor, with InputBlend::scale, is in the first
  std::variant<SplineInput, AreaInput, VortexInput, ShapeInput, TextureInput, TrailInput, VolumeInput> shape =
      AreaInput{};
  std::string where;  // what messages call it: "scene.json:12: inputs[3]"
};
// In the order of the variant, and those of VolumeInput of Form.
inline constexpr std::array<std::string_view, 11> input_kinds{
    "spline", "ellipse", "rectangle", "vortex", "shape", "texture", "trail", "sphere", "box", "capsule", "cylinder"};

// Whether it takes water away where that stands within a body, and not from above (ClipVolumes). Its blend is
// `replace`: of those at a place the last one holds.
bool is_volume(const InputSpec& spec);

// Channels of the value that the input itself gives: one where it is a factor, or a speed along a spline.
int value_channels(const InputSpec& spec);

// Throws Error, at `where`, naming the key, its value, its range and what to do: what is no number, out of range or
// does not go together; a file that was not read.
void validate(const InputSpec& spec);

}  // namespace seascape
