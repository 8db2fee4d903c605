// SPDX-License-Identifier: GPL-3.0-or-later
// What an edge reports of its own accord when it cannot do what it is there for, for every link.
#include "query_kits.hpp"
#include "send_kits.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using Kinds = std::set<LinkTrouble>;

TEMPLATE_LIST_TEST_CASE("a refused object is reported with both ends and the server's reason",
                        "[contract][send][trouble]", LinkKits) {
  on_each_executive<TestType>([](TestType& kit) {
    Troubles troubles;
    Line line(kit, 1);
    line.sender.home().observer = &troubles;
    line.taker.open();
    REQUIRE(line.sender.out.send(numbered(1)).ok());
    CHECK(troubles.lines().empty());
    REQUIRE_FALSE(line.sender.out.send(numbered(2)).ok());
    REQUIRE(troubles.lines().size() == 1);
    CHECK_THAT(troubles.lines()[0],
               Contains("sender.out to taker.in: refused: taker.in is full: 1 objects"));
    CHECK(troubles.kinds() == Kinds{LinkTrouble::refused});
    CHECK(line.sender.out.counters().failed == 1);
  });
}

TEMPLATE_LIST_TEST_CASE("an object for which there was no room in time is reported",
                        "[contract][send][trouble]", LinkKits) {
  on_each_executive<TestType>([](TestType& kit) {
    Troubles troubles;
    Line line(kit, 1);
    line.sender.home().observer = &troubles;
    line.taker.open();
    REQUIRE(line.sender.out.send(numbered(1)).ok());
    REQUIRE_FALSE(line.sender.out.send_wait_max(numbered(2), 20ms).ok());
    REQUIRE(troubles.lines().size() == 1);
    CHECK(troubles.lines()[0] ==
          "sender.out to taker.in: taker.in had no room for what sender.out sent in time");
    CHECK(line.sender.out.counters().timed_out == 1);
  });
}

TEMPLATE_LIST_TEST_CASE("a question that is answered with an error, refused or not answered is reported",
                        "[contract][query][trouble]", LinkKits) {
  on_each_executive<TestType>([](TestType& kit) {
    Troubles troubles;
    Counter counter(kit);
    counter.asker.home().observer = &troubles;
    CHECK_FALSE(counter.asker.ask_in_vain("early"));
    counter.answerer.open();
    CHECK_FALSE(counter.asker.question.query(counter.asker.about("time"), 20ms));
    {
      const Service service(counter.answerer);
      CHECK_FALSE(counter.asker.question.query(counter.asker.about("bad"), 5s));
      CHECK(counter.asker.question.query(counter.asker.about("good"), 5s));
    }
    const std::vector<std::string> lines = troubles.lines();
    REQUIRE(lines.size() == 3);
    CHECK_THAT(lines[0], Contains("asker.question to answerer.server: refused: ") &&
                             Contains("has not been started yet"));
    CHECK_THAT(lines[1], Contains("answerer.server did not answer asker.question in time"));
    CHECK_THAT(lines[2], Contains("refused: there is nothing to say about bad"));
    CHECK(troubles.kinds() == Kinds{LinkTrouble::refused});
  });
}
