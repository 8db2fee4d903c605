// SPDX-License-Identifier: GPL-3.0-or-later
// The answers that a client waits for: each id gets its own, in whatever order they come and are taken.
#include "orca/patterns/endpoints/pending_answers.hpp"

#include <catch2/catch.hpp>

#include <string>

using namespace orca;

namespace {

using Pending = PendingAnswers<std::string>;
using State = Pending::State;

}  // namespace

TEST_CASE("ids are counted from 1, so that 0 can mean none", "[patterns][pending]") {
  Pending pending;
  CHECK(pending.add() == 1);
  CHECK(pending.add() == 2);
}

TEST_CASE("an answer is waited for, there, taken once, and then unknown", "[patterns][pending]") {
  Pending pending;
  CHECK(pending.state(1) == State::unknown);
  const auto id = pending.add();
  CHECK(pending.state(id) == State::waiting);
  CHECK_FALSE(pending.take(id));
  CHECK(pending.state(id) == State::waiting);
  CHECK(pending.answer(id, "yes"));
  CHECK(pending.state(id) == State::answered);
  CHECK(pending.take(id) == "yes");
  CHECK(pending.state(id) == State::unknown);
  CHECK_FALSE(pending.take(id));
}

TEST_CASE("an answer that nobody waits for is refused", "[patterns][pending]") {
  Pending pending;
  const auto id = pending.add();
  CHECK_FALSE(pending.answer(id + 1, "to nobody"));
  pending.forget(id);
  CHECK_FALSE(pending.answer(id, "too late"));
  pending.forget(id);  // again changes nothing
  CHECK(pending.add() == id + 1);
}

TEST_CASE("the first answer stands", "[patterns][pending]") {
  Pending pending;
  const auto id = pending.add();
  CHECK(pending.answer(id, "first"));
  CHECK_FALSE(pending.answer(id, "second"));
  CHECK(pending.take(id) == "first");
}

TEST_CASE("whichever of three is taken or forgotten, the others keep their answers", "[patterns][pending]") {
  for (std::uint64_t gone = 1; gone <= 3; ++gone) {
    for (const bool forgotten : {false, true}) {
      CAPTURE(gone, forgotten);
      Pending pending;
      for (std::uint64_t id = 1; id <= 3; ++id) {
        REQUIRE(pending.add() == id);
        REQUIRE(pending.answer(id, std::to_string(id)));
      }
      if (forgotten) {
        pending.forget(gone);
      } else {
        CHECK(pending.take(gone) == std::to_string(gone));
      }
      for (std::uint64_t id = 1; id <= 3; ++id) {
        CAPTURE(id);
        CHECK(pending.state(id) == (id == gone ? State::unknown : State::answered));
        if (id != gone) CHECK(pending.take(id) == std::to_string(id));
      }
    }
  }
}
