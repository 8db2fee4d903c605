// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <vector>

#include "all_ports.hpp"
#include "executives.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/local/local_links.hpp"

using namespace orca;
using namespace orca::test;

namespace {

using Numbers = std::vector<std::uint64_t>;

// The structured bindings name every member: a new one does not compile here until it is looked at too.
Numbers numbers_of(const EdgeCounters& counters) {
  const auto [delivered, dropped, oldest, newest, blocked, by_link, unmatched, left_behind, over_limit, waits,
              missed, queued, high_water] = counters;
  return {delivered,   dropped,    oldest, newest, blocked, by_link,   unmatched,
          left_behind, over_limit, waits,  missed, queued,  high_water};
}

Numbers numbers_of(const IntakeCounters& counters) {
  const auto [accepted, refused, failed, full, closed, withdrawn, waits, queued, high_water] = counters;
  return {accepted, refused, failed, full, closed, withdrawn, waits, queued, high_water};
}

Numbers numbers_of(const RequestCounters& counters) {
  const auto [sent, answered, failed, timed_out] = counters;
  return {sent, answered, failed, timed_out};
}

struct Ends : AllPorts {
  using AllPorts::AllPorts;
  [[nodiscard]] IntakeCounters sent_here() const {
    return port<SendServerEndpoint>(*this, "taker").counters();
  }
  [[nodiscard]] IntakeCounters asked_here() const {
    return port<QueryServerEndpoint>(*this, "answerer").counters();
  }
};

}  // namespace

TEST_CASE("all counters of connected ports are 0 until something is sent", "[patterns][counters]") {
  run_on({}, [](Executive& executive) {
    Ends a(executive, "a");
    Ends b(executive, "b");
    LocalLinks links;
    REQUIRE(links.connect(a.endpoint("out"), b.endpoint("in")).ok());
    REQUIRE(links.connect(a.endpoint("sender"), b.endpoint("taker")).ok());
    REQUIRE(links.connect(a.endpoint("question"), b.endpoint("answerer")).ok());
    b.in.subscribe();
    b.open();
    CHECK(numbers_of(b.in.counters()) == Numbers(13, 0));
    CHECK(numbers_of(b.sent_here()) == Numbers(9, 0));
    CHECK(numbers_of(b.asked_here()) == Numbers(9, 0));
    CHECK(numbers_of(a.sender.counters()) == Numbers(4, 0));
    CHECK(numbers_of(a.question.counters()) == Numbers(4, 0));
  });
}

TEST_CASE("all counters of a proxy that is not connected are 0", "[patterns][counters]") {
  run_on({}, [](Executive& executive) {
    const Ends a(executive, "a");
    CHECK(numbers_of(a.in.counters()) == Numbers(13, 0));
    CHECK(numbers_of(a.sender.counters()) == Numbers(4, 0));
    CHECK(numbers_of(a.question.counters()) == Numbers(4, 0));
  });
}

TEST_CASE("an object that is delivered, sent or answered is counted once, and nothing else is",
          "[patterns][counters]") {
  run_on({}, [](Executive& executive) {
    Ends a(executive, "a");
    Ends b(executive, "b");
    LocalLinks links;
    REQUIRE(links.connect(a.endpoint("out"), b.endpoint("in")).ok());
    REQUIRE(links.connect(a.endpoint("sender"), b.endpoint("taker")).ok());
    b.in.subscribe();
    b.open();
    a.out.push(full_stop());
    REQUIRE(a.sender.send(full_stop()).ok());
    const EdgeCounters edge = b.in.counters();
    CHECK(numbers_of(edge) == Numbers{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1});
    CHECK(numbers_of(b.sent_here()) == Numbers{1, 0, 0, 0, 0, 0, 0, 1, 1});
    CHECK(numbers_of(a.sender.counters()) == Numbers{1, 1, 0, 0});
  });
}

TEST_CASE("the counters of several edges add up, each by itself", "[patterns][counters]") {
  IntakeCounters sum{1, 2, 3, 4, 5, 6, 7, 8, 9};
  sum += IntakeCounters{10, 20, 30, 40, 50, 60, 70, 80, 90};
  CHECK(numbers_of(sum) == Numbers{11, 22, 33, 44, 55, 66, 77, 88, 99});
}
