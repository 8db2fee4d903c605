// SPDX-License-Identifier: GPL-3.0-or-later
// docs/states.md is made here, from the tables that the runtime follows. To bring it up to date, run this test
// with ORCA_APPROVE=1 in the environment and read the difference in git.
#include <catch2/catch.hpp>

#include "approval.hpp"
#include "hardware_states.hpp"
#include "run/component/parts/component_states.hpp"

using namespace orca;

namespace {

struct Name {
  std::string name;
  std::string meaning;
};
using NameList = std::vector<Name>;  // by the number of the enumerator

const NameList kComponentStateNames = {
    {"UNLOADED",
     "Its code is not in memory: nobody has asked for it, or not for a while. Only with `on_demand`."},
    {"INIT", "It is being loaded and configured. In the thesis: the constructor."},
    {"IDLE", "It is ready, and nobody needs it."},
    {"CONNECT", "It is subscribing to its own providers and starting."},
    {"WORK", "It works, lap by lap."},
    {"WORK_DONE", "Its task is done, and a client is still there."},
    {"WORK_FAILED", "It has reported a failure. It may try again after its last client has gone."},
    {"WORK_FAILED (broken)", "It threw, or it could not be configured. It stays so."},
    {"SUSPENDED (idle)", "An operator has paused it while it was IDLE."},
    {"SUSPENDED (work)", "An operator has paused it while it was at WORK."},
    {"EXIT", "Its strand ends. In the thesis: the destructor."}};

const NameList kComponentEventNames = {
    {"asked for", "There is a client, an object or a question for a component that is not loaded."},
    {"wanted", "It has a client, or it is to stay active."},
    {"not wanted", "It has no client, and it is not to stay active."},
    {"unused", "It is loaded on demand, and nobody has used it for its idle time."},
    {"replaced", "Another object has taken the place of the present one."},
    {"the end", "The system is being stopped."},
    {"suspend", "An operator asks for a pause."},
    {"resume", "An operator ends the pause."},
    {"loaded", "Its code is there, and it is constructed."},
    {"configured", "`configure()` has returned without an error."},
    {"started", "`start()` has returned without an error."},
    {"interrupted", "`configure()` or `start()` was made to return because the strand is to end."},
    {"done", "`work()` says that the task is done."},
    {"failed", "Loading or a hook reports a failure."},
    {"threw", "A hook other than `stop()`, or a handler, threw."},
    {"stop threw", "`stop()` threw. It is not called again."}};

const std::vector<std::string> kComponentActionNames = {"",
                                                        "load and construct",
                                                        "call `configure()`",
                                                        "take what is sent and asked",
                                                        "hold what is sent and asked",
                                                        "refuse what is sent and asked",
                                                        "subscribe to the providers",
                                                        "call `start()`",
                                                        "make the first lap due",
                                                        "call `stop()`",
                                                        "call `stop()`, whatever it throws",
                                                        "let the providers go",
                                                        "call `suspend()`",
                                                        "call `resume()`",
                                                        "destroy and unload",
                                                        "refuse orders and what is sent and asked"};

const NameList kHardwareStateNames = {
    {"Closed", "The device is not open."},
    {"Opening", "The container's strand runs and opens the device."},
    {"Probing", "The port is open; the driver finds out what is there, and waits for its answer."},
    {"Ready", "The device is open and polled; nobody uses it."},
    {"Active", "The device is started: readings come, and commands are carried out."},
    {"Fault", "The device or its driver has failed. It stays so, unless the device can be opened again."},
    {"Backoff", "The device has failed and is closed; it is opened again after a while."}};

const NameList kHardwareEventNames = {
    {"wanted", "Somebody uses the device."},
    {"not wanted", "Nobody uses it, or it is to be closed."},
    {"may recover", "The device has worked and failed, and hangs on something that can be plugged in again."},
    {"retry", "The pause is over: 0.5 s at first, then twice as long each time, at most 5 s."},
    {"the end", "The system is being stopped, or the driver exchanged, and the device is not used any more."},
    {"run", "The system comes up, or the driver is exchanged."},
    {"begun", "The container's strand is about to open the device."},
    {"answered", "The driver knows what is there."},
    {"unanswered", "It does not know it yet."},
    {"failed", "A function of the driver reports an error or throws, or the device is silent for too long."},
    {"failed again",
     "The same, for the same reason as before, and the device has not worked meanwhile: no news."}};

const std::vector<std::string> kHardwareActionNames = {
    "",
    "call `open()`",
    "call `probe()`",
    "call `start()`",
    "drop the last motion command",
    "`drive()` with speed 0",
    "call `stop()`",
    "`drive()` with speed 0 and call `stop()`, whatever they say",
    "drop the latest readings",
    "call `close()`"};

template <class Value>
std::size_t index_of(Value value) {
  return static_cast<std::size_t>(value);
}

std::string list_of(const NameList& names, const std::string& head) {
  std::string page = "| " + head + " | meaning |\n|---|---|\n";
  for (const Name& name : names) page += "| " + name.name + " | " + name.meaning + " |\n";
  return page;
}

template <class Event>
std::string events_of(const NameList& names) {
  const std::vector<std::string> kinds = {"circumstance", "order", "outcome"};
  std::string page = "| event | kind | meaning |\n|---|---|---|\n";
  for (std::size_t i = 0; i < names.size(); ++i)
    page += "| " + names[i].name + " | " + kinds.at(index_of(kind_of(static_cast<Event>(i)))) + " | " +
            names[i].meaning + " |\n";
  return page;
}

template <class Row>
std::string table_of(std::span<const Row> rows, const NameList& states, const NameList& events,
                     const std::vector<std::string>& actions) {
  std::string page = "| state | event | next state | what is done, in this order |\n|---|---|---|---|\n";
  for (const Row& row : rows) {
    page += "| " + states.at(index_of(row.from)).name + " | " + events.at(index_of(row.event)).name + " | " +
            states.at(index_of(row.to)).name + " | ";
    std::string steps;
    for (const auto action : row.actions) {
      const std::string step = index_of(action) == 0 ? "**" + states.at(index_of(row.to)).name + "**"
                                                     : actions.at(index_of(action));
      steps += (steps.empty() ? "" : ", ") + step;
    }
    page += (steps.empty() ? "nothing" : steps) + " |\n";
  }
  return page;
}

std::string components() {
  return R"(## Components

Names are those of the thesis. Traces and messages show what stands before the bracket.

)" + list_of(kComponentStateNames, "state") +
         "\n" + events_of<host::ComponentEvent>(kComponentEventNames) + R"(
A lap that is neither done nor failed is no event: the component stays at WORK, and its trigger says when the next lap is due.
Handlers run between two laps, in IDLE, WORK and WORK_DONE.

)" +
         table_of(host::component_transitions(), kComponentStateNames, kComponentEventNames,
                  kComponentActionNames);
}

std::string hardware() {
  return "\n## Hardware containers\n\n" + list_of(kHardwareStateNames, "state") + "\n" +
         events_of<hw::HardwareEvent>(kHardwareEventNames) + "\n" +
         table_of(hw::hardware_transitions(), kHardwareStateNames, kHardwareEventNames, kHardwareActionNames);
}

std::string page() {
  return R"(<!-- SPDX-License-Identifier: LGPL-3.0-or-later -->
# The states of components and hardware

Made from the tables that the runtime follows, `src/runtime/host/run/component/parts/component_states.cpp` and
`src/hw/api/hardware_states.cpp`, by `tests/unit/host/run/states_page_test.cpp`; do not edit it by hand. Thesis Fig. 9.1 is the
model of the first; [ADR 0007](adr/0007-state-machine.md) says where it differs and why.

Each row of a table says where an event leads from a state, and what is done on the way. The new state in **bold** is the point
at which others see it. An action may end in an event of its own: `start()` in *started*, any hook in
*threw* or *stop threw*. That event is taken
at once, in the state that holds then, and the rest of the row is left out.

An event without a row in a state leads nowhere: a circumstance changes nothing there, an order is refused, and an outcome cannot
happen.

)" + components() +
         hardware();
}

}  // namespace

TEST_CASE("docs/states.md is what the tables of the state machines say", "[host][states][docs]") {
  REQUIRE(kComponentStateNames.size() == host::kComponentStates);
  REQUIRE(kComponentEventNames.size() == host::kComponentEvents);
  REQUIRE(kHardwareStateNames.size() == hw::kHardwareStates);
  REQUIRE(kHardwareEventNames.size() == hw::kHardwareEvents);
  test::check_approved(std::filesystem::path(ORCA_SOURCE_DIR) / "docs/states.md", page());
}

TEST_CASE("the page's names of states begin with those that traces show", "[host][states][docs]") {
  for (std::size_t i = 0; i < host::kComponentStates; ++i) {
    const std::string shown = to_string(static_cast<host::ComponentState>(i));
    const std::string& name = kComponentStateNames[i].name;
    CHECK(name.substr(0, name.find(" (")) == shown);
  }
  for (std::size_t i = 0; i < hw::kHardwareStates; ++i)
    CHECK(kHardwareStateNames[i].name == to_string(static_cast<hw::HardwareState>(i)));
}
