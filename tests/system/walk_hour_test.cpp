// SPDX-License-Identifier: GPL-3.0-or-later
#include "walks.hpp"

TEST_CASE("a robot walks about in ten worlds for an hour each without a crash", "[system][walk]") {
  orca::test::walk_in_ten_worlds("3600 s", orca::test::Seconds(900));
}
