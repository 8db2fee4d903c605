// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hardware_states.hpp"

namespace orca::hw {
namespace {

using State = HardwareState;
using Event = HardwareEvent;
using Action = HardwareAction;
using Actions = ActionList<Action>;

constexpr Actions kFailAtRest = {Action::halt, Action::forget, Action::enter};

constexpr auto kRows = std::to_array<HardwareTransition>({
    {State::closed, Event::run, State::opening, {Action::enter}},
    {State::opening, Event::begun, State::opening, {Action::open, Action::probe}},
    {State::opening, Event::answered, State::ready, {Action::enter}},
    {State::opening, Event::unanswered, State::probing, {Action::enter}},
    {State::probing, Event::answered, State::ready, {Action::enter}},
    {State::probing, Event::unanswered, State::probing, {}},

    // A command of an earlier use must not move the base now.
    {State::ready, Event::wanted, State::active, {Action::halt, Action::start, Action::enter}},
    {State::active,
     Event::unwanted,
     State::ready,
     {Action::halt, Action::stand, Action::stop, Action::forget, Action::enter}},

    {State::opening, Event::failed, State::fault, kFailAtRest},
    {State::probing, Event::failed, State::fault, kFailAtRest},
    {State::ready, Event::failed, State::fault, kFailAtRest},
    {State::active,
     Event::failed,
     State::fault,
     {Action::halt, Action::try_stop, Action::forget, Action::enter}},
    // The first fault is the reason that people need.
    {State::fault, Event::failed, State::fault, {}},

    // The state comes first: whatever close() does, the device is opened again only after a while.
    {State::fault, Event::may_recover, State::backoff, {Action::enter, Action::close}},
    {State::opening, Event::failed_again, State::backoff, {Action::enter, Action::close}},
    {State::probing, Event::failed_again, State::backoff, {Action::enter, Action::close}},
    {State::fault, Event::failed_again, State::fault, {}},
    {State::backoff, Event::failed, State::backoff, {}},
    {State::backoff, Event::failed_again, State::backoff, {}},
    {State::backoff, Event::retry, State::opening, {Action::enter}},

    {State::opening, Event::shut_down, State::closed, {Action::close, Action::enter}},
    {State::probing, Event::shut_down, State::closed, {Action::close, Action::enter}},
    {State::backoff, Event::shut_down, State::closed, {Action::enter}},
    {State::ready, Event::shut_down, State::closed, {Action::close, Action::enter}},
    {State::fault, Event::shut_down, State::fault, {Action::close}},
});

constexpr StateTable<State, Event, Action, kHardwareStates, kHardwareEvents, kRows.size()> kTable{kRows};

}  // namespace

const HardwareTransition* transition(HardwareState state, HardwareEvent event) {
  return kTable.find(state, event);
}

std::span<const HardwareTransition> hardware_transitions() { return kTable.rows(); }

}  // namespace orca::hw
