// SPDX-License-Identifier: GPL-3.0-or-later
// Looks into recordings by orcactl bag.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "deployer.hpp"

namespace orca::test {

/// Runs orcactl bag.
inline Run bag(const Words& words) { return run_orcactl(Words{"bag"} + words); }

/// Returns the cell of a topic in `bag info --json`; "" if there is no such topic.
inline std::string cell_of(const std::string& info, const std::string& topic, const std::string& name) {
  const std::size_t there = info.find("\"" + topic + "\"");
  if (there == std::string::npos) return "";
  const std::string object =
      info.substr(info.rfind('{', there), info.find('}', there) - info.rfind('{', there));
  const std::size_t at = object.find("\"" + name + "\":");
  if (at == std::string::npos) return "";
  const std::size_t begin = object.find_first_not_of(" \"", at + name.size() + 3);
  return object.substr(begin, object.find_first_of("\",\n", begin) - begin);
}

/// Returns `bag info --json` of a file.
inline std::string info_of(const std::string& file) {
  const Run run = run_orcactl({"--json", "bag", "info", file});
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return run.out;
}

/// Returns how many objects of a topic there are.
inline int count_in(const std::string& info, const std::string& topic) {
  const std::string count = cell_of(info, topic, "messages");
  return count.empty() ? 0 : std::stoi(count);
}

}  // namespace orca::test
