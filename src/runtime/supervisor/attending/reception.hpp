// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "members/poller.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/system/pace.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// The supervisor of a run that conducts itself: it keeps the ledger, and serves those at the system's socket. Its only
/// member is the process that it is in itself.
///
/// Thread contract: run() on a thread of its own, the rest from any.
class Reception {
 public:
  /// Where it hears of others.
  struct Doors {
    ControlSocket socket;
    Descriptor channel;  ///< To the desk of the run.
  };

  /// @param graph  with all parts in one process; outlives the object, as all else does.
  Reception(const graph::Graph& graph, const SystemFacts& facts, Pace& pace, std::string log_name,
            Doors doors)
      : graph_(graph), facts_(facts), pace_(pace), log_name_(std::move(log_name)), doors_(std::move(doors)) {}

  /// Serves until end().
  /// @param open  calls a function that opens descriptors of the runtime.
  /// @errors  throws std::system_error if the system gives no more memory or descriptors.
  void run(const std::function<void(const std::function<void()>&)>& open);
  /// Notes that all components may work.
  void note_up() {
    is_up_ = true;
    poller_.wake();
  }
  void end() {
    ends_ = true;
    poller_.wake();
  }

 private:
  class Desk;

  const graph::Graph& graph_;
  const SystemFacts& facts_;
  Pace& pace_;
  const std::string log_name_;
  Doors doors_;
  Poller poller_;
  std::atomic<bool> is_up_{false};
  std::atomic<bool> ends_{false};
};

}  // namespace orca::supervisor
