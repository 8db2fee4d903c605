// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_states.hpp"

namespace orca::host {
namespace {

using State = ComponentState;
using Event = ComponentEvent;
using Action = ComponentAction;
using Actions = ActionList<Action>;

constexpr Actions kEnter = {Action::enter};
constexpr Actions kLeaveWork = {Action::stop, Action::unsubscribe, Action::enter};
constexpr Actions kFailAtRest = {Action::unsubscribe, Action::close_intake, Action::enter};
constexpr Actions kFailAtWork = {Action::try_stop, Action::unsubscribe, Action::close_intake, Action::enter};
constexpr Actions kEnd = {Action::end, Action::enter};
// A handler may have subscribed to something.
constexpr Actions kEndAtRest = {Action::unsubscribe, Action::end, Action::enter};

constexpr auto kRows = std::to_array<ComponentTransition>({
    // Coming up.
    {State::unloaded, Event::asked_for, State::init, {Action::enter, Action::load}},
    {State::init, Event::loaded, State::init, {Action::configure}},
    {State::init, Event::configured, State::idle, {Action::open_intake, Action::enter}},

    // Thesis Fig. 9.1.
    {State::idle, Event::wanted, State::connect, {Action::enter, Action::subscribe, Action::start}},
    {State::connect, Event::started, State::work, {Action::begin_laps, Action::enter}},
    {State::connect, Event::interrupted, State::idle, kLeaveWork},
    {State::work, Event::unwanted, State::idle, kLeaveWork},
    {State::work, Event::done, State::work_done, kLeaveWork},
    {State::work_done, Event::unwanted, State::idle, kEnter},
    {State::connect, Event::failed, State::work_failed, kFailAtWork},
    {State::work, Event::failed, State::work_failed, kFailAtWork},
    {State::work_failed, Event::unwanted, State::idle, {Action::open_intake, Action::enter}},

    // An operator's pause.
    {State::idle, Event::suspend, State::suspended_idle, {Action::suspend, Action::enter}},
    {State::work, Event::suspend, State::suspended_work, {Action::suspend, Action::enter}},
    {State::suspended_idle, Event::resume, State::idle, {Action::enter, Action::resume}},
    {State::suspended_work, Event::resume, State::work, {Action::enter, Action::begin_laps, Action::resume}},

    // A new object for one that has failed.
    {State::work_failed, Event::replaced, State::idle, {Action::open_intake, Action::enter}},
    {State::broken, Event::replaced, State::idle, {Action::open_intake, Action::enter}},

    // Loaded on demand.
    {State::idle, Event::unused, State::unloaded, {Action::hold_intake, Action::unload, Action::enter}},

    // Failures.
    {State::init, Event::failed, State::broken, kFailAtRest},
    {State::init, Event::threw, State::broken, kFailAtRest},
    {State::idle, Event::threw, State::broken, kFailAtRest},
    {State::connect, Event::threw, State::broken, kFailAtWork},
    {State::work, Event::threw, State::broken, kFailAtWork},
    {State::connect, Event::stop_threw, State::broken, kFailAtRest},
    {State::work, Event::stop_threw, State::broken, kFailAtRest},
    {State::work_done, Event::threw, State::broken, kFailAtRest},
    {State::work_failed, Event::threw, State::broken, kFailAtRest},
    {State::suspended_idle, Event::threw, State::broken, kFailAtRest},
    {State::suspended_work, Event::threw, State::broken, kFailAtRest},
    {State::broken, Event::threw, State::broken, kFailAtRest},

    // The end. CONNECT ends by itself first, and INIT by itself or at once.
    {State::init, Event::interrupted, State::exit, kEnd},
    {State::suspended_idle, Event::exit, State::idle, kEnter},
    {State::suspended_work, Event::exit, State::work, kEnter},
    {State::work, Event::exit, State::idle, kLeaveWork},
    {State::unloaded, Event::exit, State::exit, kEnd},
    {State::idle, Event::exit, State::exit, kEndAtRest},
    {State::work_done, Event::exit, State::exit, kEndAtRest},
    {State::work_failed, Event::exit, State::exit, kEnd},
    {State::broken, Event::exit, State::exit, kEnd},
});

constexpr StateTable<State, Event, Action, kComponentStates, kComponentEvents, kRows.size()> kTable{kRows};

}  // namespace

const ComponentTransition* transition(ComponentState state, ComponentEvent event) {
  return kTable.find(state, event);
}

std::span<const ComponentTransition> component_transitions() { return kTable.rows(); }

const char* to_string(ComponentState state) {
  switch (state) {
    case State::unloaded: return "UNLOADED";
    case State::init: return "INIT";
    case State::idle: return "IDLE";
    case State::connect: return "CONNECT";
    case State::work: return "WORK";
    case State::work_done: return "WORK_DONE";
    case State::work_failed:
    case State::broken: return "WORK_FAILED";
    case State::suspended_idle:
    case State::suspended_work: return "SUSPENDED";
    case State::exit: return "EXIT";
  }
  return "?";
}

}  // namespace orca::host
