// SPIR-V from disk, specialised and stripped for what a scene uses, with the bindings it really has.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/device.h"

namespace seascape {

struct SpecValue {
  std::uint32_t id;
  std::uint32_t value;  // the bits of a bool (0 or 1), int, uint or float
};

struct ShaderBinding {
  std::uint32_t binding = 0;
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
  std::string name;
};

// One module as loaded: nothing of a feature whose constant is false is left in its words.
struct Shader {
  std::string name;  // the file's name, "surface.vert"
  VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
  std::vector<std::uint32_t> words;
  std::vector<ShaderBinding> bindings;  // of descriptor set 0, the only one
  std::uint32_t push_bytes = 0;
  std::vector<SpecValue> values;  // what it was specialised with
  std::uint64_t hash = 0;         // of the words
};

// Any thread. Loads from `shaders/` beside the executable. Equal requests give the same Shader; what it is specialised
// to is kept for later starts.
class ShaderLibrary {
 public:
  explicit ShaderLibrary(std::filesystem::path directory = default_directory(), DiskCache cache = {});
  static std::filesystem::path default_directory();

  // Throws Error when the file is missing or not SPIR-V, or names a specialisation constant it does not have.
  std::shared_ptr<const Shader> load(const std::string& name, std::span<const SpecValue> values);

  // Where a file that was loaded has changed on disk, reads all of them anew, and gives true. Throws Error where one
  // cannot be read; then all stay as they were until a file changes again.
  bool reload();

  // How often the optimiser has run.
  int specialised() const {
    const std::lock_guard lock(*mutex_);
    return specialised_;
  }

 private:
  std::shared_ptr<const Shader> read(const std::string& name, std::span<const SpecValue> values);
  std::vector<std::uint32_t> specialised_words(const std::filesystem::path& file, std::span<const SpecValue> values,
                                               const std::string& name);
  std::filesystem::path directory_;
  DiskCache cache_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
  int specialised_ = 0;
  std::map<std::string, std::shared_ptr<const Shader>> loaded_;
  std::map<std::string, std::filesystem::file_time_type> times_;
};

// Sets the specialisation constants, freezes and folds them, and strips what is dead. Exposed for tests.
std::vector<std::uint32_t> specialise(const std::vector<std::uint32_t>& words, std::span<const SpecValue> values,
                                      const std::string& name);

}  // namespace seascape
