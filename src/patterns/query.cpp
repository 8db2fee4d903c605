// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/query.hpp"

#include "orca/patterns/endpoints/query_client_endpoint.hpp"

namespace orca {
QueryServerHandle::QueryServerHandle(PortOwner& owner, std::string name, TypeId request, TypeId reply,
                                     QueryHandler handler, const PortOptions& options) {
  PortDeclaration declaration =
      make_declaration(std::move(name), Pattern::query, Role::server, std::move(request), options);
  declaration.contract.reply = std::move(reply);
  declaration.slot = &endpoint_;
  declaration.on_request = std::move(handler);
  owner.declare_port(std::move(declaration));
}

QueryProxyHandle::QueryProxyHandle(PortOwner& owner, std::string name, TypeId request, TypeId reply,
                                   const PortOptions& options) {
  PortDeclaration declaration =
      make_declaration(std::move(name), Pattern::query, Role::proxy, std::move(request), options);
  declaration.contract.reply = std::move(reply);
  declaration.slot = &endpoint_;
  owner.declare_port(std::move(declaration));
}

QueryClientEndpoint& QueryProxyHandle::endpoint() const {
  return static_cast<QueryClientEndpoint&>(*endpoint_);
}

bool QueryProxyHandle::connected() const { return endpoint().connected(); }

RequestCounters QueryProxyHandle::counters() const { return endpoint().counters(); }

std::optional<std::uint64_t> QueryProxyHandle::server_restarts() const {
  return endpoint().server_restarts();
}

Result<ObjectRef> QueryProxyHandle::ask_loan(ObjectLoan loan, Duration timeout) {
  return endpoint().ask(std::move(loan), &endpoint().home().provenance, timeout);
}

Result<QueryId> QueryProxyHandle::request_loan(ObjectLoan loan) {
  return endpoint().request(std::move(loan), &endpoint().home().provenance);
}

std::optional<Result<ObjectRef>> QueryProxyHandle::receive_ref(QueryId id) { return endpoint().receive(id); }

Result<ObjectRef> QueryProxyHandle::receive_wait_ref(QueryId id, Duration timeout) {
  return endpoint().receive_until(id, endpoint().deadline_in(timeout));
}

void QueryProxyHandle::withdraw(QueryId id) { endpoint().withdraw(id); }

}  // namespace orca
