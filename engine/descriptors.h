// Opening what is no plain file: descriptors of this process (/dev/stdout), pipes and terminals, which may make one
// wait.
#pragma once
#include <filesystem>
#include <optional>
#include <utility>

namespace seascape {

// An open file of the system, closed at its end.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  explicit operator bool() const { return number_ >= 0; }
  int number() const { return number_; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

// Whether the name leads, by links, to a descriptor of a process (/dev/stdout, /dev/fd/3, /proc/PID/fd/1). What is
// behind it may be a file, which must not be replaced: its descriptor is written to.
bool leads_to_descriptor(const std::filesystem::path& file);

// Open for reading, or an empty one with errno. A pipe is opened whether or not somebody writes to it yet, and its
// reads give EAGAIN while nothing is there (InputWait).
Descriptor open_to_read(const std::filesystem::path& file);

// A descriptor, pipe or device, open for writing at its end; an empty one with errno. Waits for a pipe's reader, and
// tells after a second that it does.
Descriptor open_to_write(const std::filesystem::path& file);

// Waits for what is to be read of a pipe, terminal or device, and tells once, after a second, what it waits for.
class InputWait {
 public:
  InputWait(const std::filesystem::path& file, const Descriptor& input);
  void until_ready();

 private:
  const std::filesystem::path& file_;
  const Descriptor& input_;
  double told_at_s_;
};

}  // namespace seascape
