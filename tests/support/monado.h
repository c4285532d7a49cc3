// A real runtime of OpenXR: a Monado service of the test's own, with its simulated headset and no screen.
// scripts/headset_proof.sh runs such tests where it is installed.
#pragma once
#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/support/desktop.h"
#include "tests/support/variable.h"

namespace seascape::test {

class Monado {
 public:
  // Programs that start while it lives, and this process, talk to it. Throws where it does not start.
  Monado();
  ~Monado();

  struct Client {
    int id = 0;
    pid_t process = 0;
    bool shown = false, focused = false;
  };
  // Programs that it serves, as monado-ctl lists them.
  std::vector<Client> clients() const;
  std::optional<Client> client(pid_t process) const;
  // What somebody chooses at its desk: the program that is seen and has the focus, and that space is centred anew.
  void choose(int id) const;
  void recentre() const;
  // It dies, as by a fault of its own.
  void kill();
  std::string log() const { return service_->out() + service_->err(); }

 private:
  std::string control(const std::vector<std::string>& words) const;
  TemporaryFolder folder_;  // the socket's
  Variable runtime_folder_;
  Variable quiet_{"OXR_NO_PRINTING_STDERR", "1"};  // in programs that it serves
  std::optional<Background> service_;
};

}  // namespace seascape::test
