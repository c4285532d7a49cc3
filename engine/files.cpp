#include "engine/files.h"

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/descriptors.h"
#include "engine/error.h"
#include "engine/signals.h"

namespace seascape {

namespace fs = std::filesystem;

namespace {

constexpr int most_links = 40;  // as Linux follows (path_resolution(7))

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
    case EPIPE:
      return {"its reader went before the end", "keep the reader until it has all"};
    case EBADF:
      return {"is not open for writing", "open it so, as in 3> file, or name a file"};
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
  const Descriptor in = open_to_read(file);
  struct stat status {};
  if (!in || fstat(in.number(), &status) != 0) fail(file, errno, false);
  const bool plain = S_ISREG(status.st_mode);
  const auto too_large = [&] {
    throw Error(file.string(), fmt::format("is larger than {} MiB", most_bytes >> 20),
                plain ? "use a smaller file" : "end the input sooner");
  };
  Bytes bytes;
  if (plain) {
    if (std::uintmax_t(status.st_size) > most_bytes) too_large();
    bytes.reserve(static_cast<std::size_t>(status.st_size));
  }
  InputWait wait(file, in);
  std::vector<char> block(std::size_t{1} << 16);
  for (;;) {
    if (!plain) wait.until_ready();
    const ssize_t got = read(in.number(), block.data(), block.size());
    if (got == 0) break;
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (got < 0) fail(file, errno, false);
    if (bytes.size() + std::size_t(got) > most_bytes) too_large();
    bytes.insert(bytes.end(), block.begin(), block.begin() + got);
  }
  return bytes;
}

fs::path temporary_name(const fs::path& file) {
  static std::atomic<unsigned> counter{0};  // two threads may write the same file at once
  const std::string ending = fmt::format(".tmp-{}-{}", long(getpid()), counter.fetch_add(1));
  std::string name = file.filename().string();  // cut, so that it may be as long as a file's may without the ending
  if (name.size() + ending.size() > NAME_MAX) name.resize(NAME_MAX - ending.size());
  return file.parent_path() / (name + ending);
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
  const bool descriptor = leads_to_descriptor(file);
  if (descriptor || (fs::exists(status) && status.type() != fs::file_type::regular)) {  // nothing to rename over
    if (descriptor) std::fflush(stdout);  // what was printed before comes before
    Descriptor opened = open_to_write(file);
    if (!opened && descriptor && (errno == EBADF || errno == ENOENT))
      throw Error(file.string(), "no such descriptor is open", "open it, as in 3> file, or name a file");
    if (!opened) fail(file, errno, true);
    std::FILE* out = fdopen(opened.number(), "wb");
    if (!out) fail(file, errno == EINVAL ? EBADF : errno, true);  // its word for one that is open for reading
    (void)opened.release();
    if (const int code = write_whole(out, bytes)) fail(file, code, true);
    return;
  }
  fs::path target = file;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, fault)); ++links) {  // also one to a file yet to be
    if (links == most_links) fail(file, ELOOP, true);
    const fs::path leads_to = fs::read_symlink(target, fault);
    if (fault) fail(file, fault.value(), true);
    target = target.parent_path() / leads_to;
  }
  // A rename needs no right on the old file itself; a file that its owner protected is still refused.
  if (fs::exists(status) && faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail(file, errno, true);
  const StopLater whole;  // a signal leaves no temporary file
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
  std::error_code fault, ignored;
  fs::create_directories(folder, fault);
  if (!fs::is_directory(folder, ignored)) {
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

fs::path make_numbered_file(const fs::path& folder, const std::string& stem, const std::string& ending) {
  make_output_directory(folder);
  for (int number = 1;; ++number) {
    fs::path file = folder / fmt::format("{}_{:03}{}", stem, number, ending);
    if (std::FILE* made = std::fopen(file.string().c_str(), "wbx")) {
      std::fclose(made);
      return file;
    }
    if (errno != EEXIST) fail(file, errno, true);
  }
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored) && fs::is_regular_file(a, ignored);
}

fs::path executable_directory() {
  std::error_code fault;
  const fs::path program = fs::read_symlink("/proc/self/exe", fault);
  if (fault) throw Error("/proc/self/exe", "cannot tell where the program lies", "mount /proc");
  return program.parent_path();
}

}  // namespace seascape
