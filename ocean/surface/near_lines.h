// Where the drawn surface passes the eyes' near planes: its triangles that do, found on the GPU each frame.
#pragma once
#include <array>
#include <span>

#include "engine/frame.h"
#include "ocean/mesh/surface_selection.h"
#include "ocean/surface/eyes_in.h"
#include "shaders/shared/near_line.h"

namespace seascape {

class NearLines {
 public:
  // Patches that there is room for, and triangles. Of more patches the nearest are taken, which come first in a
  // selection. (Measured: 100 to 160 patches, some thousands in a storm where the eye looks down.)
  static constexpr std::size_t room = 8192, triangle_room = 16384;

  // `values`: of the surface for eyes in the water. `entries`: what the surface's shaders are bound to, of each copy of
  // its images.
  NearLines(Device& device, ShaderLibrary& shaders, const std::vector<SpecValue>& values,
            const std::vector<std::vector<Bound>>& entries);

  // For a pipeline whose vertex shader has near_line.glsl.
  static void lay_out(GraphicsSpec& spec);

  // Chooses the frame's patches, before its passes: those that a near plane may pass. `near`: of each eye, none where
  // no line is looked for.
  void choose(Frame& frame, const SurfaceSelection& selection, std::span<const NearWater> near);
  bool any() const { return patches_ > 0; }
  std::size_t patches() const { return patches_; }  // that were chosen
  // With any(): finds the triangles, in passes of their own. `sea`: the uses of what the surface is drawn from. `copy`:
  // which of its images' copies the frame draws. Other passes that draw() use add_uses().
  void find(Frame& frame, std::uint32_t frame_uniform, const Uses& sea, std::size_t copy);
  void add_uses(Uses& uses) const;
  // With any(), after such a pipeline is bound: draws the triangles' lines.
  void draw(Commands& commands) const;

 private:
  Pipeline corners_pipeline_, lines_pipeline_;
  std::array<Buffer, Frame::slots> patches_of_;  // of each frame in flight: the host writes them
  Buffer found_, listed_, draw_;
  std::array<std::vector<Bindings>, Frame::slots> corners_bindings_;  // of each copy
  Bindings lines_bindings_;
  int slot_ = 0;
  std::size_t patches_ = 0, eyes_ = 0;
};

}  // namespace seascape
