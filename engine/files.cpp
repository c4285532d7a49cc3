#include "engine/files.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "engine/error.h"

#if defined(_WIN32)
#include <process.h>
#include <windows.h>
#else
#include <fcntl.h>
#include <unistd.h>
#endif

namespace seascape {

namespace fs = std::filesystem;

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

struct Advice {
  std::string what, remedy;
};

// Words for the faults that users meet; the system's own sentence for the rest.
Advice advice_for(int code, bool writing) {
  switch (code) {
    case ENOENT:
      return writing ? Advice{"its folder does not exist", "make the folder first, or name another file"}
                     : Advice{"there is no such file", "check the name and the folder"};
    case ENOTDIR:
      return {"a part of its path is a file, not a folder", "check the path"};
    case EISDIR:
      return {"is a folder, not a file", "name a file"};
    case EACCES:
    case EPERM:
      return {writing ? "no permission to write" : "no permission to read",
              writing ? "choose a folder that you may write to, or change its permissions" : "change its permissions"};
    case EROFS:
      return {"its file system is read-only", "choose another folder"};
    case ENOSPC:
      return {"the disk is full", "free some space or choose another disk"};
#ifdef EDQUOT
    case EDQUOT:
      return {"your disk quota is used up", "free some space or choose another disk"};
#endif
    case EFBIG:
      return {"the file would be larger than this system allows", "raise the limit (ulimit -f) or write less"};
    case EMFILE:
    case ENFILE:
      return {"too many files are open", "close some programs, or raise the limit (ulimit -n)"};
    case ENAMETOOLONG:
      return {"its name is too long", "choose a shorter name"};
    case ELOOP:
      return {"its symbolic links go round in a circle", "name the file itself"};
    default:
      return {fmt::format("{} failed: {}", writing ? "writing" : "reading", std::generic_category().message(code)),
              "check the disk and the path"};
  }
}

[[noreturn]] void fail(const fs::path& file, int code, bool writing) {
  Advice advice = advice_for(code, writing);
  throw Error(file.string(), std::move(advice.what), std::move(advice.remedy));
}

// `Bytes` is a string or a vector of bytes. Reads in steps, so that a size that lies (/proc, a growing file) harms
// nothing.
template <class Bytes>
Bytes read_whole(const fs::path& file, std::size_t most_bytes) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) fail(file, EISDIR, false);
  const File in(std::fopen(file.string().c_str(), "rb"));
  if (!in) fail(file, errno, false);
  const auto too_large = [&] {
    throw Error(file.string(), fmt::format("is larger than {} MiB", most_bytes >> 20), "use a smaller file");
  };
  Bytes bytes;
  const std::uintmax_t stated = fs::is_regular_file(file, ignored) ? fs::file_size(file, ignored) : 0;
  if (!ignored && stated != static_cast<std::uintmax_t>(-1)) {
    if (stated > most_bytes) too_large();
    bytes.reserve(static_cast<std::size_t>(stated));
  }
  std::vector<char> block(std::size_t{1} << 16);
  for (;;) {
    const std::size_t got = std::fread(block.data(), 1, block.size(), in.get());
    if (bytes.size() + got > most_bytes) too_large();
    bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(got));
    if (got < block.size()) break;
  }
  if (std::ferror(in.get())) fail(file, errno, false);
  return bytes;
}

long process_number() {
#if defined(_WIN32)
  return _getpid();
#else
  return static_cast<long>(getpid());
#endif
}

fs::path temporary_name(const fs::path& file) {
  static std::atomic<unsigned> counter{0};  // two threads may write the same file at once
  fs::path name = file;
  name += fmt::format(".tmp-{}-{}", process_number(), counter.fetch_add(1));
  return name;
}

// Writes and closes. Returns 0 or the errno of the first fault.
int write_whole(std::FILE* out, std::string_view bytes) {
  errno = 0;
  const bool all = bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
  const bool complete = all && std::fflush(out) == 0;
  int code = complete ? 0 : (errno != 0 ? errno : EIO);
  errno = 0;
  if (std::fclose(out) != 0 && code == 0) code = errno != 0 ? errno : EIO;
  return code;
}

}  // namespace

std::string read_text(const fs::path& file, std::size_t most_bytes) {
  return read_whole<std::string>(file, most_bytes);
}

std::vector<std::uint8_t> read_bytes(const fs::path& file, std::size_t most_bytes) {
  return read_whole<std::vector<std::uint8_t>>(file, most_bytes);
}

std::vector<std::uint32_t> read_spirv(const fs::path& file) {
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  constexpr std::size_t header_bytes = 20;  // SPIR-V 1.x, section 2.3: five words
  constexpr std::uint32_t magic = 0x07230203;
  std::vector<std::uint32_t> words(bytes.size() / 4);
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * 4);
  if (bytes.size() < header_bytes || bytes.size() % 4 != 0 || words[0] != magic)
    throw Error(file.string(), "is not a SPIR-V module", "build the shaders again (cmake --build)");
  return words;
}

void write_atomically(const fs::path& file, std::string_view bytes) {
  std::error_code fault;
  const fs::file_status status = fs::status(file, fault);
  if (status.type() == fs::file_type::directory) fail(file, EISDIR, true);
  if (fs::exists(status) && status.type() != fs::file_type::regular) {  // a device or a pipe: nothing to rename over
    std::FILE* out = std::fopen(file.string().c_str(), "wb");
    if (!out) fail(file, errno, true);
    if (const int code = write_whole(out, bytes)) fail(file, code, true);
    return;
  }
  fs::path target = file;
  if (fs::is_symlink(fs::symlink_status(file, fault))) {
    target = fs::canonical(file, fault);
    if (fault) fail(file, fault.value(), true);
  }
#if !defined(_WIN32)
  // A rename needs no right on the old file itself; a file that its owner protected is still refused.
  if (fs::exists(status) && faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail(file, errno, true);
#endif
  const fs::path temporary = temporary_name(target);
  std::FILE* out = std::fopen(temporary.string().c_str(), "wbx");
  if (!out) fail(file, errno, true);
  if (const int code = write_whole(out, bytes)) {
    fs::remove(temporary, fault);
    fail(file, code, true);
  }
  if (fs::exists(status)) fs::permissions(temporary, status.permissions(), fault);
  fs::rename(temporary, target, fault);
  if (fault) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    fail(file, fault.value(), true);
  }
}

void write_atomically(const fs::path& file, std::span<const std::uint8_t> bytes) {
  write_atomically(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void make_output_directory(const fs::path& directory) {
  const fs::path folder = directory.empty() ? fs::path(".") : directory;
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (!fs::is_directory(folder)) {
    if (!fault || fault.value() == EEXIST || fault.value() == ENOTDIR)
      throw Error(folder.string(), "is a file, or lies below one", "name a folder");
    fail(folder, fault.value(), true);
  }
  const fs::path probe = temporary_name(folder / "probe");
  std::FILE* out = std::fopen(probe.string().c_str(), "wbx");
  if (!out) fail(folder, errno, true);
  const int code = write_whole(out, "x");  // a byte, because a full disk still makes empty files
  fs::remove(probe, fault);
  if (code) fail(folder, code, true);
}

fs::path executable_directory() {
#if defined(_WIN32)
  wchar_t name[32768];
  const DWORD length = GetModuleFileNameW(nullptr, name, 32768);
  return fs::path(std::wstring_view(name, length)).parent_path();
#else
  std::error_code fault;
  const fs::path program = fs::read_symlink("/proc/self/exe", fault);
  if (fault) throw Error("/proc/self/exe", "cannot tell where the program lies", "mount /proc");
  return program.parent_path();
#endif
}

}  // namespace seascape
