// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "orca/base/doorbell.hpp"
#include "orca/base/executive.hpp"
#include "orca/host/kept_state.hpp"
#include "orca/host/peer_call.hpp"
#include "orca/host/planned_failure.hpp"
#include "orca/patterns/endpoints/cores.hpp"
#include "orca/patterns/endpoints/courier.hpp"
#include "reporter.hpp"
#include "run/recording/trace.hpp"

namespace orca::host {

/// What of a simulated robot is to be kept for the end of the run.
struct SceneWishes {
  bool moments = false;  ///< For a picture.
  bool motion = false;   ///< For measures.
};

/// The surroundings that all instances of one run share.
struct RunContext {
  Executive& executive;
  Trace& trace;
  /// Takes whatever people and programs outside are to know.
  Reporter& reporter;
  std::uint64_t seed;
  /// Called whenever an instance has changed its state, on any strand.
  std::function<void()> changed;
  /// Number of missions begun so far; the last one has it as its id.
  std::atomic<std::uint64_t>& missions;
  SceneWishes scene{};
  /// What is to fail on purpose.
  std::vector<PlannedFailure> failures{};
  /// Returns the word by which other processes wake a component; empty: there are no others.
  std::function<DoorbellWord*(const std::string& component)> doorbell{};
  /// Keeps states for the case that the process is lost; empty: nobody does. Called on the component's strand.
  StateSink state_sink{};
  /// With what components that are there from the start begin.
  KeptStates states{};
  /// In virtual time laps take this many times as long as the graph says.
  double computing = 1.0;
  /// Whether the processor time of each component's laps is measured.
  bool measures_laps = false;
  /// The same in all processes of a run, and in no other run; empty: there is this process only.
  std::string run{};
  /// Cores on which laps compute in virtual time, by process; only of processes whose graph numbers them.
  std::map<std::string, Cores> cores{};
  /// Carries what is under way between components in virtual time.
  Courier courier{executive};
  /// For whom components are suspended, in a run whose components are all in this process. Main task only.
  PeerPauses peer_pauses{};
};

}  // namespace orca::host
