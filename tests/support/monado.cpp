#include "tests/support/monado.h"

#include <csignal>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "tests/support/run_program.h"

namespace seascape::test {

// Its null compositor shows 20 pictures a second of 320x240 pixels an eye. The folder is a new one: a socket that is
// left of a service that died would be taken for one that lives.
Monado::Monado() : runtime_folder_("XDG_RUNTIME_DIR", folder_.path().c_str()) {
  service_.emplace(std::vector<std::string>{"monado-service"},
                   std::vector<std::string>{"XRT_COMPOSITOR_NULL=1", "SIMULATED_ENABLE=1", "SIMULATED_LEFT=simple",
                                            "SIMULATED_RIGHT=simple", "XRT_NO_STDIN=1"});
  const auto ready = [this] { return std::filesystem::exists(folder_ / "monado_comp_ipc") || !service_->running(); };
  if (!wait_until(ready) || !service_->running()) throw std::runtime_error("Monado does not start: " + log());
}

Monado::~Monado() = default;

std::string Monado::control(const std::vector<std::string>& words) const {
  std::vector<std::string> command{"monado-ctl"};
  command.insert(command.end(), words.begin(), words.end());
  const ProgramResult result = run_command(command);
  if (result.exit_code != 0) throw std::runtime_error("monado-ctl: " + result.out + result.err);
  return result.out;
}

// "id: 1  act: 1  disp: 1  foc: 1  io: 1  ovly: 0  z: 0  pid: 25  Seascape", a client a line, among other lines.
std::vector<Monado::Client> Monado::clients() const {
  std::vector<Client> all;
  std::istringstream text(control({}));
  for (std::string line; std::getline(text, line);) {
    if (line.find("pid:") == std::string::npos) continue;
    Client client;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      int value = 0;
      if (!word.ends_with(':') || !(words >> value)) break;
      if (word == "id:") client.id = value;
      if (word == "disp:") client.shown = value != 0;
      if (word == "foc:") client.focused = value != 0;
      if (word == "pid:") client.process = value;
    }
    all.push_back(client);
  }
  return all;
}

std::optional<Monado::Client> Monado::client(pid_t process) const {
  for (const Client& one : clients())
    if (one.process == process) return one;
  return std::nullopt;
}

void Monado::choose(int id) const { control({"-p", std::to_string(id)}); }
void Monado::recentre() const { control({"-c"}); }

void Monado::kill() {
  service_->send(SIGKILL);
  service_->exit_code();
}

}  // namespace seascape::test
