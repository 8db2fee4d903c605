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

// By state, then by event: wanted, unwanted, shut_down, run, begun, failed.
std::vector<std::vector<Cell>> specification() {
  const Cell opens = leads(State::opening, {Action::enter});
  const Cell opened = leads(State::ready, {Action::open, Action::enter});
  const Cell starts = leads(State::active, {Action::halt, Action::start, Action::enter});
  const Cell stops = leads(State::ready, kActionsOfStop);
  const Cell closes = leads(State::closed, {Action::close, Action::enter});
  const Cell fails = leads(State::fault, kFault);
  return {
      /*closed */ {ignored(), ignored(), ignored(), opens, impossible(), impossible()},
      /*opening*/ {ignored(), ignored(), ignored(), refused(), opened, fails},
      /*ready  */ {starts, ignored(), closes, refused(), impossible(), fails},
      /*active */
      {ignored(), stops, ignored(), refused(), impossible(), leads(State::fault, kFaultWhileActive)},
      /*fault  */
      {ignored(), ignored(), leads(State::fault, {Action::close}), refused(), impossible(),
       leads(State::fault, {})},
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

TEST_CASE("nothing leads out of Fault", "[hw][states]") {
  for (const HardwareTransition& row : hardware_transitions())
    if (row.from == State::fault) CHECK(row.to == State::fault);
}
