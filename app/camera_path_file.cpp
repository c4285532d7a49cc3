#include <cmath>
#include <optional>

#include "app/camera_path.h"
#include "app/located_json.h"
#include "app/scene.h"
#include "engine/files.h"
#include "engine/text.h"

namespace seascape {

namespace {

constexpr std::size_t most_keys = 100'000;

glm::dquat read_orientation(const LocatedJson& json, const std::string& name, const std::string& where) {
  const std::vector<double> q = numbers_of(json, name, 4, -1.001, 1.001, "", where);
  const glm::dquat orientation(q[3], q[0], q[1], q[2]);
  const double length = glm::length(orientation);
  if (std::abs(length - 1.0) > 1e-3)
    throw Error(where + ":" + std::to_string(json.line), name + ": its length is " + text_from(length) + ", not 1",
                "give a unit quaternion [x, y, z, w]");
  // A quaternion of unit length to rounding is kept as it is, so that a saved path reads back to the bit.
  return std::abs(length - 1.0) < 1e-12 ? orientation : orientation / length;
}

PathKey read_key(const LocatedJson& json, const std::string& name, const std::string& where, Faults& faults) {
  ObjectReader reader(json, name, where, faults);
  PathKey key;
  key.time_s = reader.required_number("time_s", 0.0, 1e9, "s");
  if (const LocatedJson* position = reader.required("position_m", "\"position_m\": [x, y, z]"))
    faults.attempt([&] { key.pose.position_m = position_of(*position, name + ".position_m", where); });
  key.scene_time_s = reader.number("scene_time_s", -1e9, 1e9, key.time_s, "s");
  const LocatedJson* orientation = reader.optional("orientation");
  ViewAngles angles;
  angles.yaw_deg = reader.number("yaw_deg", -360.0, 360.0, 0.0, "deg");
  angles.pitch_deg = reader.number("pitch_deg", -90.0, 90.0, 0.0, "deg");
  angles.roll_deg = reader.number("roll_deg", -180.0, 180.0, 0.0, "deg");
  key.pose.orientation = orientation_from_angles(angles);
  if (orientation != nullptr) {
    for (const char* angle : {"yaw_deg", "pitch_deg", "roll_deg"})
      if (const LocatedJson* found = json.member(angle))
        faults.attempt([&] {
          throw Error(reader.place(*found),
                      reader.key_name(angle) + " and " + reader.key_name("orientation") + " are both given",
                      "keep one of the two");
        });
    faults.attempt([&] { key.pose.orientation = read_orientation(*orientation, name + ".orientation", where); });
  }
  reader.finish();
  return key;
}

void read_path(CameraPath& path, const LocatedJson& json, const std::string& where, Faults& faults) {
  ObjectReader file(json, "", where, faults);
  file.version();
  file.text("title", "");
  const LocatedJson* keys = file.required("keys", "\"keys\": [{\"time_s\": 0, \"position_m\": [0, 1.7, 0]}, ...]");
  file.finish();
  if (keys == nullptr) return;
  if (!keys->is(LocatedJson::Kind::array) || keys->items.empty() || keys->items.size() > most_keys)
    throw Error(file.place(*keys), "keys: " + described(*keys), "give a list of 1 to 100000 keys");
  std::optional<double> last_s;  // that was read well: a faulty time is one fault, and not of the next key too
  for (const LocatedJson& entry : keys->items) {
    const std::string name = "keys[" + std::to_string(path.keys.size()) + "]";
    const PathKey key = read_key(entry, name, where, faults);
    path.keys.push_back(key);
    const LocatedJson* time = entry.member("time_s");
    if (time == nullptr || !time->is(LocatedJson::Kind::number) || time->number != key.time_s) continue;
    faults.attempt([&] {
      if (last_s && !(key.time_s > *last_s))
        throw Error(file.place(entry),
                    name + ".time_s: " + text_from(key.time_s) + " does not come after " + text_from(*last_s) +
                        " of the key before",
                    "order the keys by rising time_s");
    });
    last_s = key.time_s;
  }
}

}  // namespace

CameraPath parse_camera_path(std::string_view text, const std::string& where, Faults& faults) {
  CameraPath path;
  faults.attempt([&] { read_path(path, parse_located_json(text, where), where, faults); });
  return path;
}

CameraPath parse_camera_path(std::string_view text, const std::string& where) {
  Faults thrown;
  return parse_camera_path(text, where, thrown);
}

CameraPath load_camera_path(const std::string& name_or_file) {
  const std::filesystem::path file = content_file(name_or_file, "paths");
  CameraPath path = parse_camera_path(read_text(file, largest_json_bytes), file.string());
  path.name = file.stem().string();
  return path;
}

std::string camera_path_text(const CameraPath& path) {
  std::string text = "{\n  \"version\": 1,\n  \"keys\": [";
  for (std::size_t i = 0; i < path.keys.size(); ++i) {
    const PathKey& key = path.keys[i];
    const glm::dvec3& p = key.pose.position_m;
    const glm::dquat& q = key.pose.orientation;
    text += i == 0 ? "\n" : ",\n";
    text += "    {\"time_s\": " + text_from(key.time_s) + ", \"position_m\": [" + text_from(p.x) + ", " +
            text_from(p.y) + ", " + text_from(p.z) + "], \"orientation\": [" + text_from(q.x) + ", " + text_from(q.y) +
            ", " + text_from(q.z) + ", " + text_from(q.w) + "]";
    if (key.scene_time_s != key.time_s) text += ", \"scene_time_s\": " + text_from(key.scene_time_s);
    text += "}";
  }
  return text + "\n  ]\n}\n";
}

void save_camera_path(const CameraPath& path, const std::filesystem::path& file) {
  write_atomically(file, camera_path_text(path));
}

}  // namespace seascape
