// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl fits, and swap --only-try: what could take a component's place, and what comes of a trial.
#include <catch2/catch.hpp>
#include <string>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

// A component that counts what another one says a hundred times a second.
std::string graph(const std::string& more_plugins) {
  return "<graph name=\"fits_test\" version=\"1\" plugins=\"" ORCA_BINARY_DIR "/tests/host_plugins" +
         more_plugins +
         "\"><component name=\"teller\" type=\"test.Teller\"/>"
         "<component name=\"talker\" type=\"test.Talker\"/>"
         "<connect from=\"talker.out\" to=\"teller.in\" queue=\"1000\"/>"
         "<connect from=\"talker.poke\" to=\"teller.poke\" queue=\"1000\"/>"
         "<connect from=\"teller.out\" to=\"talker.back\" queue=\"1000\"/></graph>";
}

Run swap(const std::string& version, const Words& more) {
  return run_orcactl(Words{"swap", "teller", ORCA_BINARY_DIR "/tests/next_plugins/" + version + ".so"} +
                     more);
}

}  // namespace

TEST_CASE("the types that fit a component are listed, and those that cannot be asked are named",
          "[system][fits]") {
  if (kThreadSanitizer) return;  // it cannot follow a copy of a process
  TempFolder folder;
  for (const std::string name : {"bad_static_crashes", "bad_constructor_exits", "bad_static_hangs"})
    copy_plugin(ORCA_BINARY_DIR "/tests/unit_plugins/bad/" + name + ".so", folder.path());
  const std::string text = graph(";" + folder.path().string());
  Subprocess program(deployer({folder.write("fits.xml", text), "--log", "debug"}));
  REQUIRE(program.wait_for_output("heard 1:10", Seconds(20) * kSlowdown));
  const Run fits = run_orcactl({"fits", "teller"});
  INFO(fits.out << fits.err);
  REQUIRE(fits.exit_code() == 0);
  CHECK_THAT(fits.out, Contains("test.Teller ") && Contains(" test_teller.so"));
  CHECK_THAT(fits.out, !Contains("test.Talker"));
  CHECK_THAT(fits.err, Contains("bad_static_crashes.so could not be looked at"));
  CHECK_THAT(fits.err, Contains("bad_constructor_exits.so could not be looked at"));
  CHECK_THAT(fits.err, Contains("bad_static_hangs.so could not be looked at"));
  CHECK_THAT(run_orcactl({"fits", "nobody"}).err, Contains("nobody"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(program, Seconds(10)).exit_code() == 0);
}

TEST_CASE("a trial alone says what came of it, and exchanges nothing", "[system][fits]") {
  if (kThreadSanitizer) return;  // it cannot follow a copy of a process
  TempFolder folder;
  Subprocess program(deployer({folder.write("fits.xml", graph("")), "--log", "debug"}));
  REQUIRE(program.wait_for_output("heard 1:10", Seconds(20) * kSlowdown));
  const Words only_try{"--only-try", "--tryout", "300 ms"};
  const Run good = swap("test_teller_2", only_try + Words{"--json"});
  INFO(good.out << good.err);
  REQUIRE(good.exit_code() == 0);
  CHECK_THAT(good.out, Contains("\"type\": \"test.Teller\"") || Contains("\"type\":\"test.Teller\""));
  const Run bad = swap("test_teller_lap_crashes", only_try);
  CHECK(bad.exit_code() == 1);
  CHECK_THAT(bad.err, Contains("was tried out beside the one that runs"));
  CHECK_THAT(run_orcactl({"plugins"}).out, !Contains("next_plugins"));
  CHECK_THAT(stop_without_gaps(program), !Contains("heard 2:"));
}
