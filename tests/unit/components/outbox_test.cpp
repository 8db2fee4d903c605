// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <vector>

#include "goals/outbox.hpp"

using orca::go::Outbox;

namespace {

// Sends all that is due, and returns the indices of the points.
std::vector<std::size_t> send_all(Outbox& outbox) {
  std::vector<std::size_t> points;
  while (const auto next = outbox.next_point()) {
    points.push_back(*next);
    outbox.point_sent();
  }
  outbox.list_sent();
  return points;
}

using Indices = std::vector<std::size_t>;

}  // namespace

TEST_CASE("an outbox sends all points in order and the list, once", "[components][outbox]") {
  Outbox outbox(3);
  outbox.note_restarts({}, {});
  CHECK(outbox.list_is_due());
  CHECK(send_all(outbox) == Indices{0, 1, 2});
  CHECK(outbox.is_empty());
  CHECK_FALSE(outbox.is_outdated({}, {}));
  outbox.note_restarts({}, {});
  CHECK(outbox.is_empty());
}

TEST_CASE("a Goto that was started again gets the points that are ahead of the robot",
          "[components][outbox]") {
  Outbox outbox(3);
  outbox.note_restarts(0, 0);
  send_all(outbox);
  CHECK(outbox.points_left() == 3);
  outbox.note_left(2);
  CHECK(outbox.points_left() == 2);
  CHECK(outbox.is_empty());
  CHECK(outbox.is_outdated(1, 0));
  outbox.note_restarts(1, 0);
  CHECK_FALSE(outbox.list_is_due());
  CHECK(send_all(outbox) == Indices{1, 2});
  CHECK(outbox.is_empty());
}

TEST_CASE("a fuser that was started again gets the list", "[components][outbox]") {
  Outbox outbox(3);
  outbox.note_restarts(0, 0);
  send_all(outbox);
  CHECK(outbox.is_outdated(0, 1));
  outbox.note_restarts(0, 1);
  CHECK(outbox.list_is_due());
  CHECK(send_all(outbox).empty());
}

TEST_CASE("the goal is sent again even if the robot is said to have passed it", "[components][outbox]") {
  Outbox outbox(3);
  outbox.note_restarts(0, 0);
  send_all(outbox);
  outbox.note_left(0);
  outbox.note_restarts(1, 0);
  CHECK(send_all(outbox) == Indices{2});
}

TEST_CASE("more points left than the route has are all of them", "[components][outbox]") {
  Outbox outbox(2);
  outbox.note_restarts(0, 0);
  send_all(outbox);
  outbox.note_left(7);
  outbox.note_restarts(1, 0);
  CHECK(send_all(outbox) == Indices{0, 1});
}

TEST_CASE("points that were not taken are sent later; a restart in between begins afresh",
          "[components][outbox]") {
  Outbox outbox(3);
  outbox.note_restarts(0, 0);
  outbox.point_sent();
  CHECK_FALSE(outbox.is_empty());
  outbox.note_restarts(0, 0);
  CHECK(outbox.next_point() == 1);
  outbox.point_sent();
  outbox.note_restarts(1, 0);
  CHECK(send_all(outbox) == Indices{0, 1, 2});
}
