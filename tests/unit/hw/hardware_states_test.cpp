// SPDX-License-Identifier: GPL-3.0-or-later
// The state machine of a hardware container, each state with each event.
#include <catch2/catch.hpp>

#include <vector>

#include "hardware_states.hpp"

using namespace orca;
using namespace orca::hw;
using State = HardwareState;
using HardwareChange = HardwareEvent;
using Action = HardwareAction;
using Actions = std::vector<Action>;

namespace {

// A cell of the specification: where the event leads and by which actions, or why it leads nowhere.
struct Cell {
  State to{};
  Actions actions;
  EventKind without_row = EventKind::circumstance;
  bool leads = true;
};

Cell leads(State to, Actions actions) { return {to, std::move(actions)}; }
Cell nowhere(EventKind kind) { return {State::closed, {}, kind, false}; }
Cell ignored() { return nowhere(EventKind::circumstance); }
Cell refused() { return nowhere(EventKind::order); }
Cell impossible() { return nowhere(EventKind::outcome); }

const Actions kFault = {Action::halt, Action::forget, Action::enter};
const Actions kFaultWhileActive = {Action::halt, Action::try_stop, Action::forget, Action::enter};
const Actions kActionsOfStop = {Action::halt, Action::stand, Action::stop, Action::forget, Action::enter};

// By state, then by event: wanted, unwanted, may_recover, retry, shut_down, run, begun, answered, unanswered, failed,
// failed_again.
std::vector<std::vector<Cell>> specification() {
  const Cell _ = ignored();
  const Cell no = refused();
  const Cell never = impossible();
  const Cell opens = leads(State::opening, {Action::enter});
  const Cell opened = leads(State::opening, {Action::open, Action::probe});
  const Cell is_ready = leads(State::ready, {Action::enter});
  const Cell probes = leads(State::probing, {Action::enter});
  const Cell probes_on = leads(State::probing, {});
  const Cell starts = leads(State::active, {Action::halt, Action::start, Action::enter});
  const Cell stops = leads(State::ready, kActionsOfStop);
  const Cell closes = leads(State::closed, {Action::close, Action::enter});
  const Cell is_closed = leads(State::closed, {Action::enter});
  const Cell fails = leads(State::fault, kFault);
  const Cell fails_active = leads(State::fault, kFaultWhileActive);
  const Cell stays_failed = leads(State::fault, {});
  const Cell last_close = leads(State::fault, {Action::close});
  const Cell backs_off = leads(State::backoff, {Action::enter, Action::close});
  const Cell stays_back = leads(State::backoff, {});
  return {
      /*closed */ {_, _, _, _, _, opens, never, never, never, never, never},
      /*opening*/ {_, _, _, _, closes, no, opened, is_ready, probes, fails, backs_off},
      /*probing*/ {_, _, _, _, closes, no, never, is_ready, probes_on, fails, backs_off},
      /*ready  */ {starts, _, _, _, closes, no, never, never, never, fails, never},
      /*active */ {_, stops, _, _, _, no, never, never, never, fails_active, never},
      /*fault  */ {_, _, backs_off, _, last_close, no, never, never, never, stays_failed, stays_failed},
      /*backoff*/ {_, _, _, opens, is_closed, no, never, never, never, stays_back, stays_back},
  };
}

}  // namespace

TEST_CASE("each event leads a container from each state to where the specification says", "[hw][states]") {
  const auto cells = specification();
  REQUIRE(cells.size() == kHardwareStates);
  for (std::size_t state = 0; state < kHardwareStates; ++state) {
    REQUIRE(cells[state].size() == kHardwareEvents);
    for (std::size_t event = 0; event < kHardwareEvents; ++event) {
      CAPTURE(to_string(static_cast<State>(state)), event);
      const Cell& expected = cells[state][event];
      const HardwareTransition* const row =
          transition(static_cast<State>(state), static_cast<HardwareChange>(event));
      REQUIRE((row != nullptr) == expected.leads);
      if (row == nullptr) {
        CHECK(kind_of(static_cast<HardwareChange>(event)) == expected.without_row);
      } else {
        CHECK(row->to == expected.to);
        CHECK(Actions(row->actions.begin(), row->actions.end()) == expected.actions);
      }
    }
  }
}

TEST_CASE("a container leaves Active only after the motors were commanded to stand", "[hw][states]") {
  for (const HardwareTransition& row : hardware_transitions()) {
    if (row.from != State::active) continue;
    const Actions actions(row.actions.begin(), row.actions.end());
    CHECK(actions.at(0) == Action::halt);
    CHECK((actions.at(1) == Action::stand || actions.at(1) == Action::try_stop));
  }
}

TEST_CASE("out of Fault leads only the way through Backoff, in which nothing moves", "[hw][states]") {
  for (const HardwareTransition& row : hardware_transitions()) {
    if (row.from == State::fault) CHECK((row.to == State::fault || row.to == State::backoff));
    if (row.from == State::backoff) CHECK(row.to != State::active);
  }
}
