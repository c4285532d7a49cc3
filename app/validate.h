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

// The kind follows from the name: .gltf and .glb models, .png and .exr images; .json is a path where it has "keys", an
// input script where it has "events" without "effects", else a scene. Another name is a fault. All faults of .json are
// told, of a model or an image the first.
FileVerdict validate_file(const std::filesystem::path& file);

}  // namespace seascape
