// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/batch/record.hpp"

using namespace orca::batch;

namespace {

const Outcome kSome{
    .ending = Ending::failed,
    .reason = "avoid: it threw",
    .time = 0.1 + 0.2,
    .goals = 2,
    .failed_goals = 1,
    .contacts = 3,
    .failure = Failure::trap,
    .measures = {.way = 1.0 / 3.0, .spl = 0.0, .impact_speed = 0.25},
    .trace_hash = "0123456789abcdef",
    .sketch = {"0.00 1.25,0.10 1.25", "0.10 1.25", "0.00 0.00,4.00 0.00;1.00 1.00,2.00 1.00"}};

}  // namespace

TEST_CASE("an outcome reads back as it was written, to the last bit", "[batch]") {
  const auto read = read_outcome(to_text(kSome));
  REQUIRE(read);
  CHECK(*read == kSome);
  CHECK(read_outcome(to_text({})) == Outcome{});
}

TEST_CASE("a reason of several lines becomes one", "[batch]") {
  Outcome outcome = kSome;
  outcome.reason = "one\ntwo";
  CHECK(read_outcome(to_text(outcome))->reason == "one two");
}

TEST_CASE("an outcome that was cut off anywhere is none", "[batch]") {
  const std::string whole = to_text(kSome);
  for (std::size_t size = 0; size < whole.size(); ++size) CHECK_FALSE(read_outcome(whole.substr(0, size)));
  CHECK_FALSE(read_outcome(whole + "more\n"));
}

TEST_CASE("endings have names that read back", "[batch]") {
  for (const Ending ending : {Ending::success, Ending::contact, Ending::goal_failed, Ending::time_out,
                              Ending::failed, Ending::crash, Ending::hang})
    CHECK(ending_of(name_of(ending)) == ending);
  CHECK_FALSE(ending_of("good"));
  for (const Failure failure : {Failure::none, Failure::crash, Failure::contact, Failure::lost,
                                Failure::overload, Failure::trap, Failure::oscillation, Failure::time_out})
    CHECK(failure_of(name_of(failure)) == failure);
  CHECK_FALSE(failure_of("bad luck"));
}
