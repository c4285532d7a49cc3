// A desktop for tests: a virtual display of its own, programs that run beside the test, keys and mouse.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace seascape::test {

// Until `holds` does, or the patience is at its end; returns whether it held.
bool wait_until(const std::function<bool()>& holds, double patience_s = 30.0);

// A program that runs beside the test and is ended with this object.
class Background {
 public:
  // The first word is looked up in PATH. Its descriptor 3 is the file `three`. Throws when there is no such program.
  Background(const std::vector<std::string>& words, const std::vector<std::string>& environment = {});
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  std::string out() const;
  std::string err() const;
  std::string three() const;
  bool running();
  pid_t id() const { return child_; }
  void send(int signal);
  // The exit status, 128 + the signal where one ended it, -1 while it still runs after `patience_s`.
  int exit_code(double patience_s = 30.0);

 private:
  TemporaryFolder folder_;
  pid_t child_ = 0;
  int exit_code_ = -1;
  bool over_ = false;
};

// Xvfb, on a display number that is free.
class VirtualDisplay {
 public:
  VirtualDisplay();  // throws when Xvfb does not start: it is among the packages that ./check installs
  const std::string& name() const { return name_; }  // ":7"
  std::string variable() const { return "DISPLAY=" + name_; }
  // Runs xdotool to its end and returns what it printed.
  std::string xdotool(const std::vector<std::string>& words) const;

 private:
  Background server_;
  std::string name_;
};

}  // namespace seascape::test
