#include "app/scene_inputs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "app/input_files.h"
#include "engine/text.h"
#include "ocean/effects.h"
#include "ocean/inputs/hull_check.h"

namespace seascape {

namespace {

using Kind = LocatedJson::Kind;

constexpr std::array<std::string_view, 4> shape_values{"value", "height", "material", "hull"};
constexpr auto target_names = [] {
  std::array<std::string_view, input_targets.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = input_targets[i].name;
  return names;
}();

// One input, its reader, and what it takes to read it.
class Reader {
 public:
  Reader(const LocatedJson& json, const std::string& name, const std::string& where, InputFiles& files, Faults& faults)
      : json_(json), where_(where), files_(files), faults_(faults), reader_(json, name, where, faults) {
    spec.where = where + ":" + std::to_string(json.line) + ": " + name;
  }

  InputSpec spec;

  // False where the rest cannot be understood.
  bool read(std::span<const EffectEntry> effects) {
    if (!json_.is(Kind::object)) return false;
    const std::optional<std::size_t> to = required_choice("to", target_names),
                                     kind = required_choice("kind", input_kinds);
    if (!to || !kind) return false;
    spec.to = InputTarget(*to);
    faults_.attempt([&] {
      if (std::none_of(effects.begin(), effects.end(),
                       [&](const EffectEntry& effect) { return effect.name == target_names[*to]; }))
        throw Error(reader_.place(*json_.member("to")),
                    reader_.key_name("to") + ": the scene does not name the effect " + in_quotes(target_names[*to]),
                    "add \"" + std::string(target_names[*to]) + "\" to \"effects\"");
    });
    spec.weight = number("weight", input_share_range, 1.0, "");
    spec.blend = InputBlend(choice("blend", input_blends, 0));
    spec.order = whole("order", input_order_range);
    spec.follow_waves = flag("follow_waves");
    switch (*kind) {
      case 0:
        spline();
        break;
      case 1:
      case 2:
        area(*kind == 1);
        break;
      case 3:
        vortex();
        break;
      case 4:
        shape();
        break;
      case 5:
        texture();
        break;
      case 6:
        trail();
        break;
      default:
        volume(VolumeInput::Form(*kind - 7));
        break;
    }
    if (is_volume(spec) && json_.member("blend") == nullptr) spec.blend = InputBlend::replace;
    const VortexInput* whirlpool = std::get_if<VortexInput>(&spec.shape);
    spec.feather_m =
        number("feather_m", input_feather_range, whirlpool != nullptr ? 0.5 * whirlpool->reach_m : 0.0, "m");
    reader_.finish();
    return true;
  }

 private:
  void spline() {
    SplineInput spline;
    const double width = number("width_m", input_size_range, 10.0, "m");
    spline.closed = flag("closed"), spline.filled = flag("filled");
    const LocatedJson* value = reader_.optional("value");
    if (value != nullptr) spec.value = value_of(*value, reader_.key_name("value"));
    bool told = false;  // once, however many points have none
    each("points", "[[x, z], [x, z]]", [&](const LocatedJson& json, const std::string& name) {
      SplinePoint point{{}, width, spec.value};
      const LocatedJson *at = &json, *own = nullptr;
      if (json.is(Kind::object)) {
        ObjectReader reader(json, name, where_, faults_);
        at = reader.required("at_m", "\"at_m\": [x, z]");
        point.width_m = reader.number("width_m", input_size_range.least, input_size_range.most, width, "m");
        own = reader.optional("value");
        reader.finish();
      }
      if (at == nullptr) return;
      point.at_m = pair_of(*at, at == &json ? name : name + ".at_m", input_place_range, "m");
      if (own != nullptr) point.value = value_of(*own, name + ".value");
      if (own == nullptr && value == nullptr && !std::exchange(told, true)) missing_value();
      spline.points.push_back(point);
    });
    spec.shape = std::move(spline);
  }
  void area(bool round) {
    AreaInput area{.round = round};
    area.at_m = place(true), area.size_m = size(), area.turn_deg = number("turn_deg", input_angle_range, 0.0, "deg");
    value();
    spec.shape = area;
  }
  void vortex() {
    VortexInput vortex;
    vortex.at_m = place(true);
    vortex.core_m = number("core_m", input_size_range, vortex.core_m, "m");
    vortex.reach_m = number("reach_m", {vortex.core_m, input_size_range.most}, 10.0 * vortex.core_m, "m");
    vortex.swirl_mps = number("swirl_mps", {-100.0, 100.0}, vortex.swirl_mps, "m/s");
    vortex.inflow_mps = number("inflow_mps", {-100.0, 100.0}, vortex.inflow_mps, "m/s");
    spec.shape = vortex;
  }
  void shape() {
    ShapeInput shape;
    shape.file = file(".glb");
    shape.at_m = place(false), shape.turn_deg = number("turn_deg", input_angle_range, 0.0, "deg"),
    shape.scale = number("scale", input_model_range, 1.0, "");
    shape.from = ShapeInput::From(choice("from", shape_values, 0));
    if (shape.from == ShapeInput::From::value) value();
    if (shape.from == ShapeInput::From::hull) {
      shape.at_height_m = number("at_height_m", input_height_range, 0.0, "m");
      shape.pitch_deg = number("pitch_deg", input_angle_range, 0.0, "deg"),
      shape.roll_deg = number("roll_deg", input_angle_range, 0.0, "deg");
      volume_value();
    }
    if (shape.from == ShapeInput::From::height)
      if (const LocatedJson* json = reader_.optional("value")) spec.value = value_of(*json, reader_.key_name("value"));
    if (!shape.file.empty()) attempt_file([&] { shape.model = files_.model(shape.file); });
    spec.shape = std::move(shape);
  }
  void texture() {
    TextureInput texture;
    texture.file = file(".exr");
    texture.at_m = place(true), texture.size_m = size(),
    texture.turn_deg = number("turn_deg", input_angle_range, 0.0, "deg");
    texture.scale = number("scale", input_map_range, 1.0, ""),
    texture.offset = number("offset", input_map_range, 0.0, "");
    texture.channels = reader_.text("channels", "");
    if (!texture.file.empty())
      attempt_file([&] { texture.image = files_.image(texture.file, spec.to == InputTarget::albedo); });
    spec.shape = std::move(texture);
  }
  void trail() {
    TrailInput trail;
    trail.radius_m = number("radius_m", input_size_range, trail.radius_m, "m");
    trail.life_s = number("life_s", input_life_range, trail.life_s, "s");
    trail.spread_mps = number("spread_mps", {0.0, 100.0}, 0.0, "m/s");
    trail.loop = flag("loop");
    value();
    each("keys", "[{\"time_s\": 0, \"at_m\": [x, z]}]", [&](const LocatedJson& json, const std::string& name) {
      ObjectReader reader(json, name, where_, faults_);
      TrailKey key;
      key.time_s = reader.required_number("time_s", input_time_range.least, input_time_range.most, "s");
      if (const LocatedJson* at = reader.required("at_m", "\"at_m\": [x, z]"))
        key.at_m = pair_of(*at, name + ".at_m", input_place_range, "m");
      reader.finish();
      trail.keys.push_back(key);
    });
    spec.shape = std::move(trail);
  }

  void volume(VolumeInput::Form form) {
    using Form = VolumeInput::Form;
    VolumeInput volume{.form = form};
    if (const LocatedJson* json = reader_.required("at_m", "\"at_m\": [x, height, z]"))
      volume.at_m =
          triple_of(*json, "at_m", {input_place_range, input_height_range, input_place_range}, "[x, height, z]");
    volume.turn_deg = number("turn_deg", input_angle_range, 0.0, "deg");
    volume.pitch_deg = number("pitch_deg", input_angle_range, 0.0, "deg"),
    volume.roll_deg = number("roll_deg", input_angle_range, 0.0, "deg");
    if (form == Form::box) {
      if (const LocatedJson* json = reader_.required("size_m", "\"size_m\": [x, height, z]"))
        volume.size_m =
            triple_of(*json, "size_m", {input_size_range, input_size_range, input_size_range}, "[x, height, z]");
      volume.round_m = number("round_m", input_feather_range, 0.0, "m");
    } else {
      volume.radius_m = reader_.required_number("radius_m", input_size_range.least, input_size_range.most, "m");
    }
    if (form == Form::capsule || form == Form::cylinder)
      volume.length_m = reader_.required_number("length_m", input_size_range.least, 4.0 * input_size_range.most, "m");
    volume_value();
    spec.shape = volume;
  }
  // 1 where it is not given: it takes the water away.
  void volume_value() {
    spec.value.x = 1.0f;
    if (const LocatedJson* json = reader_.optional("value")) spec.value = value_of(*json, reader_.key_name("value"));
  }

  // ---- values
  double number(std::string_view key, InputRange range, double fallback, std::string_view unit) {
    return reader_.number(key, range.least, range.most, fallback, unit);
  }
  int whole(std::string_view key, InputRange range) {
    const double value = number(key, range, 0.0, "");
    faults_.attempt([&] {
      if (value != std::floor(value))
        throw Error(reader_.place(*json_.member(key)),
                    reader_.key_name(key) + ": " + text_from(value) + " is not a whole number", "give a whole number");
    });
    return int(value);
  }
  bool flag(std::string_view key) {
    const LocatedJson* found = reader_.optional(key);
    if (found == nullptr) return false;
    faults_.attempt([&] {
      if (!found->is(Kind::flag))
        throw Error(reader_.place(*found),
                    reader_.key_name(key) + ": " + described(*found) + " is neither true nor false",
                    "give true or false");
    });
    return found->flag;
  }
  std::optional<std::size_t> chosen(const LocatedJson& json, std::string_view key,
                                    std::span<const std::string_view> names) {
    std::optional<std::size_t> number;
    faults_.attempt([&] {
      const auto found = json.is(Kind::text) ? std::find(names.begin(), names.end(), json.text) : names.end();
      if (found == names.end())
        throw Error(reader_.place(json),
                    reader_.key_name(key) + ": " + described(json) + " is not known" + did_you_mean(json.text, names),
                    "take " + listed(names));
      number = std::size_t(found - names.begin());
    });
    return number;
  }
  std::size_t choice(std::string_view key, std::span<const std::string_view> names, std::size_t fallback) {
    const LocatedJson* found = reader_.optional(key);
    return found == nullptr ? fallback : chosen(*found, key, names).value_or(fallback);
  }
  std::optional<std::size_t> required_choice(std::string_view key, std::span<const std::string_view> names) {
    const LocatedJson* found = reader_.required(key, "\"" + std::string(key) + "\": " + listed(names));
    return found == nullptr ? std::nullopt : chosen(*found, key, names);
  }
  glm::dvec2 pair_of(const LocatedJson& json, const std::string& name, InputRange range, std::string_view unit) {
    glm::dvec2 result{0.0};
    faults_.attempt([&] {
      if (!json.is(Kind::array) || json.items.size() != 2)
        throw Error(reader_.place(json), name + ": " + described(json) + " is not a list of 2 numbers", "write [x, z]");
      for (int i = 0; i < 2; ++i)
        result[i] = number_of(json.items[std::size_t(i)], name + "[" + std::to_string(i) + "]", range.least, range.most,
                              unit, where_);
    });
    return result;
  }
  glm::dvec3 triple_of(const LocatedJson& json, std::string_view key, const std::array<InputRange, 3>& ranges,
                       std::string_view as) {
    const std::string name = reader_.key_name(key);
    glm::dvec3 result{1.0};
    faults_.attempt([&] {
      if (!json.is(Kind::array) || json.items.size() != 3)
        throw Error(reader_.place(json), name + ": " + described(json) + " is not a list of 3 numbers",
                    "write " + std::string(as));
      for (int i = 0; i < 3; ++i)
        result[i] = number_of(json.items[std::size_t(i)], name + "[" + std::to_string(i) + "]",
                              ranges[std::size_t(i)].least, ranges[std::size_t(i)].most, "m", where_);
    });
    return result;
  }
  glm::dvec2 place(bool required) {
    const LocatedJson* json = required ? reader_.required("at_m", "\"at_m\": [x, z]") : reader_.optional("at_m");
    return json == nullptr ? glm::dvec2(0.0) : pair_of(*json, reader_.key_name("at_m"), input_place_range, "m");
  }
  // One number for both sides, or two.
  glm::dvec2 size() {
    glm::dvec2 result{10.0};
    const LocatedJson* json = reader_.required("size_m", "\"size_m\": [x, z]");
    if (json == nullptr) return result;
    if (!json->is(Kind::number)) return pair_of(*json, reader_.key_name("size_m"), input_size_range, "m");
    faults_.attempt([&] {
      result = glm::dvec2(
          number_of(*json, reader_.key_name("size_m"), input_size_range.least, input_size_range.most, "m", where_));
    });
    return result;
  }
  glm::vec4 value_of(const LocatedJson& json, const std::string& name) {
    const InputTargetTraits& target = traits(spec.to);
    const bool factor = spec.blend == InputBlend::scale;
    const std::size_t channels = std::size_t(value_channels());
    const InputRange range = factor ? input_factor_range : InputRange{target.least, target.most};
    const std::string_view unit = factor ? std::string_view() : target.unit;
    glm::vec4 result{0.0f};
    faults_.attempt([&] {
      if (channels == 1) {
        result.x = float(number_of(json, name, range.least, range.most, unit, where_));
        return;
      }
      if (!json.is(Kind::array) || json.items.size() != channels)
        throw Error(reader_.place(json),
                    name + ": " + described(json) + " is not a list of " + std::to_string(channels) + " numbers",
                    "give " + std::string(target.name) + " as many: " + std::string(target.means));
      for (std::size_t c = 0; c < channels; ++c)
        result[int(c)] = float(
            number_of(json.items[c], name + "[" + std::to_string(c) + "]", range.least, range.most, unit, where_));
    });
    return result;
  }
  int value_channels() const {
    InputSpec probe;
    probe.to = spec.to, probe.blend = spec.blend;
    if (json_.member("kind")->text == input_kinds[0]) probe.shape = SplineInput{};
    return seascape::value_channels(probe);
  }
  void value() {
    if (const LocatedJson* json = reader_.optional("value")) {
      spec.value = value_of(*json, reader_.key_name("value"));
    } else {
      faults_.attempt([&] { missing_value(); });
    }
  }
  [[noreturn]] void missing_value() const {
    throw Error(reader_.place(json_), "the key " + in_quotes(reader_.key_name("value")) + " is missing",
                "add \"value\": " + std::string(traits(spec.to).means));
  }
  std::string file(const char* kind) {
    const LocatedJson* json = reader_.required("file", std::string("\"file\": \"name") + kind + "\"");
    if (json == nullptr) return "";
    faults_.attempt([&] {
      if (!json->is(Kind::text) || json->text.empty() || json->text.find('\0') != std::string::npos)
        throw Error(reader_.place(*json), reader_.key_name("file") + ": " + described(*json) + " is no file's name",
                    std::string("write \"name") + kind + "\"");
    });
    return json->is(Kind::text) && json->text.find('\0') == std::string::npos ? json->text : "";
  }
  // A fault of a file is told at the line that names it, too.
  template <class Work>
  void attempt_file(const Work& work) {
    faults_.attempt([&] {
      try {
        work();
      } catch (const Error& error) {
        throw Error(reader_.place(*json_.member("file")),
                    reader_.key_name("file") + ": " + error.where() + ": " + error.fault(), error.remedy());
      }
    });
  }
  // Each of a list that has to be there; a fault in one is that one's alone.
  template <class Work>
  void each(std::string_view key, std::string_view example, const Work& work) {
    const LocatedJson* list = reader_.required(key, "\"" + std::string(key) + "\": " + std::string(example));
    if (list == nullptr) return;
    const std::string name = reader_.key_name(key);
    faults_.attempt([&] {
      if (!list->is(Kind::array))
        throw Error(reader_.place(*list), name + ": " + described(*list) + " is not a list",
                    "write \"" + std::string(key) + "\": " + std::string(example));
      if (list->items.size() > most_input_points)
        throw Error(reader_.place(*list), name + ": " + described(*list),
                    "give at most " + std::to_string(most_input_points));
      for (std::size_t i = 0; i < list->items.size(); ++i)
        faults_.attempt([&] { work(list->items[i], name + "[" + std::to_string(i) + "]"); });
    });
  }

  const LocatedJson& json_;
  const std::string& where_;
  InputFiles& files_;
  Faults& faults_;
  ObjectReader reader_;
};

}  // namespace

std::vector<InputSpec> read_inputs(const LocatedJson& list, const std::vector<std::string>& effects,
                                   const std::string& where, Faults& faults) {
  std::vector<InputSpec> specs;
  faults.attempt([&] {
    const std::string place = where + ":" + std::to_string(list.line);
    if (!list.is(Kind::array))
      throw Error(place, "inputs: " + described(list) + " is not a list",
                  "write \"inputs\": [{\"to\": \"level\", ...}]");
    if (list.items.size() > most_inputs)
      throw Error(place, "inputs: " + described(list), "give at most " + std::to_string(most_inputs));
    const std::vector<EffectEntry> called = closure(effects);
    InputFiles files(where);
    std::set<const Model*> closed;  // each is gone through once
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      const std::size_t before = faults.list().size();
      faults.attempt([&] {
        Reader reader(list.items[i], "inputs[" + std::to_string(i) + "]", where, files, faults);
        if (!reader.read(called) || faults.list().size() > before) return;
        validate(reader.spec);  // what does not go together
        const ShapeInput* shape = std::get_if<ShapeInput>(&reader.spec.shape);
        if (shape != nullptr && shape->from == ShapeInput::From::hull && closed.insert(shape->model.get()).second)
          validate_hull(reader.spec);
        specs.push_back(std::move(reader.spec));
      });
    }
  });
  return specs;
}

}  // namespace seascape
