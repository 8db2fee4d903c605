// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/component/host.hpp"
#include "orca/host/component_report.hpp"

namespace orca::host {

/// An order of a component about another one, on its way to who carries it out. A plain value.
struct PeerCall {
  std::string by;            ///< The component that orders.
  std::uint64_t number = 0;  ///< Of the order, among those of the component.
  PeerOrder order;
};

/// Which components are suspended for others. Who carries out the orders keeps it, because a component that is lost lets nobody go
/// on. What an operator has suspended is none of these, and stays suspended.
///
/// Thread contract: not synchronised.
class PeerPauses {
 public:
  /// Suspends a component, or lets it go on. @return whether it was not so already.
  using Pause = std::function<Result<bool>(bool suspends)>;

  /// Carries out an order to suspend a component or to let it go on. It goes on when the last one for whom it is suspended says so.
  /// @return as ComponentHost::take_outcome().
  /// @errors  those of `pause`.
  Result<std::string> obey(const PeerCall& call, const Pause& pause);
  /// Forgets for whom a component is suspended: an operator has let it go on, or its process is lost.
  void forget(const std::string& component) { holders_.erase(component); }
  /// Returns the orders that components would give which do not work any more: that what is suspended for them goes on.
  [[nodiscard]] std::vector<PeerCall> left(const Reports& reports) const;

 private:
  std::map<std::string, std::set<std::string>> holders_;  // by component: for whom it is suspended
};

}  // namespace orca::host
