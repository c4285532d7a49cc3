#include "engine/disk_cache.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "engine/error.h"
#include "engine/files.h"

namespace seascape {

namespace {

// Before the bytes of each file.
struct Head {
  char magic[8] = {'s', 'e', 'a', 'm', 'a', 'd', 'e', '1'};
  std::uint64_t bytes = 0, hash = 0;  // of what follows, begun with the file's name
};

std::uint64_t hash_of(const std::string& name, std::span<const std::uint8_t> bytes) {
  const std::span letters(reinterpret_cast<const std::uint8_t*>(name.data()), name.size());
  return hash_bytes(bytes, hash_bytes(letters));
}

// Removes the files that were written first, until the rest are no more than so many bytes.
void trim(const std::filesystem::path& folder, std::uintmax_t most_bytes) {
  struct File {
    std::filesystem::file_time_type time;
    std::filesystem::path path;
    std::uintmax_t bytes;
  };
  std::vector<File> files;
  std::uintmax_t all = 0;
  std::error_code failed;
  for (std::filesystem::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    std::error_code gone;  // another process trims too
    const File file{at->last_write_time(gone), at->path(), at->file_size(gone)};
    if (gone) continue;
    all += file.bytes;
    files.push_back(file);
  }
  if (all <= most_bytes) return;
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.time < b.time; });
  for (const File& file : files) {
    if (all <= most_bytes) break;
    std::filesystem::remove(file.path, failed);
    all -= file.bytes;
  }
}

}  // namespace

DiskCache::DiskCache(std::filesystem::path folder, std::uintmax_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {}

DiskCache DiskCache::of_user() {
  const auto says = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value ? value : "");
  };
  if (says("SEASCAPE_CACHE") == "off") return {};
  if (const std::filesystem::path home = says("XDG_CACHE_HOME"); home.is_absolute())
    return DiskCache(home / "seascape" / "made");
  if (const std::filesystem::path home = says("HOME"); home.is_absolute())
    return DiskCache(home / ".cache" / "seascape" / "made");
  return {};
}

std::optional<std::vector<std::uint8_t>> DiskCache::read(const std::string& name) const {
  std::error_code failed;
  if (folder_.empty() || !std::filesystem::is_regular_file(folder_ / name, failed)) return std::nullopt;
  try {
    std::vector<std::uint8_t> bytes = read_bytes(folder_ / name);
    Head head;
    const Head ours;
    if (bytes.size() < sizeof head) return std::nullopt;
    std::memcpy(&head, bytes.data(), sizeof head);
    bytes.erase(bytes.begin(), bytes.begin() + sizeof head);
    if (std::memcmp(head.magic, ours.magic, sizeof head.magic) != 0 || head.bytes != bytes.size() ||
        head.hash != hash_of(name, bytes))
      return std::nullopt;
    return bytes;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void DiskCache::write(const std::string& name, std::span<const std::uint8_t> bytes) const {
  std::error_code failed;
  if (folder_.empty()) return;
  std::filesystem::create_directories(folder_, failed);
  if (failed) return;
  Head head;
  head.bytes = bytes.size();
  head.hash = hash_of(name, bytes);
  std::vector<std::uint8_t> file(sizeof head + bytes.size());
  std::memcpy(file.data(), &head, sizeof head);
  std::copy(bytes.begin(), bytes.end(), file.begin() + sizeof head);
  try {
    write_atomically(folder_ / name, std::span<const std::uint8_t>(file));
    trim(folder_, most_bytes_);
  } catch (const Error&) {
    // A full disk, or a folder of someone else: it is made anew next time.
  }
}

}  // namespace seascape
