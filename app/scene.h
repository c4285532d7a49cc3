// A scene file: which effects the sea has, and the settings that differ from their defaults.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/faults.h"
#include "app/scene_objects.h"
#include "app/scene_shapes.h"
#include "app/settings.h"
#include "engine/view.h"
#include "ocean/inputs/clip_body.h"

namespace seascape {

struct Scene {
  std::string name;  // the file's stem
  std::filesystem::path file;
  std::string title;
  std::vector<std::string> effects{"waves"};
  Settings settings;                 // defaults, then the preset, then the scene's own values
  std::vector<InputSpec> inputs;     // in the file's order
  SceneObjects objects;              // likewise
  SceneShapes shapes;                // likewise: pockets of air and portals
  ClipRoom clip_room;                // for bodies of actors, where clip is called for: no file says it yet
  bool actors_foam = false;          // whether actors make foam: likewise
  bool actors_press = false;         // whether actors press the water, where dynamic waves are called for: likewise
  std::vector<std::string> remarks;  // what gives nothing and why, a line each; no faults
  Pose start;                        // where explore begins
};

// Reads a scene. `name_or_file` is a path, or the name of one in content/scenes. The preset (a name of quality.h) is
// applied before the scene's own values. Throws Error with file and line, key, value, range and remedy; unknown keys
// are errors.
Scene load_scene(const std::string& name_or_file, std::string_view preset);

// The same from text; `where` is what messages call the file. With `faults` it collects instead of throwing.
Scene parse_scene(std::string_view text, const std::string& where, std::string_view preset);
Scene parse_scene(std::string_view text, const std::string& where, std::string_view preset, Faults& faults);

// Sets a value of the command line's `option`; what gives nothing, for the scene lacks its effect, becomes a remark.
// Throws Error with exit code 2.
void set_over_file(Scene& scene, const std::string& option, std::string_view key, std::string_view value);

// content/ of this checkout or installation; SEASCAPE_CONTENT names another.
std::filesystem::path content_directory();

// The names of what is in content/KIND ("scenes", "paths", "inputs"), sorted; none where the folder cannot be read.
std::vector<std::string> content_names(std::string_view kind);

// The file of a name in content/KIND; whatever has a slash or ends in .json is a file
// already.
std::filesystem::path content_file(const std::string& name_or_file, std::string_view kind);

}  // namespace seascape
