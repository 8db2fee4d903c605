// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Batches of runs, as tests start them from outside.
#pragma once

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <string>

#include "deployer.hpp"
#include "temp_folder.hpp"

namespace orca::test {

inline Words simbatch(const Words& words) { return Words{ORCA_BINARY_DIR "/bin/simbatch"} + words; }

inline Run run_simbatch(const Words& words, Seconds limit = Seconds(120)) {
  Subprocess program(simbatch(words));
  return finish(program, limit);
}

/// A short drive of two variants through two worlds, twice. The laps of one take some time.
inline std::string drive(const TempFolder& folder) {
  return folder.write("drive.xml", R"(<experiment name="drive" seeds="1 7" until="12 s" graph=")" +
                                       source_file("graphs/pioneer_laser_goto.xml") + R"(">
  <variant name="LaserAvoid"><set arg="avoid" value="orca.LaserAvoid"/></variant>
  <variant name="VfhPlus"><set arg="avoid" value="orca.VfhPlus"/><set arg="takes" value="30 ms"/></variant>
  <world name="ideal"><set arg="realism" value="ideal"/></world>
  <world name="harsh"><set arg="realism" value="harsh"/></world>
</experiment>)");
}

/// Variants that say numbers, which depend on what their name says before "_": addresses, hashes of them, environment, folder,
/// memory that was never set (garbage), or nothing.
inline std::string dependents(const TempFolder& folder, const std::string& name, const Words& names,
                              const std::string& seeds = "1-2") {
  std::string variants;
  for (const std::string& one : names)
    variants += "<variant name=\"" + one + "\"><set arg=\"on\" value=\"" + one.substr(0, one.find('_')) +
                "\"/></variant>";
  return folder.write(name, "<experiment name=\"dependents\" seeds=\"" + seeds +
                                "\" until=\"10 s\" graph=\"" + system_graph("dependent.xml") +
                                "\"><set arg=\"plugins\" value=\"" +
                                std::string(ORCA_BINARY_DIR "/tests/plugins") + "\"/>" + variants +
                                "<world name=\"here\"/></experiment>");
}

inline std::string text_in(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  REQUIRE_FALSE(text.empty());
  return text;
}

inline std::string exported(const std::string& folder) {
  const Run run = run_simbatch({"export", folder});
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return run.out;
}

inline std::string batch(const std::string& experiment, const std::string& out, const Words& more = {}) {
  const Run run = run_simbatch(Words{experiment, "--out", out} + more);
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return exported(out);
}

}  // namespace orca::test
