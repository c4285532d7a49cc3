#include "tests/support/gpu/waterline.h"

#include <cmath>
#include <limits>

#include "engine/barrier.h"
#include "shaders/shared/slots.h"
#include "tests/support/gpu/solid_shot.h"

namespace seascape::test {

namespace {
// An aspect of the depths of a frame's points, of an eye.
template <class T>
std::vector<T> of_points(SeaShot& shot, int eye, VkImageAspectFlagBits aspect) {
  Device& device = shot.device();
  device.wait_idle();
  const Image& image = *shot.experience().surface().depths();
  const ExperienceOptions& options = shot.experience().options();
  const std::size_t count = std::size_t(options.width) * options.height;
  Buffer staging(device, "points", (count * sizeof(T) + 3) / 4 * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostAccess::read);
  device.run_now([&](VkCommandBuffer commands) {
    BarrierBatch barriers;
    barriers.add(image, Access::transfer_read, false);
    barriers.record(commands);
    VkBufferImageCopy region{};
    region.imageSubresource = {VkImageAspectFlags(aspect), 0, std::uint32_t(eye), 1};
    region.imageExtent = {options.width, options.height, 1};
    vkCmdCopyImageToBuffer(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.get(), 1, &region);
    BarrierBatch after;
    staging.state() = {
        VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, 0, 0, 0};
    after.add(staging, Access::host_read);
    after.record(commands);
  });
  return {staging.mapped<T>(), staging.mapped<T>() + count};
}
}  // namespace

std::vector<bool> wet_pixels(SeaShot& shot, int eye) {
  std::vector<bool> wet;
  for (const std::uint8_t side : of_points<std::uint8_t>(shot, eye, VK_IMAGE_ASPECT_STENCIL_BIT))
    wet.push_back(side < gpu::side_in_air);
  return wet;
}

std::vector<double> distances(SeaShot& shot, int eye) {
  const VkFormat format = shot.experience().surface().depths()->spec().format;
  std::vector<double> ahead;
  if (format != VK_FORMAT_D32_SFLOAT && format != VK_FORMAT_D32_SFLOAT_S8_UINT) return ahead;
  for (const float depth : of_points<float>(shot, eye, VK_IMAGE_ASPECT_DEPTH_BIT))
    ahead.push_back(shot.scene().settings.render.near_m / double(depth));
  return ahead;
}

QueryAnswer drawn_water(SeaShot& shot, const glm::dvec2& at, double time_s) {
  shot.draw(pose({at.x, 2.0, at.y}, 0.0, -80.0), time_s);
  return shot.experience().ocean().waves_held().query(at);
}

namespace {

double to_edge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 way = b - a;
  const double t = glm::clamp(glm::dot(p - a, way) / std::max(glm::dot(way, way), 1e-30), 0.0, 1.0);
  return glm::distance(p, a + t * way);
}

double to_triangle(const glm::dvec3& p, const DrawnMesh::Triangle& t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  bool inside = glm::length(normal) > 0.0;
  for (int n = 0; n < 3 && inside; ++n) inside = glm::dot(glm::cross(t[(n + 1) % 3] - t[n], p - t[n]), normal) >= 0.0;
  if (inside) return std::abs(glm::dot(p - t[0], normal)) / glm::length(normal);
  return std::min({to_edge(p, t[0], t[1]), to_edge(p, t[1], t[2]), to_edge(p, t[2], t[0])});
}

// Height of a triangle over a place, and 1 where its upper face is up there, -1 where it lies upside down, else 0.
std::pair<double, int> stands_over(const glm::dvec3& p, const DrawnMesh::Triangle& t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  if (normal.y == 0.0) return {0.0, 0};
  const double sign = normal.y > 0.0 ? 1.0 : -1.0;
  for (int n = 0; n < 3; ++n) {
    const glm::dvec3 &a = t[n], &b = t[(n + 1) % 3];
    // Of two triangles that share an edge one has what stands on it.
    const double beside = sign * ((b.z - a.z) * (p.x - a.x) - (b.x - a.x) * (p.z - a.z));
    if (beside < 0.0 || (beside == 0.0 && (b.z - a.z > 0.0 || (b.z == a.z && b.x > a.x)))) return {0.0, 0};
  }
  const double height = t[0].y - (normal.x * (p.x - t[0].x) + normal.z * (p.z - t[0].z)) / normal.y;
  return {height, int(sign)};
}

}  // namespace

int NearMesh::sheets_over(const glm::dvec3& at) const {
  int sum = 0;
  for (const DrawnMesh::Triangle& t : triangles_)
    if (const auto [height, up] = stands_over(at, t); up != 0 && height > at.y) sum += up;
  return sum;
}

double NearMesh::over(const glm::dvec3& at) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const DrawnMesh::Triangle& t : triangles_)
    if (const auto [height, up] = stands_over(at, t); up != 0 && std::abs(height - at.y) < std::abs(nearest))
      nearest = height - at.y;
  return nearest;
}

double NearMesh::distance(const glm::dvec3& at) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const DrawnMesh::Triangle& t : triangles_) nearest = std::min(nearest, to_triangle(at, t));
  return nearest;
}

glm::dvec3 on_near_plane(const View& eye, double x, double y, std::uint32_t width, std::uint32_t height,
                         double near_m) {
  const glm::dvec3 ray = pixel_ray(eye, x, y, width, height), ahead = eye.pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
  return eye.pose.position_m + ray * (near_m / glm::dot(ray, ahead));
}

}  // namespace seascape::test
