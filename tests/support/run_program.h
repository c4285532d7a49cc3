// Runs the built program as a person does, and says what came of it.
#pragma once
#include <string>
#include <vector>

namespace seascape::test {

struct ProgramResult {
  int exit_code = -1;  // 128 + the signal where one ended it
  std::string out, err;
};

// `words` follow the program's name; `environment` adds to this process's ("NAME=value"). Standard input is empty.
// Standard output goes to `out_file` where one is named ("/dev/full").
ProgramResult run_program(const std::vector<std::string>& words, const std::vector<std::string>& environment = {},
                          const std::string& out_file = "");

// Another program of the machine, found in PATH: `command` is its name and its words.
ProgramResult run_command(const std::vector<std::string>& command, const std::vector<std::string>& environment = {},
                          const std::string& out_file = "");

// The built program's file.
std::string program_file();

}  // namespace seascape::test
