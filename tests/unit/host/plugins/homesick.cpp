// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <fstream>
#include <string>

#include "orca/component.hpp"

namespace {

/// Cannot be configured in one process, or only slowly, although it can be in the deployer's, where a graph is checked.
class Homesick final : public orca::Component {
 public:
  explicit Homesick(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    lap_every(orca::from_seconds(0.1));
    stay_active(true);
    std::ifstream name("/proc/self/comm");
    std::string here;
    std::getline(name, here);
    if (here != *abroad_) return orca::ok();
    if (*crashes_) std::raise(SIGSEGV);
    if (*nap_ > 0.0) {
      log_debug("naps");
      sleep(orca::from_seconds(*nap_));
      return orca::ok();
    }
    return orca::fail(orca::Code::failed_precondition, "this is not home");
  }
  orca::Outcome work() override { return orca::again(); }

  orca::Param<std::string> abroad_{*this, "abroad", "", {.text = "Process in which it cannot be."}};
  orca::Param<double> nap_{
      *this, "nap", 0.0, {.unit = "s", .text = "How long it takes there; 0: it cannot be there."}};
  orca::Param<bool> crashes_{*this, "crashes", false, {.text = "Whether it crashes there."}};
};

}  // namespace

ORCA_COMPONENT(Homesick, "test.Homesick")
