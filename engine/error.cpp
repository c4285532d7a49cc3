#include "engine/error.h"

namespace seascape {

namespace {
std::string sentence(const std::string& where, const std::string& what, const std::string& remedy) {
  std::string text = where.empty() ? what : where + ": " + what;
  if (!remedy.empty()) text += "; " + remedy;
  return text;
}
}  // namespace

Error::Error(std::string where, std::string what, std::string remedy, int exit_code)
    : std::runtime_error(sentence(where, what, remedy)),
      where_(std::move(where)),
      fault_(std::move(what)),
      remedy_(std::move(remedy)),
      exit_code_(exit_code) {}

}  // namespace seascape
