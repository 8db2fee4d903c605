// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <chrono>
#include <string>
#include <thread>

#include "deployer.hpp"

namespace orca::test {

/// A run of a graph in virtual time, paused at first, that an operator steps through.
struct Operated {
  explicit Operated(const Words& graph) : program(deployer(graph + Words{"--pace", "0"} + virtual_clock())) {
    for (int tries = 0; run_orcactl({"pace"}).exit_code() != 0; ++tries) {
      REQUIRE(tries < 200);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  void step(const std::string& time) const {
    REQUIRE(run_orcactl({"step", time}, Seconds(60)).exit_code() == 0);
  }
  // Gives an order, which is carried out while time passes.
  Run order(const Words& words) const { return ask(words, 0); }
  // Gives an order that is refused.
  // @return why.
  std::string refused(const Words& words) const { return ask(words, 1).err; }
  Run to_the_end() {
    REQUIRE(run_orcactl({"pace", "fast"}).exit_code() == 0);
    return finish(program, Seconds(60));
  }

  Subprocess program;

 private:
  static Run ask(const Words& words, int status) {
    Subprocess asked(orcactl(words));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    REQUIRE(run_orcactl({"pace", "4"}).exit_code() == 0);
    const Run done = finish(asked, Seconds(20));
    INFO(done.err << done.out);
    CHECK(done.exit_code() == status);
    REQUIRE(run_orcactl({"pause"}).exit_code() == 0);
    return done;
  }
};

}  // namespace orca::test
