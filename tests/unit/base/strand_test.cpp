// SPDX-License-Identifier: GPL-3.0-or-later
// The watch of a strand: what it sees to while the strand waits.
#include <catch2/catch.hpp>

#include <vector>

#include "case_in.hpp"
#include "orca/base/strand.hpp"

using namespace orca;

namespace {

constexpr TimePoint at(Duration time) { return TimePoint(time); }

// Runs `body` in virtual time, which begins at 0, with a strand that this task acts for.
void with_strand(const std::function<void(Executive&, Strand&)>& body) {
  const auto executive =
      make_executive({.clock = ClockKind::virtual_time, .backend = Backend::baton}).value();
  executive->run([&] {
    Strand strand(*executive, {"strand", 0});
    body(*executive, strand);
  });
}

}  // namespace

#define STRAND_CASE(title, tags) CASE_IN(with_strand, (Executive & executive, Strand & strand), title, tags)

STRAND_CASE("a watch is called when a wait begins and whenever it asked to be, until the deadline",
            "[base][strand]") {
  std::vector<TimePoint> looks;
  strand.set_watch([&] {
    looks.push_back(executive.now());
    return executive.now() + 30ms;
  });
  strand.pause_until(at(100ms));
  CHECK(executive.now() == at(100ms));
  CHECK(looks == std::vector{at(0ms), at(30ms), at(60ms), at(90ms)});
  looks.clear();
  CHECK_FALSE(strand.wait_for(at(140ms), [] { return false; }));
  CHECK(executive.now() == at(140ms));
  CHECK(looks == std::vector{at(100ms), at(130ms)});
}

STRAND_CASE("a watch that is called makes no wait look at its condition", "[base][strand]") {
  strand.set_watch([&] { return executive.now() + 10ms; });
  int conditions = 0;
  int leave_conditions = 0;
  strand.set_leave_condition([&] { return ++leave_conditions > 100; });
  CHECK_FALSE(strand.wait_for(at(100ms), [&] { return ++conditions > 100; }));
  CHECK(conditions == 2);  // at the beginning and at the deadline
  CHECK(leave_conditions == 1);
}

STRAND_CASE("a strand with a watch is woken as one without", "[base][strand]") {
  strand.set_watch([&] { return executive.now() + 10ms; });
  const auto waker = executive.spawn({"waker", 0}, [&] {
    executive.sleep_until(at(25ms));
    strand.wake();
  });
  strand.pause_until(kForever);
  CHECK(executive.now() == at(25ms));
}

STRAND_CASE("a watch with nothing to see does not keep virtual time going", "[base][strand]") {
  strand.set_watch([&] { return executive.now() < at(50ms) ? at(50ms) : kForever; });
  strand.pause_until(kForever);  // ends, because no task can ever run again
  CHECK(executive.now() == at(50ms));
}

TEST_CASE("a strand counts its acts that cannot be repeated, from none", "[base][strand]") {
  with_strand([](Executive&, Strand& strand) {
    CHECK(strand.activity() == 0);
    strand.note_activity();
    strand.note_activity();
    CHECK(strand.activity() == 2);
  });
}
