#include "engine/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"

namespace seascape {

namespace {

namespace fs = std::filesystem;

// The process that holds a lock of flock() on an open folder, by /proc/locks (proc_locks(5)); 0 where it is not told.
long holder_of(int folder) {
  struct stat status {};
  if (fstat(folder, &status) != 0) return 0;
  const std::string inode =
      fmt::format("{:02x}:{:02x}:{}", major(status.st_dev), minor(status.st_dev), std::uint64_t(status.st_ino));
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, type, kind, mode, process, file;
    words >> number >> type >> kind >> mode >> process >> file;
    if (type == "FLOCK" && file == inode) return long(integer_from(process).value_or(0));
  }
  return 0;
}

// "process 4711 (seascape bake --out loops)", as far as it is known.
std::string told(long process) {
  if (process <= 0) return "another process";
  std::ostringstream text;
  text << std::ifstream(fmt::format("/proc/{}/cmdline", process)).rdbuf();
  std::string command = text.str();
  while (!command.empty() && command.back() == '\0') command.pop_back();
  std::replace(command.begin(), command.end(), '\0', ' ');
  return fmt::format("process {}{}", process, command.empty() ? "" : " (" + one_line(command, 200) + ")");
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder) {
  make_output_directory(folder);
  const fs::path name = folder.empty() ? fs::path(".") : folder;
  held_ = Descriptor(open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!held_ || flock(held_.number(), LOCK_EX | LOCK_NB) == 0) return;  // a folder that may not be read is written into
  if (errno == EWOULDBLOCK)
    throw Error(name.string(), told(holder_of(held_.number())) + " writes its results there",
                "wait until it ends, or give another folder");
}

}  // namespace seascape
