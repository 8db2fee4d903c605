// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "deployer.hpp"
#include "temp_folder.hpp"

namespace orca::test {

/// Two network namespaces, joined by a cable: a machine each, as far as the network and the sockets of systems are concerned. In both the network
/// interface is called orca0. The destructor removes them.
///
/// Thread contract: not synchronised.
class TwoMachines {
 public:
  /// Returns why this process cannot have such machines; empty: it can.
  [[nodiscard]] static std::string why_not();

  /// @pre  why_not() is empty.
  TwoMachines();
  ~TwoMachines();
  TwoMachines(const TwoMachines&) = delete;
  TwoMachines& operator=(const TwoMachines&) = delete;

  /// Returns a command as it runs on machine 0 or 1. It has the process id of the program.
  [[nodiscard]] Words on(int machine, const Words& command) const;

  /// Pulls the cable, or puts it back.
  void connect(bool connected) const;

 private:
  [[nodiscard]] std::string name(int machine) const;

  std::string prefix_;
  const TempFolder folders_[2];  // for the machines' sockets
};

}  // namespace orca::test
