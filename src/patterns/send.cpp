// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/send.hpp"

#include "orca/patterns/endpoints/send_client_endpoint.hpp"

namespace orca {
SendServerHandle::SendServerHandle(PortOwner& owner, std::string name, TypeId type, SendHandler handler,
                                   const PortOptions& options) {
  PortDeclaration declaration =
      make_declaration(std::move(name), Pattern::send, Role::server, std::move(type), options);
  declaration.slot = &endpoint_;
  declaration.on_object = std::move(handler);
  owner.declare_port(std::move(declaration));
}

SendProxyHandle::SendProxyHandle(PortOwner& owner, std::string name, TypeId type,
                                 const PortOptions& options) {
  PortDeclaration declaration =
      make_declaration(std::move(name), Pattern::send, Role::proxy, std::move(type), options);
  declaration.slot = &endpoint_;
  owner.declare_port(std::move(declaration));
}

SendClientEndpoint& SendProxyHandle::endpoint() const { return static_cast<SendClientEndpoint&>(*endpoint_); }

bool SendProxyHandle::connected() const { return endpoint().connected(); }

RequestCounters SendProxyHandle::counters() const { return endpoint().counters(); }

std::optional<std::uint64_t> SendProxyHandle::server_restarts() const { return endpoint().server_restarts(); }

std::optional<Status> SendProxyHandle::send_receive(SendId id) { return endpoint().receive(id); }

Status SendProxyHandle::send_loan(ObjectLoan loan) {
  return endpoint().send(std::move(loan), &endpoint().home().provenance);
}

Status SendProxyHandle::send_wait_loan(ObjectLoan loan, std::optional<Duration> limit) {
  const TimePoint deadline = limit ? endpoint().deadline_in(*limit) : kForever;
  return endpoint().send_until(std::move(loan), &endpoint().home().provenance, deadline);
}

Result<SendId> SendProxyHandle::request_loan(ObjectLoan loan) {
  return endpoint().request(std::move(loan), &endpoint().home().provenance);
}

Status SendProxyHandle::send_receive_wait(SendId id, Duration timeout) {
  return endpoint().receive_until(id, endpoint().deadline_in(timeout));
}

}  // namespace orca
