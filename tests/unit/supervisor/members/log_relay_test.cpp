// SPDX-License-Identifier: GPL-3.0-or-later
#include "members/log_relay.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;

namespace {

// Keeps the lines of a test off the screen.
class Silence {
 public:
  Silence() { log::set_level(log::Level::off); }
  ~Silence() { log::set_level(log::Level::info); }
};

struct Heard {
  LogRelay relay;
  Member keeper{{.name = "keeper"}, 0, 0};
  Member other{{.name = "other"}, 1, 1};
  Silence silence;
};

}  // namespace

TEST_CASE("a process that wishes it is told what all others write, and have written before",
          "[supervisor][log]") {
  Heard h;
  log::info("goto", "before");
  h.relay.note_wish(h.keeper, true);
  log::warning("goto", "from the supervisor's own");
  h.relay.set_source(&h.keeper);
  log::info("log", "the keeper knows this");
  h.relay.set_source(&h.other);
  log::info("base", "another");
  const TellLines told = h.relay.take_for(h.keeper);
  REQUIRE(told.lines.size() == 3);
  CHECK(told.lines[0].text == "before");
  CHECK(told.lines[1].level == log::Level::warning);
  CHECK(told.lines[1].who == "goto");
  CHECK(told.lines[1].text == "from the supervisor's own");
  CHECK(told.lines[2].text == "another");
  CHECK(h.relay.take_for(h.keeper).lines.empty());
  CHECK(h.relay.take_for(h.other).lines.empty());
}

TEST_CASE("a flood of lines is cut, and the process learns by how much", "[supervisor][log]") {
  Heard h;
  h.relay.note_wish(h.keeper, true);
  for (std::size_t i = 0; i < LogRelay::kMostLines + 50; ++i) log::info("goto", std::to_string(i));
  const TellLines first = h.relay.take_for(h.keeper);
  REQUIRE(first.lines.size() == 100);
  CHECK(first.lines[0].text == "50 lines of other processes came too fast, and are left out");
  CHECK(first.lines[1].text == "50");
  std::size_t count = first.lines.size() - 1;
  for (std::size_t now = 1; now > 0; count += now) now = h.relay.take_for(h.keeper).lines.size();
  CHECK(count == 1000);
}

TEST_CASE("a process that comes again hears what was written meanwhile, and nothing twice",
          "[supervisor][log]") {
  Heard h;
  h.relay.note_wish(h.keeper, true);
  log::info("goto", "told");
  CHECK(h.relay.take_for(h.keeper).lines.size() == 1);
  h.relay.pass_on({&h.keeper});  // it does not run any more
  log::info("goto", "while it was away");
  CHECK(h.relay.take_for(h.keeper).lines.empty());
  h.relay.note_wish(h.keeper, true);
  const TellLines told = h.relay.take_for(h.keeper);
  REQUIRE(told.lines.size() == 1);
  CHECK(told.lines[0].text == "while it was away");
}
