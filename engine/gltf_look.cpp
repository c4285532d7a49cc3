// Materials, textures and pictures of a glTF document.
#include <fmt/format.h>

#include <cmath>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/gltf_reader.h"
#include "engine/text.h"
#include "engine/tinygltf_library.h"

namespace seascape {

namespace {

constexpr std::size_t most_pixels = std::size_t{1} << 27;  // of all pictures together

const tinygltf::Value* extension(const tinygltf::ExtensionMap& all, const char* name) {
  const auto found = all.find(name);
  return found != all.end() && found->second.IsObject() ? &found->second : nullptr;
}

TextureWrap wrap(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return TextureWrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return TextureWrap::mirrored;
    default:
      return TextureWrap::repeat;
  }
}

Image8 with_alpha(Image8 image) {
  if (image.channels == 4) return image;
  Image8 wide{image.width, image.height, 4, {}};
  wide.pixels.reserve(image.pixels.size() / 3 * 4);
  for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3)
    wide.pixels.insert(wide.pixels.end(), {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2], 255});
  return wide;
}

}  // namespace

float GltfReader::factor(double value, double least, double most, int material, const char* name) const {
  if (!(value >= least && value <= most))
    fail(fmt::format("material {} has a {} of {}; {} to {} is allowed", material, name, value, least, most));
  return static_cast<float>(value);
}

// KHR_texture_transform: uv' = translation * rotation * scale * uv, with the rotation counter-clockwise in uv.
SolidTexture GltfReader::texture(int index, int uv_set, const tinygltf::Value* transform, int material) const {
  SolidTexture made;
  if (index < 0) return made;
  if (static_cast<std::size_t>(index) >= document_.textures.size())
    fail(fmt::format("material {} names texture {}, which does not exist", material, index));
  const tinygltf::Texture& source = document_.textures[static_cast<std::size_t>(index)];
  if (source.source < 0)  // of an extension alone
    fail(fmt::format("texture {} has no picture that is a PNG or JPEG", index));
  if (static_cast<std::size_t>(source.source) >= pictures_)
    fail(fmt::format("texture {} names picture {}, which does not exist", index, source.source));
  made.image = source.source;
  if (source.sampler >= 0) {
    if (static_cast<std::size_t>(source.sampler) >= document_.samplers.size())
      fail(fmt::format("texture {} names sampler {}, which does not exist", index, source.sampler));
    const tinygltf::Sampler& sampler = document_.samplers[static_cast<std::size_t>(source.sampler)];
    made.wrap_u = wrap(sampler.wrapS);
    made.wrap_v = wrap(sampler.wrapT);
    made.linear = sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  made.uv_set = uv_set;
  if (transform != nullptr) {
    const auto pair = [&](const char* name, glm::dvec2 otherwise) {
      const tinygltf::Value& value = transform->Get(name);
      if (!value.IsArray() || value.ArrayLen() != 2) return otherwise;
      for (int c = 0; c < 2; ++c) {
        const tinygltf::Value& number = value.Get(c);
        if (!number.IsNumber() || !std::isfinite(number.GetNumberAsDouble()) ||
            std::abs(number.GetNumberAsDouble()) > 1e6)
          fail(fmt::format("material {} has a texture {} out of range", material, name));
        otherwise[c] = number.GetNumberAsDouble();
      }
      return otherwise;
    };
    const glm::dvec2 scale = pair("scale", glm::dvec2(1.0)), offset = pair("offset", glm::dvec2(0.0));
    const tinygltf::Value& turn = transform->Get("rotation");
    const double angle = turn.IsNumber() ? turn.GetNumberAsDouble() : 0.0;
    if (!std::isfinite(angle)) fail(fmt::format("material {} has a texture rotation out of range", material));
    made.uv_axes = glm::mat2(glm::dmat2(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)) *
                             glm::dmat2(scale.x, 0.0, 0.0, scale.y));
    made.uv_offset = glm::vec2(offset);
    if (transform->Get("texCoord").IsInt()) made.uv_set = transform->Get("texCoord").GetNumberAsInt();
  }
  if (made.uv_set < 0 || made.uv_set > 1)
    fail(fmt::format("material {} asks for texture places {}; 0 and 1 are read", material, made.uv_set));
  return made;
}

SolidMaterial GltfReader::material(int material, bool look) const {
  const tinygltf::Material& source = document_.materials[static_cast<std::size_t>(material)];
  SolidMaterial made;
  made.name = source.name;
  const tinygltf::PbrMetallicRoughness& surface = source.pbrMetallicRoughness;
  if (surface.baseColorFactor.size() == 4)
    for (int c = 0; c < 4; ++c)
      made.base_colour[c] =
          factor(surface.baseColorFactor[static_cast<std::size_t>(c)], 0.0, 1.0, material, "base colour");
  made.metallic = factor(surface.metallicFactor, 0.0, 1.0, material, "metallic factor");
  made.roughness = factor(surface.roughnessFactor, 0.0, 1.0, material, "roughness factor");
  double strength = 1.0;
  if (const auto* emissive = extension(source.extensions, "KHR_materials_emissive_strength");
      emissive && emissive->Get("emissiveStrength").IsNumber())
    strength = emissive->Get("emissiveStrength").GetNumberAsDouble();
  if (source.emissiveFactor.size() == 3)
    for (int c = 0; c < 3; ++c)
      made.emissive[c] =
          factor(source.emissiveFactor[static_cast<std::size_t>(c)], 0.0, 1.0, material, "emissive factor") *
          factor(strength, 0.0, 1e6, material, "emissive strength");
  made.double_sided = source.doubleSided;
  if (!look) return made;
  made.alpha = source.alphaMode == "MASK"    ? AlphaMode::mask
               : source.alphaMode == "BLEND" ? AlphaMode::blend
                                             : AlphaMode::opaque;
  made.alpha_cutoff = factor(source.alphaCutoff, 0.0, 1e6, material, "alpha cutoff");
  made.unlit = source.extensions.contains("KHR_materials_unlit");
  made.normal_scale = factor(source.normalTexture.scale, -100.0, 100.0, material, "normal scale");
  made.occlusion_strength = factor(source.occlusionTexture.strength, 0.0, 1.0, material, "occlusion strength");
  const auto read = [&](const auto& info) {
    return texture(info.index, info.texCoord, extension(info.extensions, "KHR_texture_transform"), material);
  };
  made.base_colour_texture = read(surface.baseColorTexture);
  made.metallic_roughness_texture = read(surface.metallicRoughnessTexture);
  made.normal_texture = read(source.normalTexture);
  made.occlusion_texture = read(source.occlusionTexture);
  made.emissive_texture = read(source.emissiveTexture);
  return made;
}

std::vector<Image8> GltfReader::images(const std::vector<GltfPicture>& pictures,
                                       const std::filesystem::path& folder) const {
  std::vector<Image8> made;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const GltfPicture& source = pictures[i];
    std::string what = fmt::format("{}: picture {}", where_, i);
    std::vector<std::uint8_t> read;
    std::span<const std::uint8_t> bytes;
    if (source.view >= 0) {
      bytes = accessors_.bytes(source.view);
    } else if (tinygltf::IsDataURI(source.uri)) {
      std::string kind;
      if (!tinygltf::DecodeDataURI(&read, kind, source.uri, 0, false))
        fail(fmt::format("picture {} is a broken data: uri", i));
      bytes = read;
    } else {
      what += " " + in_quotes(source.uri);
      read = read_bytes(gltf_file_below(folder, source.uri, where_));
      bytes = read;
    }
    made.push_back(with_alpha(read_picture_from_memory(bytes, what)));
    pixels += static_cast<std::size_t>(made.back().width) * static_cast<std::size_t>(made.back().height);
    if (pixels > most_pixels)
      throw Error(where_, fmt::format("has pictures of over {} M pixels together", most_pixels >> 20),
                  "make them smaller");
  }
  return made;
}

}  // namespace seascape
