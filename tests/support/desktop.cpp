#include "tests/support/desktop.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace seascape::test {

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

bool wait_until(const std::function<bool()>& holds, double patience_s) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

Background::Background(const std::vector<std::string>& words, const std::vector<std::string>& environment) {
  std::vector<char*> arguments, variables;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  for (const std::string& one : environment) variables.push_back(const_cast<char*>(one.c_str()));
  for (char** one = environ; *one != nullptr; ++one) variables.push_back(*one);  // the first of two of a name counts
  variables.push_back(nullptr);
  const std::string out = folder_ / "out", err = folder_ / "err", three = folder_ / "three";
  constexpr int create = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), create, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), create, 0600);
  posix_spawn_file_actions_addopen(&actions, 3, three.c_str(), create, 0600);
  const int fault = posix_spawnp(&child_, words[0].c_str(), &actions, nullptr, arguments.data(), variables.data());
  posix_spawn_file_actions_destroy(&actions);
  if (fault != 0) throw std::runtime_error("cannot run " + words[0] + "; ./check installs it");
}

Background::~Background() {
  if (exit_code(0.0) != -1 || over_) return;
  kill(child_, SIGTERM);
  if (exit_code(5.0) == -1) {
    kill(child_, SIGKILL);
    exit_code(5.0);
  }
}

std::string Background::out() const { return text_of(folder_ / "out"); }
std::string Background::err() const { return text_of(folder_ / "err"); }
std::string Background::three() const { return text_of(folder_ / "three"); }

bool Background::running() {
  if (over_) return false;
  int status = 0;
  if (waitpid(child_, &status, WNOHANG) == 0) return true;
  over_ = true;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return false;
}

void Background::send(int signal) { kill(child_, signal); }

int Background::exit_code(double patience_s) {
  wait_until([this] { return !running(); }, patience_s);
  return exit_code_;
}

// A server that began anew with each last client's going would turn away a program that comes just then.
VirtualDisplay::VirtualDisplay()
    : server_({"Xvfb", "-screen", "0", "1280x800x24", "-noreset", "-nolisten", "tcp", "-displayfd", "3"}) {
  const auto told = [this] { return server_.three().find('\n') != std::string::npos || !server_.running(); };
  if (!wait_until(told) || !server_.running()) throw std::runtime_error("Xvfb does not start: " + server_.err());
  const std::string number = server_.three();
  name_ = ":" + number.substr(0, number.find('\n'));
}

std::string VirtualDisplay::xdotool(const std::vector<std::string>& words) const {
  std::vector<std::string> all{"xdotool"};
  all.insert(all.end(), words.begin(), words.end());
  Background tool(all, {variable()});
  tool.exit_code();
  return tool.out();
}

}  // namespace seascape::test
