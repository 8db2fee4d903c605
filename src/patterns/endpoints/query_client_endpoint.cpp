// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/query_client_endpoint.hpp"

#include <utility>

namespace orca {

QueryClientEndpoint::QueryClientEndpoint(PortHome& home, PortContract contract)
    : RequestClient(home, std::move(contract), {"no question", "did not answer", "in time"}) {}

Result<QueryId> QueryClientEndpoint::request(ObjectLoan loan, const Provenance* provenance) {
  return request(std::move(loan), provenance, false);
}

Result<QueryId> QueryClientEndpoint::request(ObjectLoan loan, const Provenance* provenance, bool may_wait) {
  const Result<Offered> offered = offer(std::move(loan), provenance, may_wait);
  if (!offered) return offered.error();
  if (!offered->answered) return offered->id;
  return receive(offered->id)->error();  // only a refusal comes at once
}

Result<ObjectRef> QueryClientEndpoint::ask(ObjectLoan loan, const Provenance* provenance, Duration timeout) {
  const Result<QueryId> id = request(std::move(loan), provenance, true);
  if (!id) return id.error();
  try {
    return receive_until(*id, saturating_add(home().strand.executive().now(), timeout));
  } catch (const Interrupted&) {
    withdraw(*id);  // the caller never saw the id
    throw;
  }
}

}  // namespace orca
