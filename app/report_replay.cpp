#include "app/report_replay.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/files.h"

namespace seascape {

namespace {

using nlohmann::ordered_json;

ordered_json pose_json(const Pose& pose) {
  return {{"position_m", {pose.position_m.x, pose.position_m.y, pose.position_m.z}},
          {"orientation_xyzw", {pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w}}};
}

ordered_json body_json(const ReplayedBody& body) {
  ordered_json json = {{"name", body.name}};
  json.update(pose_json(body.pose));
  json["velocity_mps"] = {body.velocity_mps.x, body.velocity_mps.y, body.velocity_mps.z};
  return json;
}

ordered_json acted_json(const ReplayedInput& acted) {
  ordered_json values = ordered_json::object(), pressed = ordered_json::array();
  for (const ActionRow& row : action_rows())
    if (const double value = acted.values[std::size_t(row.action)]; value != 0.0) values[std::string(row.name)] = value;
  for (const Press& press : acted.pressed)
    pressed.push_back({{"action", row_of(press.action).name}, {"value", press.value}});
  const auto hand = [](const std::optional<Pose>& pose) { return pose ? pose_json(*pose) : ordered_json(); };
  return {{"values", std::move(values)},
          {"pressed", std::move(pressed)},
          {"left", hand(acted.hands[0])},
          {"right", hand(acted.hands[1])}};
}

ordered_json frame_json(const ReplayFrame& frame) {
  ordered_json eyes = ordered_json::array();
  for (const View& eye : frame.views.eyes) {
    ordered_json view = pose_json(eye.pose);
    view["fov_tangents"] = {
        {"left", eye.fov.left}, {"right", eye.fov.right}, {"up", eye.fov.up}, {"down", eye.fov.down}};
    eyes.push_back(std::move(view));
  }
  ordered_json json = {{"frame", frame.frame},
                       {"time_s", frame.time_s},
                       {"scene_time_s", frame.scene_time_s},
                       {"files", frame.files},
                       {"viewer", pose_json(frame.views.viewer)},
                       {"views", std::move(eyes)},
                       {"counts",
                        {{"draws", frame.draws},
                         {"triangles", frame.triangles},
                         {"dispatches", frame.dispatches},
                         {"patches", frame.patches}}},
                       {"taken", {{"cpu_ms", frame.cpu_ms}, {"gpu_ms", frame.gpu_ms}}}};
  json["bodies"] = ordered_json::array();
  for (const ReplayedBody& body : frame.bodies) json["bodies"].push_back(body_json(body));
  json["events"] = ordered_json::array();
  for (const BodyEvent& event : frame.events)
    json["events"].push_back({{"time_s", event.time_s},
                              {"body", frame.bodies[event.body].name},
                              {"event", name_of(event.kind)},
                              {"strength_mps", event.strength}});
  for (const EyeEvent& event : frame.eye_events)
    json["events"].push_back({{"time_s", event.time_s},
                              {"eye", frame.views.eyes.size() == 1 ? "centre"
                                      : event.eye == 0             ? "left"
                                                                   : "right"},
                              {"event", event.in ? "in" : "out"}});
  json["sea_hash"] = fmt::format("{:016x}", frame.sea_hash);  // no number: many readers have but 53 bits of one
  if (frame.acted) json["actions"] = acted_json(*frame.acted);
  return json;
}

std::string text_of(const ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::string replay_json(const ReplayRecord& record) {
  const ordered_json header = {{"version", 1},
                               {"scene", record.scene},
                               {"path", record.path},
                               {"preset", record.preset},
                               {"seed", record.seed},
                               {"width", record.width},
                               {"height", record.height},
                               {"msaa", record.msaa},
                               {"fps", record.fps},
                               {"stereo", record.stereo},
                               {"debug", record.debug},
                               {"format", record.format},
                               {"device", record.device},
                               {"driver", record.driver},
                               {"build", record.build}};
  std::string text = text_of(header, 2);
  text.resize(text.size() - 2);  // the line end and brace, for the frames follow
  text += ",\n  \"frames\": [";
  for (std::size_t i = 0; i < record.frames.size(); ++i)
    text += (i ? ",\n    " : "\n    ") + text_of(frame_json(record.frames[i]), -1);
  return text + (record.frames.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

void write_replay_record(const std::filesystem::path& file, const ReplayRecord& record) {
  write_atomically(file, replay_json(record));
}

}  // namespace seascape
