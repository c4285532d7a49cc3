#include "app/located_pose.h"

#include <cmath>
#include <vector>

#include "app/camera_path.h"
#include "engine/text.h"

namespace seascape {

namespace {

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

}  // namespace

Pose read_pose(ObjectReader& reader, const LocatedJson& json, const std::string& where, Faults& faults) {
  Pose pose;
  if (const LocatedJson* position = reader.required("position_m", "\"position_m\": [x, y, z]"))
    faults.attempt([&] { pose.position_m = position_of(*position, reader.key_name("position_m"), where); });
  const LocatedJson* orientation = reader.optional("orientation");
  ViewAngles angles;
  angles.yaw_deg = reader.number("yaw_deg", -360.0, 360.0, 0.0, "deg");
  angles.pitch_deg = reader.number("pitch_deg", -90.0, 90.0, 0.0, "deg");
  angles.roll_deg = reader.number("roll_deg", -180.0, 180.0, 0.0, "deg");
  pose.orientation = orientation_from_angles(angles);
  if (orientation == nullptr) return pose;
  for (const char* angle : {"yaw_deg", "pitch_deg", "roll_deg"})
    if (const LocatedJson* found = json.member(angle))
      faults.attempt([&] {
        throw Error(reader.place(*found),
                    reader.key_name(angle) + " and " + reader.key_name("orientation") + " are both given",
                    "keep one of the two");
      });
  faults.attempt([&] { pose.orientation = read_orientation(*orientation, reader.key_name("orientation"), where); });
  return pose;
}

std::string pose_text(const Pose& pose) {
  const glm::dvec3& p = pose.position_m;
  const glm::dquat& q = pose.orientation;
  return "\"position_m\": [" + text_from(p.x) + ", " + text_from(p.y) + ", " + text_from(p.z) +
         "], \"orientation\": [" + text_from(q.x) + ", " + text_from(q.y) + ", " + text_from(q.z) + ", " +
         text_from(q.w) + "]";
}

}  // namespace seascape
