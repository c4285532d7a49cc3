// Any bytes as a model: an Error or a model whose parts agree with themselves, nothing else.
#include <cstdlib>

#include "engine/error.h"
#include "engine/gltf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const seascape::Model model = seascape::load_gltf_from_memory({data, size}, "input");
    for (const seascape::MeshPart& part : model.parts) {
      if (part.normals.size() != part.positions.size()) std::abort();
      if (!part.uvs.empty() && part.uvs.size() != part.positions.size()) std::abort();
      if (part.indices.size() % 3 != 0) std::abort();
      for (const std::uint32_t index : part.indices)
        if (index >= part.positions.size()) std::abort();
    }
  } catch (const seascape::Error&) {
  }
  return 0;
}
