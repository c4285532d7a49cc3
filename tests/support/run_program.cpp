#include "tests/support/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace seascape::test {

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

std::string program_file() { return SEASCAPE_BUILD_DIR "/seascape"; }

ProgramResult run_program(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                          const std::string& out_file) {
  std::vector<std::string> command{program_file()};
  command.insert(command.end(), words.begin(), words.end());
  return run_command(command, environment, out_file);
}

ProgramResult run_command(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                          const std::string& out_file) {
  const std::string& program = command.front();
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::vector<char*> variables;
  for (const std::string& one : environment) variables.push_back(const_cast<char*>(one.c_str()));
  for (char** one = environ; *one != nullptr; ++one) variables.push_back(*one);  // the first of two of a name counts
  variables.push_back(nullptr);

  const TemporaryFolder folder;
  const std::string out = out_file.empty() ? (folder / "out").string() : out_file, err = folder / "err";
  constexpr int create = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), create, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), create, 0600);
  pid_t child = 0;
  const int fault = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), variables.data());
  posix_spawn_file_actions_destroy(&actions);
  if (fault != 0) throw std::runtime_error("cannot run " + program);
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("lost the program");
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (out_file.empty()) result.out = text_of(out);
  result.err = text_of(err);
  return result;
}

}  // namespace seascape::test
