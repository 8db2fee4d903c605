// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outer_ports.hpp"

#include <utility>

#include "run/swap/rewiring.hpp"

namespace orca::host {

Result<std::shared_ptr<PortTap>> OuterPorts::tap(const System& system,
                                                 const std::vector<graph::PortRef>& ports,
                                                 const PortTap::Bounds& bounds, const Wakes& wakes) {
  std::vector<PortTap::Place> places;
  for (const graph::PortRef& port : ports) {
    const Endpoint* const endpoint = system.endpoint(port);
    if (endpoint == nullptr) return no_such(port);
    places.push_back({port.component, endpoint->contract().name, flow_of(endpoint->contract())});
  }
  std::shared_ptr<PortTap> tap = taps_.open(std::move(places), bounds);
  for (const graph::PortRef& port : ports)
    if (wakes(port)) system.endpoint(port)->home().strand.wake();
  return tap;
}

Status OuterPorts::offer(const System& system, const graph::PortRef& port, ObjectLoan object,
                         OuterOffers::Answered answered) {
  Endpoint* const endpoint = system.endpoint(port);
  if (endpoint == nullptr) return no_such(port);
  return offers_.offer(*endpoint, std::move(object), std::move(answered));
}

}  // namespace orca::host
