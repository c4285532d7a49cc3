// Checks files of every kind the program reads and tells all their faults.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/error.h"

namespace seascape {

struct FileVerdict {
  std::string summary;               // "a scene with 2 effects", where it is sound
  std::vector<Error> faults;         // in the file's order; none: it is sound
  std::vector<std::string> remarks;  // what is no fault but surely not meant
};

// The kind follows from the name: .gltf and .glb models, .png and .exr images; .json is a path where it has "keys",
// else a scene. Another name is a fault. A scene's and a path's faults are all told, a model's or an image's first.
FileVerdict validate_file(const std::filesystem::path& file);

}  // namespace seascape
