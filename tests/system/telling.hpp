// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <string>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

namespace orca::test {

inline std::string next_version(const std::string& name) {
  return std::string(ORCA_BINARY_DIR "/tests/next_plugins/") + name + ".so";
}

// A component that counts what another one says a hundred times a second, in this process or in another one.
inline std::string telling_graph(const std::string& process) {
  return "<graph name=\"swap_test\" version=\"1\" plugins=\"" ORCA_BINARY_DIR
         "/tests/host_plugins\">\n"
         "  <process name=\"counting\"/><process name=\"talking\"/>\n"
         "  <component name=\"teller\" type=\"test.Teller\" process=\"counting\"/>\n"
         "  <component name=\"talker\" type=\"test.Talker\" process=\"" +
         process +
         "\"/>\n"
         "  <connect from=\"talker.out\" to=\"teller.in\" queue=\"1000\"/>\n"
         "  <connect from=\"talker.poke\" to=\"teller.poke\" queue=\"1000\"/>\n"
         "  <connect from=\"teller.out\" to=\"talker.back\" queue=\"1000\"/>\n"
         "</graph>\n";
}

// A system whose teller can be exchanged, and what its log says of it.
class Telling {
 public:
  explicit Telling(const std::string& process)
      : file_(folder_.write("swap.xml", telling_graph(process))),
        program_(deployer({file_, "--log", "debug"})) {
    REQUIRE(program_.wait_for_output("heard 1:10", Seconds(20) * kSlowdown));
  }

  // Tries the new code with what comes in a third of a second: some thirty objects.
  Run swap(const std::string& plugin, const Words& more = {}, const std::string& tryout = "300 ms") {
    return run_orcactl(Words{"swap", "teller", plugin, "--tryout", tryout} + more);
  }
  bool hears(const std::string& text) { return program_.wait_for_output(text, Seconds(10) * kSlowdown); }
  [[nodiscard]] std::string log() const { return program_.err(); }
  Subprocess& program() { return program_; }
  [[nodiscard]] const TempFolder& folder() const { return folder_; }

  // Ends the system, and checks that nothing was lost, doubled or out of order in all that time.
  void end_in_order() {
    CHECK(run_orcactl({"suspend", "talker"}).exit_code() ==
          0);  // two processes do not end at the same moment
    CHECK(run_orcactl({"stop"}).exit_code() == 0);
    const Run run = finish(program_, Seconds(10));
    CHECK(run.exit_code() == 0);
    CHECK_THAT(run.err, !Catch::Contains("gap "));
    CHECK_THAT(run.err, !Catch::Contains("poke "));
    CHECK_THAT(run.err, !Catch::Contains("not sent"));
  }

 private:
  TempFolder folder_;
  std::string file_;
  Subprocess program_;
};

}  // namespace orca::test
