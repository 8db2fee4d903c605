// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdlib.h>

#include <catch2/catch.hpp>
#include <string>

#include "deployer.hpp"
#include "temp_folder.hpp"

namespace orca::test {

/// A folder in which this process, and all that it starts, look for keys. The destructor removes it.
///
/// Thread contract: while it is made and destroyed no other thread may read the environment.
class KeyHome {
 public:
  KeyHome() { setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1); }
  ~KeyHome() { unsetenv("XDG_CONFIG_HOME"); }
  KeyHome(const KeyHome&) = delete;
  KeyHome& operator=(const KeyHome&) = delete;

  /// Makes, renews or revokes keys by `orcactl keys`.
  /// @param graph  the words of the deployer that say which graph it is.
  Run make(const Words& graph, const Words& more = {}) const {
    Run run = run_orcactl(Words{"keys"} + graph + more);
    INFO(run.err);
    REQUIRE(run.exit_code() == 0);
    return run;
  }
  [[nodiscard]] std::string of_system(const std::string& system) const {
    return folder_.file("orca/keys/" + system);
  }

 private:
  const TempFolder folder_;
};

}  // namespace orca::test
