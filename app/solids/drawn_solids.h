// Solid things as they are drawn into one picture: their pipelines, and the draws of a frame.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "app/solids/loaded_models.h"
#include "app/solids/model_settings.h"
#include "app/solids/solid_instances.h"
#include "app/solids/solid_surroundings.h"
#include "app/solids/sun_map.h"
#include "engine/frame.h"
#include "engine/pipeline.h"
#include "ocean/surface/surface.h"

namespace seascape {

struct SolidLook {
  bool tile_shape = false;               // tone mapping in the fragment shader
  const RenderTarget* points = nullptr;  // where the sea is lit later: what its points are drawn into; null: nowhere
  const Image* depths = nullptr;         // of these points
  const RenderTarget* below = nullptr;   // what is under water is drawn into (Surface::below()); null: nothing is
  const RenderTarget* above = nullptr;   // likewise what stands above it (Surface::above())
  float anisotropy = 1.0f;               // of the points (SurfaceLook) and of textures
  bool underwater = false;               // eyes may be in the water (SurfaceLook)
  ShapesInWater shapes = {};             // likewise
  const SunMap* sun_map = nullptr;       // what things hide from the sun is drawn into it; null: by someone else
};

// What is drawn: all of it outlives who draws it.
struct SolidSources {
  std::span<const PlacedModel> models;
  std::span<const SolidThing> things;
  const std::size_t* drawn = nullptr;  // how many of the things are; null: all
  const LoadedModels* loaded = nullptr;
  const SolidSurroundings* around = nullptr;
};

class DrawnSolids {
 public:
  // `picture`: what the sea is lit into.
  DrawnSolids(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light,
              const SolidSources& sources, const SolidLook& look);

  // Other images of the points' depth.
  void resize(const Image* depths);

  // Outside of passes: what is seen of the things now.
  void update(Frame& frame, const Viewpoint& viewpoint, double time_s, const NearWaterSight& water,
              const ModelSettings& settings);
  // What shaders are told of the things seen through the water's surface, as of the last update.
  void describe(gpu::FrameData& data) const;
  // After update(): who throws shadows now, and where they are in the sun's map, for the frame's shaders.
  void cast(gpu::FrameData& data, const Viewpoint& viewpoint, const ModelSettings& settings, double time_s);
  // The same of the last cast() for another viewer.
  void describe_sun(gpu::FrameData& data, const glm::dvec3& viewer_m) const;
  // The pass into the sun's map, where there are any.
  void draw_sun_map(Frame& frame, std::uint32_t frame_uniform) const;
  void add_uses(Uses& uses) const;
  // Inside the pass that draws the sea (into look.points, where there are any): what hides all that lies behind it.
  void draw(Commands& commands, std::uint32_t frame_uniform, EyesIn eyes) const {
    draw(commands, frame_uniform, false, eyes);
  }
  // After sea and sky, inside the pass into the picture: what lets light through, far things first.
  void draw_blended(Commands& commands, std::uint32_t frame_uniform, EyesIn eyes) const {
    draw(commands, frame_uniform, true, eyes);
  }
  // The passes into look.below and look.above, each where there is anything: for the surface to refract.
  void draw_for_refraction(Frame& frame, const Uses& uses, std::uint32_t frame_uniform) const;
  bool any_in_water() const { return !in_water_.draws.empty(); }
  bool any_above() const { return nearest_above_m_ > 0.0; }

  const SolidSelection& selection() const { return selection_; }
  const SolidSelection& casters() const { return casters_; }

 private:
  struct Bound {                // of a material
    Bindings shown;             // opaque or blended, as the material is
    Bindings shown_underwater;  // the same for eyes in the water
    Bindings in_water, above, casting;
  };
  std::span<const SolidThing> things() const {
    return from_.drawn != nullptr ? from_.things.first(*from_.drawn) : from_.things;
  }
  void make_caster_pipeline();
  void make_room(std::span<const SolidThing> things);
  void make_pipelines(const RenderTarget& picture);
  void bind(std::size_t model);
  VkSampler sampler(const SolidTexture& texture);
  // Near the surface once for the pixels whose eye is in air, and once for the others.
  void draw(Commands& commands, std::uint32_t frame_uniform, bool blended, EyesIn eyes) const;
  using Room = std::array<Buffer, Frame::slots>;  // for instances
  struct How {
    const SolidSelection& selection;
    const Room& instances;
    bool blended = false;
    enum class Through { any, air, water } through = Through::any;  // by which draws are chosen
  };
  void draw(Commands& commands, std::uint32_t frame_uniform, const Pipeline& pipeline, Bindings Bound::*bindings,
            const How& how) const;
  void upload(const SolidSelection& selection, const Room& room) const;

  Device& device_;
  ShaderLibrary& shaders_;
  SolidSources from_;
  SurfaceLight light_;
  SolidLook look_;
  Owned<VkSampler> depth_sampler_;
  std::vector<std::pair<int, Owned<VkSampler>>> samplers_;  // by how they wrap and filter
  Pipeline pipeline_, blended_pipeline_, in_water_pipeline_, above_pipeline_, caster_pipeline_;
  // With look.underwater: of the pixels near the surface whose eye is in air, and of those whose eye is in the water.
  struct BySide {
    Pipeline opaque, blended;
  } air_side_, water_side_;
  std::vector<std::vector<Bound>> bound_;  // of each model its materials
  SunView sun_;
  SolidSelection selection_, in_water_, above_, casters_;
  double nearest_above_m_ = 0.0;
  gpu::SolidsThroughWater told_of_water_{};
  Room instances_, in_water_instances_, above_instances_, caster_instances_;  // for all things at once
  int slot_ = 0;
};

}  // namespace seascape
