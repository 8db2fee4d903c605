// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "exchange.hpp"
#include "run/system/system.hpp"

namespace orca::host {

/// The swaps of a system's components and drivers.
///
/// Thread contract: one task, the executive's main task.
class Swaps {
 public:
  /// Takes the outcome of a swap, on the main task.
  using Done = std::function<void(const Result<SwapReport>&)>;

  /// @param graph  with all connections of the components, to whichever process. Outlives the object, as all else does.
  /// @param stand_still  ends the process because of a component that hangs in an exchange; empty: nobody does.
  Swaps(const graph::Graph& graph, RunContext& run, PluginCatalogue& catalogue, System& system,
        Standstill stand_still = {})
      : graph_(graph),
        run_(run),
        catalogue_(catalogue),
        system_(system),
        stand_still_(std::move(stand_still)) {}
  ~Swaps();
  Swaps(const Swaps&) = delete;
  Swaps& operator=(const Swaps&) = delete;

  /// Begins to exchange the code of a component, or the driver of a hardware element if that has the name.
  /// @errors  go to `done`, as the report does: not_found; unavailable while another swap of it is under way; those
  ///          of Swap or DriverSwap.
  void begin(SwapOrder order, Done done);

  /// Goes on with all swaps as far as possible. To be called whenever a component has changed, and at the time that it
  /// returns.
  /// @return kForever if nothing is to be done by then.
  TimePoint go_on();

  /// Returns whether the code of a component, or a driver, is being exchanged.
  [[nodiscard]] bool is_under_way(const std::string& name) const;
  /// Forgets what a component has run that is not there any more.
  void forget(const std::string& component) { types_.erase(component); }

  /// Returns whether a driver is being exchanged.
  [[nodiscard]] bool concern_drivers() const;

  /// Ends all swaps as they are. @pre  the system has been taken down.
  void give_up();

 private:
  struct Open {
    std::unique_ptr<Exchange> swap;
    Done done;
  };

  Result<std::unique_ptr<Exchange>> make(SwapOrder order);
  [[nodiscard]] std::string type_of(const std::string& name, const std::string& in_graph) const;
  void conclude(Open& open, const Result<SwapReport>& outcome);

  const graph::Graph& graph_;
  RunContext& run_;
  PluginCatalogue& catalogue_;
  System& system_;
  const Standstill stand_still_;
  std::vector<Open> open_;
  std::map<std::string, std::string> types_;  // of what was exchanged, by its name
};

}  // namespace orca::host
