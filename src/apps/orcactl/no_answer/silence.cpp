// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "no_answer/silence.hpp"

#include <fstream>
#include <limits>

namespace orca::orcactl {
namespace {

// Whether a signal or a debugger has stopped a process.
bool is_stopped(pid_t process) {
  std::ifstream statistics("/proc/" + std::to_string(process) + "/stat");
  statistics.ignore(std::numeric_limits<std::streamsize>::max(), ')');  // the end of its name
  char state = '?';
  statistics >> state;
  return state == 'T' || state == 't';
}

// Returns what may not have come about.
std::string unconfirmed(const apps::Call& call) {
  if (call.command->name == "stop") return "nobody has confirmed yet that the system ends. ";
  if (call.command->name != "estop") return "";
  if (call.has("--release")) return "nobody has confirmed the release yet. ";
  return "NOBODY HAS CONFIRMED THE EMERGENCY STOP: what the system moves may go on; take the power from the "
         "motors. ";
}

}  // namespace

std::string silence_text(const apps::Call& call, pid_t deployer) {
  const std::string order = unconfirmed(call);
  const bool stands = deployer > 0 && is_stopped(deployer);
  if (order.empty() && !stands) return "";
  if (deployer <= 0) return order + "The deployer does not answer";
  const std::string number = std::to_string(deployer);
  const std::string silence =
      stands ? ", is stopped, as by SIGSTOP, Ctrl+Z, or a debugger: kill -CONT " + number + " lets it go on"
             : ", does not answer";
  return order + "The deployer, process " + number + silence + "; kill -KILL " + number +
         " ends it, and with it its processes, which stop what they move; with "
         "on_supervisor_loss=\"continue\" they go on, and obey orcactl estop";
}

}  // namespace orca::orcactl
