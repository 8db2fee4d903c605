// SPDX-License-Identifier: LGPL-3.0-or-later
// The processes and machines on which the parts of a graph run, and what happens when one of them is lost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/time.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::graph {

/// The process of parts that name none. It exists without a declaration.
inline constexpr const char* kMainProcess = "main";

/// The cases in which a process is started again after its end.
enum class Restart {
  permanent,  ///< However it ended.
  transient,  ///< Only after a fault: a signal, an exit status other than 0, a hang.
  temporary,  ///< Never.
};

/// The processes that are started again when one of them has failed.
enum class Strategy {
  one_for_one,   ///< That one alone.
  rest_for_one,  ///< That one and those after it in the order of processes_of().
  one_for_all,   ///< All of them.
};

/// The reaction to the loss of something that the system can do without, or not.
enum class OnLoss {
  stop,   ///< The robot stops and the run ends.
  go_on,  ///< What is left goes on.
};

[[nodiscard]] constexpr const char* to_string(Restart restart) {
  switch (restart) {
    case Restart::permanent: return "permanent";
    case Restart::transient: return "transient";
    case Restart::temporary: return "temporary";
  }
  return "?";
}
[[nodiscard]] constexpr const char* to_string(Strategy strategy) {
  switch (strategy) {
    case Strategy::one_for_one: return "one_for_one";
    case Strategy::rest_for_one: return "rest_for_one";
    case Strategy::one_for_all: return "one_for_all";
  }
  return "?";
}

/// A value that does not count when parts of a graph are compared.
template <class Value>
struct Uncompared : Value {
  Uncompared() = default;
  Uncompared(Value value) : Value(std::move(value)) {}
  friend bool operator==(const Uncompared&, const Uncompared&) { return true; }
};
using Place = Uncompared<xml::Position>;  ///< Of the element from which a part was read.

/// A host process of the system. In virtual time all parts run in one process, which takes notice of its cores and delay only.
struct ProcessNode {
  std::string name{};
  std::string machine{};               ///< Name of a MachineNode; empty: the graph declares no machines.
  Backend executor = Backend::thread;  ///< Thread or fiber.
  Duration spin{0};  ///< Longest time [s] that an idle strand spins before it sleeps; 0: it sleeps at once.
  std::uint32_t cores = 0;        ///< Laps that compute at once in virtual time; 0: any number.
  Duration delay{0};              ///< Time [s] that objects to or from other processes take in virtual time.
  std::vector<int> processors{};  ///< Numbers of the processors that it may use; empty: all.
  std::optional<int> priority{};  ///< SCHED_FIFO priority, 1 to 99; nothing: not real-time.
  bool lock_memory = false;       ///< Its memory is never paged out.
  std::optional<std::uint64_t> memory{};  ///< Most memory that it may have [byte]; nothing: no limit.
  Restart restart = Restart::permanent;
  bool on_demand = false;  ///< Started when something in it is needed.
  Duration idle_time{0};   ///< Time [s] without use after which an on-demand one ends; 0: it stays.
  Duration hang_limit{std::chrono::milliseconds(500)};  ///< Silence [s] after which it counts as hung.
  Place position{};

  friend bool operator==(const ProcessNode&, const ProcessNode&) = default;
};

/// A computer of the system.
struct MachineNode {
  std::string name{};
  std::string address{};          ///< IP address or host name; empty: found on its own.
  std::string interface {};       ///< Network interface for links to other machines, "wlan0"; empty: any.
  OnLoss on_loss = OnLoss::stop;  ///< What the other machines do when this one goes away.
  Duration loss_limit{std::chrono::seconds(1)};  ///< Silence [s] after which it counts as gone.
  Duration delay{0};  ///< Time [s] that objects to or from other machines take in virtual time.
  Place position{};

  friend bool operator==(const MachineNode&, const MachineNode&) = default;
};

/// The rules by which processes are started again.
struct Supervision {
  Strategy strategy = Strategy::one_for_one;
  int restarts = 3;                           ///< More restarts than these within `within` end the run.
  Duration within{std::chrono::seconds(10)};  ///< [s]
  OnLoss on_supervisor_loss = OnLoss::stop;   ///< What the processes do when their supervisor is gone.
  Duration machine_wait{
      std::chrono::seconds(60)};  ///< Longest time [s] to wait for all machines at the start.

  /// Longest time [s] that they go on without one, if that is what they do; 0: no limit.
  Duration adoption_wait{0};

  friend bool operator==(const Supervision&, const Supervision&) = default;
};

}  // namespace orca::graph
