// The one exception of the program: a fault of files, devices, headsets or input, told in words a user can act on.
#pragma once
#include <stdexcept>
#include <string>

namespace seascape {

// What main prints as `seascape: WHERE: WHAT; REMEDY` and turns into an exit status. `where` names the file (with a
// line where one is known, "scene.json:12"), the device or the argument; it may be empty.
class Error : public std::runtime_error {
 public:
  Error(std::string where, std::string what, std::string remedy, int exit_code = 1);
  const std::string& where() const { return where_; }
  const std::string& fault() const { return fault_; }
  const std::string& remedy() const { return remedy_; }
  int exit_code() const { return exit_code_; }  // 1 a fault, 2 wrong usage

 private:
  std::string where_, fault_, remedy_;
  int exit_code_;
};

}  // namespace seascape
