// SPDX-License-Identifier: GPL-3.0-or-later
#include "two_machines.hpp"

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace orca::test {
namespace {

bool try_command(const std::string& command) {
  return std::system(("( " + command + " ) >/dev/null 2>&1").c_str()) == 0;
}

void command(const std::string& command) {
  if (!try_command(command)) throw std::runtime_error("cannot: " + command);
}

}  // namespace

std::string TwoMachines::why_not() {
  if (geteuid() != 0) return "only root may make network namespaces";
  if (!try_command("command -v ip && command -v nsenter")) return "ip or nsenter is not installed";
  if (!try_command("unshare --net true")) return "the system gives no network namespaces";
  return {};
}

TwoMachines::TwoMachines() {
  static int made = 0;
  prefix_ = "orca_test_" + std::to_string(getpid()) + "_" + std::to_string(made++) + "_";
  for (const int machine : {0, 1}) command("ip netns add " + name(machine));
  command("ip -n " + name(0) + " link add orca0 type veth peer name orca0 netns " + name(1));
  for (const int machine : {0, 1}) {
    command("ip -n " + name(machine) + " addr add 10.77.0." + std::to_string(machine + 1) + "/24 dev orca0");
    command("ip -n " + name(machine) + " link set lo up");
  }
  connect(true);
}

TwoMachines::~TwoMachines() {
  for (const int machine : {0, 1}) try_command("ip netns del " + name(machine));
}

Words TwoMachines::on(int machine, const Words& command) const {
  const std::string sockets = "XDG_RUNTIME_DIR=" + folders_[machine].path().string();
  return Words{"/usr/bin/nsenter", "--net=/run/netns/" + name(machine), "/usr/bin/env", sockets} + command;
}

void TwoMachines::connect(bool connected) const {
  for (const int machine : {0, 1})
    command("ip -n " + name(machine) + " link set orca0 " + (connected ? "up" : "down"));
}

std::string TwoMachines::name(int machine) const { return prefix_ + std::to_string(machine); }

}  // namespace orca::test
