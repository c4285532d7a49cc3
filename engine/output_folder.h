// A folder that one run at a time writes its results into.
#pragma once
#include <filesystem>

#include "engine/descriptors.h"

namespace seascape {

// Makes the folder as make_output_directory() does and holds it while this lives, so that the files of two runs do not
// mix; the system lets go of it when a run ends in any way. Folders within it are other folders. Throws Error that
// names who holds it. Where a file system has no locks it holds nothing.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& folder);

 private:
  Descriptor held_;
};

}  // namespace seascape
