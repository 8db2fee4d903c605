// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "control/trial/questioner.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/host/shadow.hpp"
#include "orca/plugin/image.hpp"

namespace orca::supervisor {

/// A line from the host process of a component, which tells what reaches a port of it.
struct WatchedPort {
  std::string port;  ///< Its name in the graph.
  Descriptor line;   ///< As an operator's line: see orca/supervisor/control.hpp.
};

/// The trial of new code for a component before it is exchanged: for a while it watches what reaches the component, then it
/// lets the new code work on that in a copy of the supervisor's process (host::run_in_shadow()). The component's own process
/// only hands out what it would show to an operator as well, and the servers that the new code asks answer as they would answer an
/// operator.
///
/// Thread contract: made, asked and destroyed by one thread. The trial has a thread of its own.
class Tryout {
 public:
  /// What leads to the system's processes.
  struct Lines {
    std::vector<WatchedPort> ports;   ///< Of the component: all that it is to be tried with.
    std::vector<ServerLine> servers;  ///< Of the component: those that can be asked.
  };
  /// @param done  called once on the trial's thread when the outcome is there.
  Tryout(host::ShadowOrder order, plugin::PluginImage plugin, Lines lines, std::function<void()> done);
  /// Gives the trial up.
  ~Tryout();
  Tryout(const Tryout&) = delete;
  Tryout& operator=(const Tryout&) = delete;

  [[nodiscard]] const host::ShadowOrder& order() const { return order_; }
  [[nodiscard]] bool is_done() const { return done_.load(std::memory_order_acquire); }
  /// Returns what came of it. @pre  is_done().
  [[nodiscard]] const Result<host::ShadowReport>& outcome() const { return *outcome_; }
  /// Returns the plugin that was tried. @pre  is_done().
  [[nodiscard]] plugin::PluginImage take_plugin() { return std::move(plugin_); }

 private:
  void work(Lines lines);
  [[nodiscard]] std::vector<host::SeenObject> watch(std::vector<WatchedPort> ports) const;

  host::ShadowOrder order_;
  plugin::PluginImage plugin_;
  const std::function<void()> tell_;
  std::optional<Result<host::ShadowReport>> outcome_;
  std::atomic<bool> done_{false};
  std::atomic<bool> given_up_{false};
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace orca::supervisor
