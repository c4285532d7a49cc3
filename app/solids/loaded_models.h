// What of a scene's models lies on the GPU, whoever draws them and in whichever shape of the frame: corners, pictures
// and materials.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "app/solids/solid_instances.h"
#include "app/solids/solid_pictures.h"

namespace seascape {

// A dynamic offset of a uniform buffer is a multiple of this on every device (Vulkan's required limit).
inline constexpr VkDeviceSize solid_material_stride = 256;

class LoadedModels {
 public:
  struct Primitive {
    Buffer vertices, indices;
    std::uint32_t count = 0;  // of indices
    std::size_t material = 0;
  };
  struct Material {
    std::array<const Image*, gpu::solid_textures> textures;
    std::array<SolidTexture, gpu::solid_textures> looks;  // how they wrap and filter
    bool blends = false, double_sided = false;
  };
  struct Loaded {
    std::vector<Image> textures;
    std::vector<Material> materials;
    std::vector<std::vector<Primitive>> meshes;  // of each mesh its primitives; then of each as mirrored parts show it
    Buffer material_data;                        // SolidMaterialData, solid_material_stride apart
  };

  // `blocks`: pictures lie in blocks where the device has them (DeviceFacts). The models may go afterwards.
  LoadedModels(Device& device, std::span<const PlacedModel> models, bool blocks);
  // Whether they would be as they are.
  bool serves(bool blocks) const { return blocks == asked_for_blocks_; }
  const Loaded& operator[](std::size_t model) const { return loaded_[model]; }
  std::size_t size() const { return loaded_.size(); }

 private:
  void load(Device& device, const SolidModel& model);
  // By picture and TexelKind; null: not read so.
  std::vector<std::array<const Image*, 4>> load_textures(Device& device, const SolidModel& model, Loaded& loaded);
  bool asked_for_blocks_, in_blocks_;
  Image white_, flat_;
  std::vector<Loaded> loaded_;
};

}  // namespace seascape
