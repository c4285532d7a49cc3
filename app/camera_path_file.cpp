#include "app/camera_path.h"

#include <nlohmann/json.hpp>

#include <optional>

#include "app/input_script_file.h"
#include "app/located_json.h"
#include "app/located_pose.h"
#include "app/scene.h"
#include "engine/files.h"
#include "engine/text.h"

namespace seascape {

namespace {

PathKey read_key(const LocatedJson& json, const std::string& name, const std::string& where, Faults& faults) {
  ObjectReader reader(json, name, where, faults);
  PathKey key;
  key.time_s = reader.required_number("time_s", 0.0, 1e9, "s");
  key.scene_time_s = reader.number("scene_time_s", -1e9, 1e9, key.time_s, "s");
  key.pose = read_pose(reader, json, where, faults);
  reader.finish();
  return key;
}

void read_keys(CameraPath& path, const LocatedJson& keys, const std::string& where, Faults& faults) {
  const auto place = [&](const LocatedJson& at) { return where + ":" + std::to_string(at.line); };
  if (!keys.is(LocatedJson::Kind::array) || keys.items.empty() || keys.items.size() > most_path_keys)
    throw Error(place(keys), "keys: " + described(keys), "give a list of 1 to 100000 keys");
  std::optional<double> last_s;  // that was read well: a faulty time is one fault, and not of the next key too
  for (const LocatedJson& entry : keys.items) {
    const std::string name = "keys[" + std::to_string(path.keys.size()) + "]";
    const PathKey key = read_key(entry, name, where, faults);
    path.keys.push_back(key);
    const LocatedJson* time = entry.member("time_s");
    if (time == nullptr || !time->is(LocatedJson::Kind::number) || time->number != key.time_s) continue;
    faults.attempt([&] {
      if (last_s && !(key.time_s > *last_s))
        throw Error(place(entry),
                    name + ".time_s: " + text_from(key.time_s) + " does not come after " + text_from(*last_s) +
                        " of the key before",
                    "order the keys by rising time_s");
    });
    last_s = key.time_s;
  }
}

void read_path(CameraPath& path, const LocatedJson& json, const std::string& where, Faults& faults) {
  ObjectReader file(json, "", where, faults);
  file.version();
  file.text("title", "");
  const LocatedJson* keys = file.required("keys", "\"keys\": [{\"time_s\": 0, \"position_m\": [0, 1.7, 0]}, ...]");
  path.on = file.text("on", "");
  path.horizon_lock = file.number("horizon_lock", 0.0, 1.0, 0.0, "");
  const LocatedJson* actions = file.optional("actions");
  file.finish();
  if (keys != nullptr) faults.attempt([&] { read_keys(path, *keys, where, faults); });
  if (actions != nullptr) path.actions = read_path_actions(*actions, "actions", where, faults);
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

std::string path_key_text(const PathKey& key) {
  std::string text = "{\"time_s\": " + text_from(key.time_s) + ", " + pose_text(key.pose);
  if (key.scene_time_s != key.time_s) text += ", \"scene_time_s\": " + text_from(key.scene_time_s);
  return text + "}";
}

std::string camera_path_text(const CameraPath& path) {
  std::string text = "{\n  \"version\": 1,\n";
  if (!path.on.empty())
    text +=
        "  \"on\": " + nlohmann::json(path.on).dump() + ", \"horizon_lock\": " + text_from(path.horizon_lock) + ",\n";
  text += "  \"keys\": [";
  for (std::size_t i = 0; i < path.keys.size(); ++i)
    text += (i == 0 ? "\n    " : ",\n    ") + path_key_text(path.keys[i]);
  text += "\n  ]";
  if (path.actions) text += ",\n  \"actions\": " + input_script_object(*path.actions, "  ");
  return text + "\n}\n";
}

void save_camera_path(const CameraPath& path, const std::filesystem::path& file) {
  write_atomically(file, camera_path_text(path));
}

}  // namespace seascape
