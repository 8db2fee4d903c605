// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/log_relay.hpp"

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

TEST_CASE("a process that wishes it is told what all others write from then on", "[supervisor][log]") {
  Heard h;
  log::info("goto", "before");
  h.relay.note_wish(h.keeper, true);
  log::warning("goto", "from the supervisor's own");
  h.relay.set_source(&h.keeper);
  log::info("log", "the keeper knows this");
  h.relay.set_source(&h.other);
  log::info("base", "another");
  const TellLines told = h.relay.take_for(h.keeper);
  REQUIRE(told.lines.size() == 2);
  CHECK(told.lines[0].level == log::Level::warning);
  CHECK(told.lines[0].who == "goto");
  CHECK(told.lines[0].text == "from the supervisor's own");
  CHECK(told.lines[1].text == "another");
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

TEST_CASE("nothing is kept once nobody wishes to hear the others", "[supervisor][log]") {
  Heard h;
  h.relay.note_wish(h.keeper, true);
  log::info("goto", "kept");
  h.relay.pass_on({&h.keeper});  // it does not run any more
  CHECK(h.relay.take_for(h.keeper).lines.empty());
  h.relay.note_wish(h.keeper, true);
  CHECK(h.relay.take_for(h.keeper).lines.empty());
}
