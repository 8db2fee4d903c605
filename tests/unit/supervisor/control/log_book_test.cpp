// SPDX-License-Identifier: GPL-3.0-or-later
#include "control/log_book.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;

TEST_CASE("how much each writes to the log lately is known, also in a flood", "[supervisor][log]") {
  TimePoint now(100s);
  log::set_level(log::Level::off);
  log::set_clock([&] { return now; });
  LogBook book([&] { return now; });
  for (int i = 0; i < 20; ++i) log::info("calm", "still here"), now += 500ms;
  CHECK(book.rates()["calm"] == Approx(2.0).epsilon(0.1));
  for (int i = 0; i < 5000; ++i) log::info("chatter", "again"), now += 1ms;
  CHECK(book.rates()["chatter"] == Approx(1000.0).epsilon(0.1));
  now += 11s;
  log::info("calm", "still here");
  CHECK(book.rates()["chatter"] < 101.0);
  log::set_clock(nullptr);
  log::set_level(log::Level::info);
}
