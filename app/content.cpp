#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "app/scene.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"

namespace seascape {

std::filesystem::path content_directory() {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (const char* named = std::getenv("SEASCAPE_CONTENT"); named != nullptr && *named != '\0') {
    if (!fs::is_directory(named, ignored))
      throw Error("SEASCAPE_CONTENT", in_quotes(named, 400) + " is not a folder",
                  "name the folder that holds scenes/ and paths/");
    return named;
  }
  const fs::path source = fs::path(SEASCAPE_SOURCE_DIR) / "content";
  if (fs::is_directory(source, ignored)) return source;
  const fs::path beside = executable_directory() / "content";
  if (fs::is_directory(beside, ignored)) return beside;
  throw Error(beside.string(), "no content folder with scenes and paths", "set SEASCAPE_CONTENT to it");
}

std::vector<std::string> content_names(std::string_view kind) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(content_directory() / kind, ignored))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path content_file(const std::string& name_or_file, std::string_view kind) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const bool is_name = name_or_file.find('/') == std::string::npos && fs::path(name_or_file).extension() != ".json";
  if (!is_name) return name_or_file;
  const fs::path directory = content_directory() / kind;
  const fs::path file = directory / (name_or_file + ".json");
  if (fs::is_regular_file(file, ignored)) return file;
  const std::vector<std::string> stems = content_names(kind);
  const std::vector<std::string_view> names(stems.begin(), stems.end());
  const std::string what = kind == "scenes" ? "scene" : kind == "paths" ? "path" : "input script";
  const std::string stem(kind.substr(0, kind.size() - 1));
  throw Error("", "no " + what + " is called " + in_quotes(name_or_file) + did_you_mean(name_or_file, names),
              "take " + (names.empty() ? std::string() : listed(names) + ", or ") + "a file " + stem +
                  ".json; names are looked up in " + directory.string());
}

}  // namespace seascape
