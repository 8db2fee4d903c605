// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/patterns/endpoints/request_client.hpp"

namespace orca {

/// The client side of Send.
///
/// Thread contract: as RequestClient.
class SendClientEndpoint final : public RequestClient<Status> {
 public:
  SendClientEndpoint(PortHome& home, PortContract contract);
  ~SendClientEndpoint() override { cut_links(); }

  /// Sends and waits for the outcome, which is there at once on most edges.
  /// @errors  failed_precondition if not connected; unavailable with the server's reason if refused;
  /// deadline_exceeded. Throws Interrupted.
  Status send(ObjectLoan loan, const Provenance* provenance);
  /// Does the same, but waits for room until the deadline where the server is full.
  Status send_until(ObjectLoan loan, const Provenance* provenance, TimePoint deadline);

  /// Sends without waiting for the outcome.
  /// @errors  failed_precondition if not connected.
  Result<SendId> request(ObjectLoan loan, const Provenance* provenance);

  /// Does what RequestClient does, and also withdraws the object when the wait is interrupted.
  Status receive_until(SendId id, TimePoint deadline);
};

}  // namespace orca
