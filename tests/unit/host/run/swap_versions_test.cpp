// SPDX-License-Identifier: GPL-3.0-or-later
// The exchange of a component's code for versions that are unlike the ones before: one that stays in memory, one that keeps a
// state for the first time.
#include <catch2/catch.hpp>
#include <set>

#include "swap_order.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

TEST_CASE(
    "after code that cannot leave memory other code is exchanged as ever, and it is that code which runs",
    "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    std::set<std::string> builds;
    for (int i = 0; i < 3; ++i)
      for (const std::string version : {"9", "2"}) {
        CAPTURE(i, version);
        const Result<SwapReport> done =
            swap(run, next_teller(version == "9" ? "test_teller_stays" : "test_teller_2"));
        INFO((done ? "" : done.error().text()));
        REQUIRE(done);
        builds.insert(done->build_id);
        (void)run.news();
        run.sleep(100ms);
        const std::vector<std::string> heard = beginning(run.news(), "heard ");
        REQUIRE_FALSE(heard.empty());
        CHECK(heard.back().starts_with("heard " + version + ":"));
      }
    CHECK(builds.size() == 2);
  });
}

TEST_CASE("a version that keeps a state for the first time begins afresh, whatever the number of its state",
          "[host][swap]") {
  for (const std::string next : {"test_teller_first_state", "test_teller_later_state"}) {
    CAPTURE(next);
    LiveSystem live(kPair);
    live.run(virtual_executives().front(), [&next](LiveSystem& run) {
      SwapOrder plain = next_teller("test_teller_plain");
      plain.type = "test.PlainTeller";
      REQUIRE(swap(run, std::move(plain)));
      run.sleep(100ms);
      SwapOrder first = next_teller(next);
      first.type = "test.PlainTeller";
      const Result<SwapReport> done = swap(run, std::move(first));
      INFO((done ? "" : done.error().text()));
      REQUIRE(done);
      CHECK(done->state.empty());
      run.sleep(100ms);
      CHECK_FALSE(beginning(run.news(), next == "test_teller_first_state" ? "heard 4:" : "heard 5:").empty());
    });
  }
}
