#include "engine/driver_files.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"

namespace seascape {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 20;

// "" or what is wrong, as the end of "FILE, ...". The format is that of the loader's LoaderDriverInterface.md.
std::string fault_of(const fs::path& file) {
  std::string text;
  try {
    text = read_text(file, most_bytes);
  } catch (const Error& error) {
    return "of which reading says: " + error.fault();
  }
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return "which is not JSON";
  const auto driver = json.is_object() ? json.find("ICD") : json.end();
  const auto library = driver != json.end() && driver->is_object() ? driver->find("library_path") : json.end();
  if (driver == json.end() || !driver->is_object() || library == driver->end() || !library->is_string())
    return "which is no driver's: it has no ICD.library_path";
  std::string name = library->get<std::string>();
  if (name.find('/') != std::string::npos && !name.starts_with('/')) name = (file.parent_path() / name).string();
  void* const opened = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (opened == nullptr) return "whose library cannot be loaded: " + one_line(dlerror(), 300);
  dlclose(opened);
  return "";
}

// A name, or all files of a folder in order.
std::vector<fs::path> files_of(const fs::path& name) {
  std::error_code ignored;
  if (!fs::is_directory(name, ignored)) return {name};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(name, ignored))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string driver_files_fault() {
  const bool old_name = std::getenv("VK_DRIVER_FILES") == nullptr;  // which the loader reads where the new one is unset
  const char* const all = old_name ? "VK_ICD_FILENAMES" : "VK_DRIVER_FILES";  // empty: no driver is looked for
  for (const char* variable : {all, "VK_ADD_DRIVER_FILES"}) {
    const char* value = std::getenv(variable);
    if (value == nullptr) continue;
    std::istringstream names(value);
    bool any = false;
    for (std::string name; std::getline(names, name, ':');)
      for (const fs::path& file : name.empty() ? std::vector<fs::path>() : files_of(name)) {
        any = true;
        if (const std::string fault = fault_of(file); !fault.empty())
          return std::string(variable) + " names " + file.string() + ", " + fault;
      }
    if (!any && variable == all)
      return std::string(variable) +
             " names no driver's file: " + (*value == '\0' ? "it is empty" : in_quotes(value) + " holds none");
  }
  return "";
}

}  // namespace seascape
