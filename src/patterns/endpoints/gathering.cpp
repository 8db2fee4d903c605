// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/gathering.hpp"

#include <algorithm>

#include "orca/patterns/endpoints/push_client_endpoint.hpp"

namespace orca {
namespace {

using Ports = std::span<PushClientEndpoint* const>;

// Returns the latest of the oldest stamps.
TimePoint latest_front(Ports ports) {
  TimePoint latest = TimePoint::min();
  for (const PushClientEndpoint* port : ports)
    for (const auto& edge : port->edges())
      if (edge->subscribed()) latest = std::max(latest, edge->oldest_stamp().value_or(latest));
  return latest;
}

bool drop_before(Ports ports, TimePoint time) {
  bool dropped = false;
  for (const PushClientEndpoint* port : ports)
    for (const auto& edge : port->edges()) dropped = edge->drop_before(time) || dropped;
  return dropped;
}

// A stamp may be any number, because objects come from other programs too.
TimePoint earlier(TimePoint time, Duration by) {
  return time > TimePoint::min() + by ? time - by : TimePoint::min();
}

}  // namespace

bool any_new(Ports ports) {
  return std::any_of(ports.begin(), ports.end(), [](const auto* port) { return port->has_new(); });
}

bool all_new(Ports ports) {
  return std::all_of(ports.begin(), ports.end(), [](const auto* port) { return port->has_new_from_all(); });
}

// The stamps of a server do not go back. So an object that is older than the oldest one of another server by more
// than `within` is older than all that follow there, too.
bool match(Ports ports, Duration within) {
  while (all_new(ports))
    if (!drop_before(ports, earlier(latest_front(ports), within))) return true;
  return false;
}

}  // namespace orca
