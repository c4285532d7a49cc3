// Many viewpoints share one sea: a mirror's camera, a portal, a map. Each draws what it draws alone, in one frame with
// the others.
#include <cmath>

#include "ocean/mesh/quadtree.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;

class Viewpoints : public test::GpuTest {};

constexpr std::uint32_t width = 96, height = 72;

// A viewpoint of the shot's sea, with patches and a picture of its own. Draws the sea alone, without a sky.
struct Camera {
  Camera(SeaShot& shot, const Viewpoint& from, const std::string& name)
      : view(from), patches(shot.scene().settings.lod) {
    TargetSpec spec = shot.experience().picture().spec();
    picture = RenderTarget(shot.device(), name, spec);
  }
  void select(SeaShot& shot) {
    selection = &shot.experience().ocean().select(view, patches, shot.scene().settings.lod);
  }
  void draw(SeaShot& shot, Frame& frame) const {
    Experience& e = shot.experience();
    gpu::FrameData data{};
    const View& eye = view.eyes[0];
    data.view[0].clip_from_relative =
        glm::mat4(projection(eye.fov, 0.1) * eye_from_relative(eye.pose, view.viewer.position_m));
    data.view[0].eye =
        glm::vec4(glm::vec3(eye.pose.position_m - view.viewer.position_m), float((eye.fov.up - eye.fov.down) / height));
    data.sun = glm::vec4(0.0f, 1.0f, 0.0f, 0.99999f);
    e.ocean().describe(data, view, *selection);
    const std::uint32_t uniform = frame.upload_uniform(data);
    Uses uses{use(e.sky().map(), Access::surface_read), use(e.sky().light(), Access::surface_read)};
    e.ocean().add_uses(uses);
    frame.draw_pass("a viewpoint", picture, uses,
                    [&](Commands& c) { e.surface().draw(c, frame, *selection, uniform, EyesIn::air, false); });
  }
  Image8 read(SeaShot& shot) const {
    return {int(width), int(height), 4, read_image(shot.device(), picture.colour(), 0)};
  }

  Viewpoint view;
  Quadtree patches;
  const SurfaceSelection* selection = nullptr;
  RenderTarget picture;
};

Viewpoint looking(const Pose& p, double fov_deg) { return {p, {{p, symmetric_fov(fov_deg, double(width) / height)}}}; }

// The eye above the water, its mirror's camera beside, a portal a hundred kilometres off, and a map from 3 km.
std::vector<Viewpoint> places() {
  return {
      looking(pose({3.0, 4.0, -7.0}, 20.0, -20.0), 60.0), looking(pose({30.0, 2.5, 60.0}, 200.0, -30.0, 180.0), 50.0),
      looking(pose({1e5, 12.0, -3e4}, 110.0, -35.0), 80.0), looking(pose({-500.0, 3000.0, 900.0}, 0.0, -90.0), 40.0)};
}

using Order = std::vector<std::size_t>;
// What the cameras of `order` show: all are selected first, then drawn, in one frame.
std::vector<Image8> together(SeaShot& shot, std::vector<Camera>& cameras, const Order& order, double time_s) {
  Frame& frame = shot.experience().frame();
  frame.begin();
  shot.experience().ocean().update(frame, time_s, {0.0, 3.0, 0.0});
  shot.experience().sky().update(frame, shot.scene().settings.sky);
  for (const std::size_t n : order) cameras[n].select(shot);
  for (const std::size_t n : order) cameras[n].draw(shot, frame);
  frame.submit();
  frame.finish();
  std::vector<Image8> pictures;
  for (const std::size_t n : order) pictures.push_back(cameras[n].read(shot));
  return pictures;
}

// Controls: with one Quadtree for all, as once it was, the last one's patches are drawn for each (seen); another time
// is seen.
TEST_F(Viewpoints, EachDrawsInOneFrameWithTheOthersWhatItDrawsAlone) {
  for (const char* preset : {"low", "high"}) {
    SeaShot shot({.scene = "open_sea",
                  .preset = preset,
                  .width = width,
                  .height = height,
                  .set = {{"waves.resolution", "64"}, {"frame.shape", "tile"}}});
    std::vector<Camera> cameras;
    for (const Viewpoint& view : places()) cameras.emplace_back(shot, view, "camera " + std::to_string(cameras.size()));
    std::vector<Image8> alone;
    for (std::size_t n = 0; n < cameras.size(); ++n) {
      alone.push_back(together(shot, cameras, {n}, 7.0)[0]);
      EXPECT_GT(test::statistics(alone[n]).deviation, 0.5) << n << " shows nothing";
    }
    for (const Order& order : {Order{0, 1, 2, 3}, Order{3, 1, 0, 2}, Order{2, 0}}) {
      const std::vector<Image8> pictures = together(shot, cameras, order, 7.0);
      for (std::size_t n = 0; n < order.size(); ++n)
        EXPECT_EQ(test::differing_pixels(pictures[n], alone[order[n]]), 0)
            << preset << ", " << order[n] << " of " << order.size() << ": "
            << test::leave(pictures[n], "viewpoint_together") << ' ' << test::leave(alone[order[n]], "viewpoint_alone");
    }
    // The frame of the experience's own viewer, between them, takes nothing from them and gives nothing.
    const Pose head = pose({0.0, 3.0, 0.0}, 20.0, -10.0);
    const Image8 own = shot.picture(head, 7.0);
    EXPECT_EQ(test::differing_pixels(together(shot, cameras, {2, 1}, 7.0)[1], alone[1]), 0);
    EXPECT_EQ(test::differing_pixels(shot.picture(head, 7.0), own), 0);
    EXPECT_GT(test::differing_pixels(together(shot, cameras, {1}, 7.5)[0], alone[1]), 100);
  }
}

// Frozen, each keeps its own patches when it goes elsewhere, whoever selects between. Control: thawed, they follow.
TEST_F(Viewpoints, EachFreezesItsOwnPatches) {
  SeaShot shot({.scene = "open_sea",
                .preset = "low",
                .width = width,
                .height = height,
                .set = {{"waves.resolution", "64"}, {"frame.shape", "tile"}}});
  std::vector<Camera> cameras;
  for (const Viewpoint& view : places()) cameras.emplace_back(shot, view, "camera");
  const auto corners = [&](const Camera& camera) {
    std::vector<glm::dvec2> result;
    for (const auto& p : camera.selection->patches)
      result.push_back(camera.selection->grid_origin_m + glm::dvec2(p.corner) * camera.selection->unit_m);
    return result;
  };
  std::vector<std::vector<glm::dvec2>> before;
  for (Camera& camera : cameras) {
    camera.select(shot);
    before.push_back(corners(camera));
  }
  shot.set("debug.freeze", "true");
  for (Camera& camera : cameras) camera.view.viewer.position_m += glm::dvec3(40.0, 1.0, -30.0);
  for (std::size_t n = 0; n < cameras.size(); ++n) {
    cameras[n].select(shot);
    EXPECT_EQ(corners(cameras[n]), before[n]) << n;
  }
  shot.set("debug.freeze", "false");
  cameras[0].select(shot);
  EXPECT_NE(corners(cameras[0]), before[0]);
}

}  // namespace

}  // namespace seascape
