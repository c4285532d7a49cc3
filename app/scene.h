// A scene file: which effects the sea has, and the settings that differ from their defaults.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/settings.h"
#include "engine/view.h"

namespace seascape {

struct Scene {
  std::string name;                   // the file's stem
  std::filesystem::path file;
  std::string title;
  std::vector<std::string> effects{"waves"};
  Settings settings;                  // defaults, then the preset, then the scene's own values
  Pose start;                         // where explore begins
};

// Reads a scene. `name_or_file` is a path, or the name of one in content/scenes. The preset is applied before the
// scene's own values. Throws Error with file and line, key, value, range and remedy; unknown keys are errors.
Scene load_scene(const std::string& name_or_file, std::string_view preset);

// content/ of this checkout or installation; SEASCAPE_CONTENT names another.
std::filesystem::path content_directory();

}  // namespace seascape
