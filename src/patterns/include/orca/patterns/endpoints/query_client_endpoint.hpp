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

  /// Sends a question.
  /// @errors  failed_precondition if not connected; unavailable with the server's reason if the server
  /// refuses at once, as it does within a process. A server in another process sends its refusal as the
  /// answer.
  Result<QueryId> request(ObjectLoan loan, const Provenance* provenance);

  /// Sends a question and waits for the answer, at most `timeout` [s]. If the wait is interrupted, the
  /// question is withdrawn.
  /// @errors  as request() and receive_until().
  Result<ObjectRef> ask(ObjectLoan loan, const Provenance* provenance, Duration timeout);

 private:
  Result<QueryId> request(ObjectLoan loan, const Provenance* provenance, bool may_wait);
};

}  // namespace orca
