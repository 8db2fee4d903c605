// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/send_client_endpoint.hpp"

#include <utility>

namespace orca {

SendClientEndpoint::SendClientEndpoint(PortHome& home, PortContract contract)
    : RequestClient(home, std::move(contract), {"sent no object", "had no room for what", "sent in time"}) {}

Status SendClientEndpoint::send(ObjectLoan loan, const Provenance* provenance) {
  const Result<Offered> offered = offer(std::move(loan), provenance, false);
  if (!offered) return offered.error();
  if (offered->answered) return *receive(offered->id);
  return receive_until(offered->id, saturating_add(home().strand.executive().now(), target().patience()));
}

Status SendClientEndpoint::send_until(ObjectLoan loan, const Provenance* provenance, TimePoint deadline) {
  const Result<Offered> offered = offer(std::move(loan), provenance, true);
  return offered ? receive_until(offered->id, deadline) : Status(offered.error());
}

Result<SendId> SendClientEndpoint::request(ObjectLoan loan, const Provenance* provenance) {
  const Result<Offered> offered = offer(std::move(loan), provenance, false);
  if (!offered) return offered.error();
  return offered->id;
}

Status SendClientEndpoint::receive_until(SendId id, TimePoint deadline) {
  try {
    return RequestClient::receive_until(id, deadline);
  } catch (const Interrupted&) {
    withdraw(id);
    throw;
  }
}

}  // namespace orca
