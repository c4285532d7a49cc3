#include "app/input_files.h"

#include <array>
#include <cmath>

#include "engine/error.h"
#include "engine/srgb.h"
#include "engine/text.h"
#include "ocean/inputs/input_spec.h"

namespace seascape {

namespace {

ImageF floats_of(const Image8& image, bool colours) {
  std::array<float, 256> light;
  for (int i = 0; i < 256; ++i) light[std::size_t(i)] = colours ? float(srgb_to_light(i / 255.0)) : float(i) / 255.0f;
  ImageF result{image.width, image.height, {}};
  const std::size_t texels = std::size_t(image.width) * std::size_t(image.height),
                    channels = std::size_t(image.channels);
  result.pixels.resize(4 * texels, 1.0f);
  for (std::size_t i = 0; i < texels; ++i)
    for (std::size_t c = 0; c < channels; ++c)
      result.pixels[4 * i + c] =
          c == 3 ? float(image.pixels[channels * i + c]) / 255.0f : light[image.pixels[channels * i + c]];
  return result;
}

}  // namespace

std::shared_ptr<const Model> InputFiles::model(const std::string& name) {
  std::shared_ptr<const Model>& found = models_[name];
  if (found == nullptr) found = std::make_shared<Model>(load_gltf(folder_ / name));
  return found;
}

std::shared_ptr<const ImageF> InputFiles::image(const std::string& name, bool colours) {
  std::shared_ptr<const ImageF>& found = images_[{name, colours}];
  if (found != nullptr) return found;
  const std::filesystem::path file = folder_ / name;
  std::string kind = file.extension().string();
  for (char& c : kind) c = c >= 'A' && c <= 'Z' ? char(c + 32) : c;
  if (kind != ".exr" && kind != ".png")
    throw Error(file.string(), "the kind " + in_quotes(kind) + " is no picture's", "give an .exr or a .png");
  ImageF image = kind == ".exr" ? read_exr(file) : floats_of(read_png(file), colours);
  texels_ += std::size_t(image.width) * std::size_t(image.height);
  if (texels_ > most_input_texels)
    throw Error(file.string(), "makes " + std::to_string(texels_) + " pixels of all pictures of inputs together",
                "give smaller ones: at most " + std::to_string(most_input_texels));
  found = std::make_shared<ImageF>(std::move(image));
  return found;
}

}  // namespace seascape
