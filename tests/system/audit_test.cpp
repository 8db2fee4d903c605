// SPDX-License-Identifier: GPL-3.0-or-later
// Who has ordered a running system what, and what came of it.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "deployer.hpp"
#include "operated.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

// Returns the lines of the log that tell orders.
Words orders_in(const std::string& log) {
  Words orders;
  for (const std::string& line : split_lines(log))
    if (line.find(" audit: ") != std::string::npos) orders.push_back(line);
  return orders;
}

bool has_order(const Words& orders, const std::string& text) {
  return std::ranges::any_of(orders,
                             [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("each order to a system is in the log with who, when and what came of it, and looking is not",
          "[system][audit]") {
  Operated system({source_file("graphs/scout_goto.xml")});
  CHECK(run_orcactl({"ps"}).exit_code() == 0);
  CHECK(run_orcactl({"get", "goto"}).exit_code() == 0);
  CHECK(run_orcactl({"pause"}).exit_code() == 0);
  CHECK(run_orcactl({"set", "goto.none", "1\n[ 0] info audit: user root: stop: done"}).exit_code() == 1);
  const Run audit = run_orcactl({"log", "audit"});
  CHECK(audit.err.empty());
  const Run misspelt = run_orcactl({"log", "adit"});
  CHECK(misspelt.says("none of the lines that are kept is of \"adit\"; there are lines of: "));
  CHECK_THAT(misspelt.err, Contains("audit"));
  const Words orders = orders_in(audit.out);
  const std::string who = "(" + std::to_string(geteuid()) + "), orcactl[";
  REQUIRE(orders.size() == 2);
  for (const std::string& order : orders) CHECK_THAT(order, Contains(who) && Contains("], at 20"));
  CHECK_THAT(orders[0], Contains("info") && Contains("Z: pause: done"));
  CHECK_THAT(orders[1], Contains("warning") && Contains(R"(: set 'goto.none' '1\n[ 0] info)") &&
                            Contains(": not done: "));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  const Run run = finish(system.program, Seconds(20));
  CHECK(has_order(orders_in(run.err), "Z: stop: done"));
  CHECK_FALSE(has_order(orders_in(run.err), "Z: ps"));
}
