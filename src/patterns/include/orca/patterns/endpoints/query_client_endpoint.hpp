// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/patterns/endpoints/request_client.hpp"

namespace orca {

/// The client side of Query.
///
/// Thread contract: as RequestClient.
class QueryClientEndpoint final : public RequestClient<Result<ObjectRef>> {
 public:
  QueryClientEndpoint(PortHome& home, PortContract contract);
  ~QueryClientEndpoint() override { cut_links(); }

  /// Asks.
  /// @errors  failed_precondition if not connected; unavailable with the server's reason if it refuses at once,
  /// as within a process it does. Where the server is another process, its refusal is the answer.
  Result<QueryId> request(ObjectLoan loan, const Provenance* provenance);

  /// Asks and waits for the answer, at most `timeout` [s]; a question whose wait is interrupted is withdrawn.
  /// @errors  as request() and receive_until().
  Result<ObjectRef> ask(ObjectLoan loan, const Provenance* provenance, Duration timeout);
};

}  // namespace orca
