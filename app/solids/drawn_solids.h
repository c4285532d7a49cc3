// Solid things on the GPU: their models, the surroundings that they mirror, and the draws of a frame.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "app/solids/model_settings.h"
#include "app/solids/solid_instances.h"
#include "app/solids/solid_pictures.h"
#include "engine/frame.h"
#include "engine/pipeline.h"
#include "ocean/surface/surface.h"

namespace seascape {

struct SolidLook {
  bool tile_shape = false;                // tone mapping in the fragment shader
  const RenderTarget* points = nullptr;   // where the sea is lit later: what its points are drawn into; null: nowhere
  const Image* depths = nullptr;          // of these points
  const RenderTarget* below = nullptr;    // what is under water is drawn into (Surface::below()); null: nothing is
  float anisotropy = 1.0f;                // of the points (SurfaceLook) and of textures
  int most_texels = 4096;                 // of a texture's larger side
  const RenderTarget* sun_map = nullptr;  // what things hide from the sun is drawn into it; null: nothing is hidden
};

class DrawnSolids {
 public:
  // `picture`: what the sea is lit into. The models outlive it; `things`: all that update() may be told of.
  DrawnSolids(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light,
              std::span<const PlacedModel> models, std::span<const SolidThing> things, const SolidLook& look);

  // Other images of the points' depth.
  void resize(const Image* depths);

  // Outside of passes: the surroundings, where sky or water have changed; what is seen of the things now.
  void update(Frame& frame, const Image& sky_map, const glm::vec4& water_reflectance, bool sky_is_new,
              std::span<const SolidThing> things, const Viewpoint& viewpoint, double time_s, double highest_m,
              const ModelSettings& settings);
  // What shaders are told of the things under water, as of the last update.
  void describe(gpu::FrameData& data) const;
  // After update(): who throws shadows now, and where they are in the sun's map, for the frame's shaders.
  void cast(gpu::FrameData& data, std::span<const SolidThing> things, const Viewpoint& viewpoint,
            const ModelSettings& settings, double time_s);
  // The pass into the sun's map, where there are any.
  void draw_sun_map(Frame& frame, std::uint32_t frame_uniform) const;
  void add_uses(Uses& uses) const;
  // Inside the pass that draws the sea (into look.points, where there are any): what hides all that lies behind it.
  void draw(Commands& commands, std::uint32_t frame_uniform) const { draw(commands, frame_uniform, Kind::opaque); }
  // After sea and sky, inside the pass into the picture: what lets light through, far things first.
  void draw_blended(Commands& commands, std::uint32_t frame_uniform) const {
    draw(commands, frame_uniform, Kind::blended);
  }
  // Inside a pass into look.below, where any_in_water().
  void draw_in_water(Commands& commands, std::uint32_t frame_uniform) const {
    draw(commands, frame_uniform, Kind::in_water);
  }
  bool any_in_water() const { return !in_water_.draws.empty(); }

  const SolidSelection& selection() const { return selection_; }
  const SolidSelection& casters() const { return casters_; }

 private:
  struct Mesh {  // a primitive
    Buffer vertices, indices;
    std::uint32_t count = 0;
    std::size_t material = 0;
  };
  struct Material {
    std::array<const Image*, gpu::solid_textures> textures;
    std::array<VkSampler, gpu::solid_textures> samplers;
    bool blends = false, double_sided = false;
    Bindings bindings, blended, in_water, casting;
  };
  struct Drawn {
    std::vector<Image> textures;
    std::vector<Material> materials;
    std::vector<std::vector<Mesh>> meshes;  // of each mesh its primitives
    Buffer material_data;
  };
  void make_caster_pipeline();
  void make_room(std::span<const SolidThing> things);
  void make_model(const SolidModel& model);
  // By picture and TexelKind; null: not read so.
  std::vector<std::array<const Image*, 3>> make_textures(const SolidModel& model, Drawn& drawn);
  void make_pipelines(const RenderTarget& picture);
  void bind(Drawn& drawn);
  VkSampler sampler(const SolidTexture& texture);
  enum class Kind { opaque, blended, in_water };
  void draw(Commands& commands, std::uint32_t frame_uniform, Kind kind) const;
  void upload(const SolidSelection& selection, const std::array<Buffer, Frame::slots>& room) const;

  Device& device_;
  ShaderLibrary& shaders_;
  std::span<const PlacedModel> models_;
  SurfaceLight light_;
  SolidLook look_;
  Image sky_, albedo_, white_, flat_;
  Owned<VkSampler> sky_sampler_, depth_sampler_;
  std::vector<std::pair<int, Owned<VkSampler>>> samplers_;  // by how they wrap and filter
  Pipeline sky_pipeline_, albedo_pipeline_, pipeline_, blended_pipeline_, in_water_pipeline_, caster_pipeline_;
  Bindings sky_bindings_, albedo_bindings_;
  std::vector<Drawn> drawn_;
  bool lit_ = false;
  glm::vec4 lit_by_{0.0f};
  SolidSelection selection_, in_water_, casters_;
  gpu::SolidsInWater told_of_water_{};
  std::array<Buffer, Frame::slots> instances_, in_water_instances_, caster_instances_;  // room for all things at once
  int slot_ = 0;
};

}  // namespace seascape
