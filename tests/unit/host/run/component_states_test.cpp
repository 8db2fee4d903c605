// SPDX-License-Identifier: GPL-3.0-or-later
// The state machine of a component, each state with each event. The table here is the specification, in its
// own words; docs/states.md is made from the runtime's table.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "run/component/parts/component_states.hpp"

using namespace orca;
using namespace orca::host;
using State = ComponentState;
using StateEvent = ComponentEvent;
using Action = ComponentAction;

namespace {

constexpr std::array<const char*, kComponentStates> kStateNames = {
    "unloaded", "init",   "idle",           "connect",        "work", "done",
    "failed",   "broken", "idle_suspended", "work_suspended", "exit"};

// Rows: states; columns: events; cells: the next state. "." changes nothing, "no" is refused, "!" cannot
// happen.
const std::string kSpecification = R"(
                asked_for wanted  unwanted unused   replaced exit suspend        resume loaded configured started interrupted done failed threw  stop_threw
unloaded        init      .       .        .        .        exit no             no     !      !          !       !           !    !      !      !
init            .         .       .        .        .        .    no             no     init   idle       !       exit        !    broken broken  !
idle            .         connect .        unloaded .        exit idle_suspended no     !      !          !       !           !    !      broken  !
connect         .         .       .        .        .        .    no             no     !      !          work    idle        !    failed broken  broken
work            .         .       idle     .        .        idle work_suspended no     !      !          !       !           done failed broken  broken
done            .         .       idle     .        .        exit no             no     !      !          !       !           !    !      broken  !
failed          .         .       idle     .        idle     exit no             no     !      !          !       !           !    !      broken  !
broken          .         .       .        .        idle     exit no             no     !      !          !       !           !    !      broken  !
idle_suspended  .         .       .        .        .        idle no             idle   !      !          !       !           !    !      broken  !
work_suspended  .         .       .        .        .        work no             work   !      !          !       !           !    !      broken  !
exit            .         .       .        .        .        .    no             no     !      !          !       !           !    !      !      !
)";

std::string found(State state, StateEvent event) {
  if (const ComponentTransition* const row = transition(state, event))
    return kStateNames[static_cast<std::size_t>(row->to)];
  switch (kind_of(event)) {
    case EventKind::circumstance: return ".";
    case EventKind::order: return "no";
    case EventKind::outcome: return "!";
  }
  return "?";
}

// Returns the place of an action in a row; the number of actions if it is not there.
std::ptrdiff_t place(const ComponentTransition& row, Action action) {
  return std::find(row.actions.begin(), row.actions.end(), action) - row.actions.begin();
}
bool has(const ComponentTransition& row, Action action) {
  return std::find(row.actions.begin(), row.actions.end(), action) != row.actions.end();
}

// The states in which the component has been started and is subscribed to its own providers.
bool is_up(State state) {
  return state == State::connect || state == State::work || state == State::suspended_work;
}

template <class Check>
void for_each_row(const Check& check) {
  for (const ComponentTransition& row : component_transitions()) {
    CAPTURE(kStateNames[static_cast<std::size_t>(row.from)], static_cast<int>(row.event));
    check(row);
  }
}

}  // namespace

TEST_CASE("each event leads from each state to where the specification says", "[host][states]") {
  std::istringstream lines(kSpecification);
  std::vector<std::string> events;
  std::size_t states = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string state, cell;
    if (events.empty()) {
      while (cells >> cell) events.push_back(cell);
      continue;
    }
    cells >> state;
    REQUIRE(state == kStateNames.at(states));
    for (std::size_t event = 0; event < events.size(); ++event) {
      CAPTURE(state, events[event]);
      REQUIRE(cells >> cell);
      CHECK(found(static_cast<State>(states), static_cast<StateEvent>(event)) == cell);
    }
    CHECK_FALSE(cells >> cell);
    ++states;
  }
  CHECK(states == kComponentStates);
  CHECK(events.size() == kComponentEvents);
}

TEST_CASE("a row that leads to another state enters it once, and only configuring stays where it is",
          "[host][states]") {
  for_each_row([](const ComponentTransition& row) {
    const auto entries = std::count(row.actions.begin(), row.actions.end(), Action::enter);
    CHECK(entries == (row.from == State::init && row.event == StateEvent::loaded ? 0 : 1));
  });
}

TEST_CASE("a component subscribes to its providers when it is to start, and before start() is called",
          "[host][states]") {
  for_each_row([](const ComponentTransition& row) {
    const bool starts = !is_up(row.from) && is_up(row.to);
    CHECK(has(row, Action::subscribe) == starts);
    CHECK(has(row, Action::start) == starts);
    if (starts) CHECK(place(row, Action::enter) < place(row, Action::subscribe));
    if (starts) CHECK(place(row, Action::subscribe) < place(row, Action::start));
  });
}

TEST_CASE("a component that was started is stopped before its providers are let go", "[host][states]") {
  for_each_row([](const ComponentTransition& row) {
    const bool at_work = row.from == State::connect || row.from == State::work;
    if (!at_work || is_up(row.to) || row.event == StateEvent::stop_threw) return;
    const auto stop = std::min(place(row, Action::stop), place(row, Action::try_stop));
    CHECK(stop < place(row, Action::unsubscribe));
    CHECK(place(row, Action::unsubscribe) < place(row, Action::enter));
  });
}

TEST_CASE("a component fails even if stop() throws, which is not called again", "[host][states]") {
  for_each_row([](const ComponentTransition& row) {
    CHECK(has(row, Action::stop) == (is_up(row.from) && !is_up(row.to) && !is_failed(row.to)));
    if (!has(row, Action::stop)) return;
    const ComponentTransition* const next = transition(row.from, StateEvent::stop_threw);
    REQUIRE(next != nullptr);
    CHECK(is_failed(next->to));
    CHECK_FALSE(has(*next, Action::stop));
    CHECK_FALSE(has(*next, Action::try_stop));
    CHECK(has(*next, Action::unsubscribe));
  });
}

TEST_CASE("a failed component refuses objects and queries, and accepts them again afterwards",
          "[host][states]") {
  for_each_row([](const ComponentTransition& row) {
    CHECK(has(row, Action::close_intake) == is_failed(row.to));
    const bool comes_up = row.to == State::idle && (row.from == State::init || is_failed(row.from));
    CHECK(has(row, Action::open_intake) == comes_up);
    CHECK(has(row, Action::end) == (row.to == State::exit));
    // A handler may subscribe to something, also in IDLE.
    if (row.to == State::exit && takes_intake(row.from)) CHECK(has(row, Action::unsubscribe));
  });
}

TEST_CASE("a pause calls suspend() and resume(), and leaves subscriptions and intake as they are",
          "[host][states]") {
  for_each_row([](const ComponentTransition& row) {
    CHECK(has(row, Action::suspend) == is_suspended(row.to));
    CHECK(has(row, Action::resume) == (row.event == StateEvent::resume));
    if (!is_suspended(row.to) && row.event != StateEvent::resume) return;
    for (const Action action : {Action::subscribe, Action::unsubscribe, Action::open_intake,
                                Action::hold_intake, Action::close_intake, Action::start, Action::stop})
      CHECK_FALSE(has(row, action));
  });
}

TEST_CASE("objects and queries to a component are held before its code is unloaded", "[host][states]") {
  for_each_row([](const ComponentTransition& row) {
    CHECK(has(row, Action::unload) == (row.to == State::unloaded));
    if (row.to == State::unloaded) CHECK(place(row, Action::hold_intake) < place(row, Action::unload));
  });
}

TEST_CASE("laps begin anew when a component starts and after a pause", "[host][states]") {
  for_each_row([](const ComponentTransition& row) {
    const bool goes_on = row.to == State::work && row.event != StateEvent::exit;
    CHECK(has(row, Action::begin_laps) == goes_on);
  });
}

TEST_CASE("the end of the system leads from each state in which a strand can rest to EXIT",
          "[host][states]") {
  for (std::size_t i = 0; i < kComponentStates; ++i) {
    State state = static_cast<State>(i);
    if (state == State::init || state == State::connect) continue;  // they end by themselves first
    CAPTURE(kStateNames.at(i));
    for (int steps = 0; state != State::exit && steps < 3; ++steps) {
      const ComponentTransition* const row = transition(state, StateEvent::exit);
      REQUIRE(row != nullptr);
      state = row->to;
    }
    CHECK(state == State::exit);
  }
}

TEST_CASE("each state can be reached, from UNLOADED and from INIT", "[host][states]") {
  for (const State first : {State::unloaded, State::init}) {
    std::set<State> reached{first};
    for (std::size_t round = 0; round < kComponentStates; ++round)
      for (const ComponentTransition& row : component_transitions())
        if (reached.contains(row.from)) reached.insert(row.to);
    CHECK(reached.size() == kComponentStates);
  }
}

TEST_CASE("states are shown by the names of the thesis, whatever happened before", "[host][states]") {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kComponentStates; ++i) names.emplace_back(to_string(static_cast<State>(i)));
  CHECK(names == std::vector<std::string>{"UNLOADED", "INIT", "IDLE", "CONNECT", "WORK", "WORK_DONE",
                                          "WORK_FAILED", "WORK_FAILED", "SUSPENDED", "SUSPENDED", "EXIT"});
}
