// SPDX-License-Identifier: LGPL-3.0-or-later
#include <utility>

#include "orca/patterns/push.hpp"
#include "orca/patterns/query.hpp"
#include "orca/patterns/send.hpp"

namespace orca {
namespace {

TimePoint deadline_of(const Endpoint& endpoint, Duration limit) {
  return saturating_add(endpoint.home().strand.executive().now(), limit);
}

std::uint32_t default_depth(Pattern pattern) { return pattern == Pattern::push ? 1 : 16; }

}  // namespace

PortDeclaration make_declaration(std::string name, Pattern pattern, Role role, TypeId type,
                                 const PortOptions& options) {
  PortDeclaration declaration;
  declaration.contract.name = std::move(name);
  declaration.contract.pattern = pattern;
  declaration.contract.role = role;
  declaration.contract.type = std::move(type);
  declaration.contract.required = role == Role::proxy && !options.optional;
  declaration.contract.queue.depth = options.depth > 0 ? options.depth : default_depth(pattern);
  if (pattern != Pattern::push) declaration.contract.queue.overflow = QueuePolicy::Overflow::refuse;
  declaration.contract.period = options.period;
  declaration.contract.from_device = options.from_device;
  declaration.contract.text = options.text;
  declaration.manual = options.manual;
  return declaration;
}

PushServerHandle::PushServerHandle(PortOwner& owner, std::string name, TypeId type,
                                   const PortOptions& options) {
  PortDeclaration declaration =
      make_declaration(std::move(name), Pattern::push, Role::server, std::move(type), options);
  declaration.slot = &endpoint_;
  owner.declare_port(std::move(declaration));
}

void PushServerHandle::push_loan(ObjectLoan loan) {
  PushServerEndpoint& server = endpoint();
  server.publish(server.seal(std::move(loan), &server.home().provenance));
}

PushProxyHandle::PushProxyHandle(PortOwner& owner, std::string name, TypeId type,
                                 const PortOptions& options) {
  PortDeclaration declaration =
      make_declaration(std::move(name), Pattern::push, Role::proxy, std::move(type), options);
  declaration.slot = &endpoint_;
  owner.declare_port(std::move(declaration));
}

ObjectRef PushProxyHandle::take() {
  if (!endpoint().connected()) return {};
  ObjectRef object = endpoint().edges().front()->take();
  if (object) endpoint().home().provenance.note(object.header());
  return object;
}

ObjectRef PushProxyHandle::get_update_ref() {
  if (ObjectRef next = take()) return next;
  if (ObjectRef last = latest_ref()) return last;
  return get_update_wait_ref(kForever);
}

ObjectRef PushProxyHandle::get_update_wait_ref(TimePoint deadline) {
  ObjectRef object;
  endpoint().home().strand.wait_for(deadline, [&] {
    object = take();
    return static_cast<bool>(object);
  });
  return object;
}

ObjectRef PushProxyHandle::latest_ref() const {
  return endpoint().connected() ? endpoint().edges().front()->latest() : ObjectRef{};
}

TimePoint PushProxyHandle::deadline_in(Duration limit) const { return deadline_of(endpoint(), limit); }

SendServerHandle::SendServerHandle(PortOwner& owner, std::string name, TypeId type,
                                   SendServerEndpoint::Handler handler, const PortOptions& options) {
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

Status SendProxyHandle::send_loan(ObjectLoan loan) {
  return endpoint().send(std::move(loan), &endpoint().home().provenance);
}

Status SendProxyHandle::send_wait_loan(ObjectLoan loan, std::optional<Duration> limit) {
  const TimePoint deadline = limit ? deadline_of(endpoint(), *limit) : kForever;
  return endpoint().send_until(std::move(loan), &endpoint().home().provenance, deadline);
}

Result<SendId> SendProxyHandle::request_loan(ObjectLoan loan) {
  return endpoint().request(std::move(loan), &endpoint().home().provenance);
}

Status SendProxyHandle::send_receive_wait(SendId id, Duration timeout) {
  return endpoint().receive_until(id, deadline_of(endpoint(), timeout));
}

QueryServerHandle::QueryServerHandle(PortOwner& owner, std::string name, TypeId request, TypeId reply,
                                     QueryServerEndpoint::Handler handler, const PortOptions& options) {
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

Result<QueryId> QueryProxyHandle::request_loan(ObjectLoan loan) {
  return endpoint().request(std::move(loan), &endpoint().home().provenance);
}

TimePoint QueryProxyHandle::deadline_in(Duration limit) const { return deadline_of(endpoint(), limit); }

}  // namespace orca
