// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/port_taps.hpp"
#include "orca/idl/object.hpp"
#include "outer_offers.hpp"
#include "run/system/system.hpp"

namespace orca::host {

/// The ports of a system as they are seen from outside: what passes them, and what they are offered.
///
/// Thread contract: any thread. It outlives the system's ports.
class OuterPorts {
 public:
  /// Returns whether a component is to be woken, because somebody looks at it.
  using Wakes = std::function<bool(const graph::PortRef& port)>;

  /// @param missions  number of missions begun so far; null: none are counted.
  OuterPorts(const Executive& executive, std::atomic<std::uint64_t>* missions)
      : taps_(executive), offers_(executive, missions) {}

  /// As PartAccess::tap().
  [[nodiscard]] Result<std::shared_ptr<PortTap>> tap(const System& system,
                                                     const std::vector<graph::PortRef>& ports,
                                                     const PortTap::Bounds& bounds, const Wakes& wakes);
  /// As PartAccess::offer().
  Status offer(const System& system, const graph::PortRef& port, ObjectLoan object,
               OuterOffers::Answered answered);

  [[nodiscard]] PortTaps& taps() { return taps_; }
  [[nodiscard]] OuterOffers& offers() { return offers_; }

 private:
  PortTaps taps_;
  OuterOffers offers_;
};

}  // namespace orca::host
