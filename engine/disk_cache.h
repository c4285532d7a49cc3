// What a start keeps on disk for the next ones.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seascape {

// A folder of files by name. What is damaged, cut short or no file of ours counts as absent, so that it is made again
// and replaced. No function throws: what cannot be kept is made anew each time.
class DiskCache {
 public:
  // Keeps nothing.
  DiskCache() = default;
  // The folder is made with the first file. Over `most_bytes` the files that were written first go.
  explicit DiskCache(std::filesystem::path folder, std::uintmax_t most_bytes = std::uintmax_t{128} << 20);
  // seascape/made in $XDG_CACHE_HOME, or in ~/.cache (XDG base directory specification 0.8: a relative path is
  // ignored). Keeps nothing where there is neither, or with SEASCAPE_CACHE=off.
  static DiskCache of_user();

  // Empty where nothing is kept.
  const std::filesystem::path& folder() const { return folder_; }
  std::optional<std::vector<std::uint8_t>> read(const std::string& name) const;
  void write(const std::string& name, std::span<const std::uint8_t> bytes) const;

 private:
  std::filesystem::path folder_;
  std::uintmax_t most_bytes_ = 0;
};

// FNV-1a of 64 bits over 32-bit words (Fowler, Noll and Vo 1991), going on from `from`.
inline constexpr std::uint64_t hash_start = 14695981039346656037ull;
inline std::uint64_t hash_words(std::span<const std::uint32_t> words, std::uint64_t from = hash_start) {
  for (const std::uint32_t word : words) from = (from ^ word) * 1099511628211ull;
  return from;
}
inline std::uint64_t hash_bytes(std::span<const std::uint8_t> bytes, std::uint64_t from = hash_start) {
  for (const std::uint8_t byte : bytes) from = (from ^ byte) * 1099511628211ull;
  return from;
}

}  // namespace seascape
