#include "engine/error.h"

#include "engine/text.h"

namespace seascape {

namespace {
// Names of files may hold anything: a line stays a line, and no terminal obeys it.
std::string sentence(const std::string& where, const std::string& what, const std::string& remedy) {
  std::string text = where.empty() ? what : one_line(where, where.size()) + ": " + what;
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
