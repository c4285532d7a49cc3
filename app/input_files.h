// The models and pictures that inputs name, each read once however many inputs take it.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "engine/gltf.h"
#include "engine/image_file.h"

namespace seascape {

class InputFiles {
 public:
  // `scene`: the file that relative names are beside.
  explicit InputFiles(const std::filesystem::path& scene) : folder_(scene.parent_path()) {}

  // Throws Error as load_gltf() does.
  std::shared_ptr<const Model> model(const std::string& name);
  // EXR as it is; PNG from 0 to 1, with `colours` as linear light, else as its bytes stand. Throws Error as the readers
  // do, for another kind of file, and for more than most_input_texels in all pictures together.
  std::shared_ptr<const ImageF> image(const std::string& name, bool colours);

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::shared_ptr<const Model>> models_;
  std::map<std::pair<std::string, bool>, std::shared_ptr<const ImageF>> images_;
  std::size_t texels_ = 0;
};

}  // namespace seascape
