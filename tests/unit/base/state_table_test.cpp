// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/state_table.hpp"

#include <catch2/catch.hpp>

#include <vector>

using namespace orca;

namespace {

enum class Door { shut, open };
enum class Push { in, out, hard };
enum class Do { swing, creak };
using Row = Transition<Door, Push, Do>;

constexpr auto kRows = std::to_array<Row>(
    {{Door::shut, Push::in, Door::open, {Do::creak, Do::swing}}, {Door::open, Push::out, Door::shut, {}}});
constexpr StateTable<Door, Push, Do, 2, 3, 2> kDoor{kRows};

std::vector<Do> actions(const Row& row) { return {row.actions.begin(), row.actions.end()}; }

}  // namespace

TEST_CASE("a state table finds the row for a state and an event, and knows where there is none",
          "[base][state_table]") {
  REQUIRE(kDoor.find(Door::shut, Push::in) != nullptr);
  CHECK(kDoor.find(Door::shut, Push::in)->to == Door::open);
  REQUIRE(kDoor.find(Door::open, Push::out) != nullptr);
  CHECK(kDoor.find(Door::open, Push::out)->to == Door::shut);
  CHECK(kDoor.find(Door::shut, Push::out) == nullptr);
  CHECK(kDoor.find(Door::shut, Push::hard) == nullptr);
  CHECK(kDoor.find(Door::open, Push::in) == nullptr);
  CHECK(kDoor.find(Door::open, Push::hard) == nullptr);
}

TEST_CASE("a row keeps its actions in their order, and may have none", "[base][state_table]") {
  CHECK(actions(kDoor.rows()[0]) == std::vector{Do::creak, Do::swing});
  CHECK(actions(kDoor.rows()[1]).empty());
}

TEST_CASE("two rows for one state and event are refused", "[base][state_table]") {
  const auto rows =
      std::to_array<Row>({{Door::shut, Push::in, Door::open, {}}, {Door::shut, Push::in, Door::shut, {}}});
  using Table = StateTable<Door, Push, Do, 2, 3, 2>;
  CHECK_THROWS(Table{rows});
}
