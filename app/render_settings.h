// How pictures are drawn, apart from the sea itself. Plain values.
#pragma once
#include <string>

namespace seascape {

// automatic: tile, unless something asks for the light before tone mapping.
enum class FrameShape { tile, desktop, automatic };
// How the sea's pixels are lit: where its triangles are drawn, or once a pixel when all of them are.
enum class Lighting { forward, deferred, automatic };
enum class StereoMode { automatic, single, per_eye };
enum class DebugView { none, holes, lod, wireframe, normals, slices };

struct RenderSettings {
  int msaa = 4;  // samples a pixel: 1, 2, 4 or 8
  FrameShape shape = FrameShape::automatic;
  Lighting lighting = Lighting::automatic;
  bool facing_only = false;
  StereoMode stereo = StereoMode::automatic;
  DebugView debug = DebugView::none;
  double eye_distance_m = 0.064;
  double vertical_fov_deg = 60.0;  // of one-view pictures and of headless stereo
  double near_m = 0.1;
};

}  // namespace seascape
