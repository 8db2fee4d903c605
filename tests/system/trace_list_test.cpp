// SPDX-License-Identifier: GPL-3.0-or-later
// While code is moved about, each shipped graph goes on doing what it did, to the last bit of each object that is delivered.
#include <catch2/catch.hpp>

#include <sstream>
#include <string>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

TEST_CASE("each shipped graph has the trace that it had before the house was put in order", "[system]") {
  std::istringstream lines(read_text(source_file("tests/data/trace_hashes.txt")));
  int compared = 0;
  for (std::string graph, profile, hash; lines >> graph >> profile >> hash; ++compared) {
    CAPTURE(graph, profile);
    const Run run =
        run_deployer(Words{source_file("graphs/" + graph + ".xml"), "--profile", profile, "--until", "60 s"} +
                         virtual_clock(),
                     Seconds(60));
    CHECK(run.trace_hash() == hash);
  }
  CHECK(compared == 28);
}
