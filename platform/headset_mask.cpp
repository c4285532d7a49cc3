#include "platform/headset_mask.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>

namespace seascape {

namespace {

constexpr std::uint32_t most_triangles = 4096;  // an eye's; those of headsets have some hundreds
constexpr float farthest = 60.0f;               // tangent of 89 degrees, and a little more

Error fault(const std::string& what) { return {"xrGetVisibilityMaskKHR", what, "update the headset's runtime"}; }

float cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }

// Whether a triangle, of either winding, covers what lies straight ahead, which every eye sees.
bool hides_ahead(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  const float ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  return (ab > 0.0f && bc > 0.0f && ca > 0.0f) || (ab < 0.0f && bc < 0.0f && ca < 0.0f);
}

void append_box(std::vector<glm::vec2>& corners, const glm::vec2& least, const glm::vec2& most) {
  const glm::vec2 a(most.x, least.y), b(least.x, most.y);
  corners.insert(corners.end(), {least, a, b, b, a, most});
}

void ask_once(const HeadsetSystem& system, XrSession session, std::uint32_t eye, XrVisibilityMaskKHR& mask) {
  const XrResult result = system.api().GetVisibilityMaskKHR(session, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, eye,
                                                            XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, &mask);
  check_xr(result, "xrGetVisibilityMaskKHR");
}

}  // namespace

bool HeadsetMask::offered() const {
  return system_.uses(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME) && system_.api().GetVisibilityMaskKHR != nullptr;
}

std::vector<glm::vec2> HeadsetMask::corners_of(XrSession session, std::uint32_t eye) const {
  XrVisibilityMaskKHR mask{XR_TYPE_VISIBILITY_MASK_KHR};
  ask_once(system_, session, eye, mask);
  const std::uint32_t vertex_count = mask.vertexCountOutput, index_count = mask.indexCountOutput;
  if (vertex_count == 0 && index_count == 0) return {};  // all of it is seen
  if (vertex_count > 3 * most_triangles || index_count > 3 * most_triangles || index_count % 3 != 0)
    throw fault(fmt::format("eye {} has {} corners and {} indices", eye, vertex_count, index_count));
  std::vector<XrVector2f> vertices(vertex_count);
  std::vector<std::uint32_t> indices(index_count);
  mask.vertexCapacityInput = vertex_count;
  mask.indexCapacityInput = index_count;
  mask.vertices = vertices.data();
  mask.indices = indices.data();
  ask_once(system_, session, eye, mask);
  if (mask.vertexCountOutput != vertex_count || mask.indexCountOutput != index_count)
    throw fault(fmt::format("eye {} has {} corners, then {}", eye, vertex_count, mask.vertexCountOutput));
  std::vector<glm::vec2> corners;
  for (const std::uint32_t index : indices) {
    if (index >= vertex_count) throw fault(fmt::format("eye {} has no corner {}", eye, index));
    const glm::vec2 corner(vertices[index].x, vertices[index].y);
    if (!(std::abs(corner.x) < farthest && std::abs(corner.y) < farthest))  // so that no number fails too
      throw fault(fmt::format("eye {} has a corner at {:.3g}, {:.3g}", eye, corner.x, corner.y));
    corners.push_back(corner);
  }
  for (std::size_t i = 0; i < corners.size(); i += 3)
    if (hides_ahead(corners[i], corners[i + 1], corners[i + 2]))
      throw fault(fmt::format("of eye {} it hides what lies straight ahead", eye));
  return corners;
}

void HeadsetMask::ask(XrSession session) {
  if (!offered()) return;
  for (std::uint32_t eye = 0; eye < 2; ++eye) {
    lenses_[eye].clear();
    try {
      lenses_[eye] = corners_of(session, eye);
    } catch (const HeadsetLost&) {
      throw;
    } catch (const SessionLost&) {
      throw;
    } catch (const Error& error) {
      if (!told_) spdlog::warn("headset: what its lenses hide is drawn too: {}", error.what());
      told_ = true;
    }
  }
  join();
}

void HeadsetMask::show_only(const std::array<Fov, 2>& shown) {
  const auto same = [](const Fov& a, const Fov& b) {
    return a.left == b.left && a.right == b.right && a.up == b.up && a.down == b.down;
  };
  if (shows_part_ && same(shown[0], shown_[0]) && same(shown[1], shown_[1])) return;
  shown_ = shown;
  shows_part_ = true;
  join();
}

void HeadsetMask::join() {
  ++mesh_.version;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    std::vector<glm::vec2>& corners = mesh_.corners[eye];
    corners.assign(lenses_[eye].begin(), lenses_[eye].end());
    if (!shows_part_) continue;
    const Fov& f = shown_[eye];
    const double left = f.left, right = f.right, up = f.up, down = f.down;
    // A picture is less than twice as wide and as high as what it shows.
    const double wide = 2.0 * (right - left), high = 2.0 * (up - down);
    append_box(corners, {left - wide, down - high}, {left, up + high});
    append_box(corners, {right, down - high}, {right + wide, up + high});
    append_box(corners, {left, up}, {right, up + high});
    append_box(corners, {left, down - high}, {right, down});
  }
}

}  // namespace seascape
