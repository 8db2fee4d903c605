// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/push.hpp"

#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"

namespace orca {

PushServerHandle::PushServerHandle(PortOwner& owner, std::string name, TypeId type,
                                   const PortOptions& options) {
  PortDeclaration declaration =
      make_declaration(std::move(name), Pattern::push, Role::server, std::move(type), options);
  declaration.slot = &endpoint_;
  owner.declare_port(std::move(declaration));
}

PushServerEndpoint& PushServerHandle::endpoint() const {
  return static_cast<PushServerEndpoint&>(*endpoint_);
}

void PushServerHandle::start(Duration base_period) { endpoint().announce(base_period); }

Duration PushServerHandle::base_period() const { return endpoint().base_period(); }

std::size_t PushServerHandle::subscriber_count() const { return endpoint().audience(); }

bool PushServerHandle::take_new_subscribers() {
  const std::uint64_t subscriptions = endpoint().subscription_count();
  const bool is_looked_at = endpoint().is_looked_at();
  const bool has_new = subscriptions != subscriptions_taken_ || (is_looked_at && !was_looked_at_);
  subscriptions_taken_ = subscriptions;
  was_looked_at_ = is_looked_at;
  return has_new;
}

bool PushServerHandle::push_loan(ObjectLoan loan) {
  PushServerEndpoint& server = endpoint();
  if (!server.admits_caller()) return false;
  if (!server.home().computing.finish()) return true;  // the system has ended before the lap came so far
  server.publish(server.seal(std::move(loan), &server.home().provenance));
  return true;
}

ObjectRef PushServerHandle::push_reading(ObjectLoan reading) {
  if (!endpoint().admits_caller()) return {};
  ObjectRef object = endpoint().seal(std::move(reading), nullptr);
  endpoint().publish(ObjectRef(object));
  return object;
}

PushSubject::PushSubject(PortOwner& owner, PortDeclaration declaration) : name_(declaration.contract.name) {
  declaration.slot = &endpoint_;
  owner.declare_port(std::move(declaration));
}

PushClientEndpoint& PushSubject::endpoint() const { return static_cast<PushClientEndpoint&>(*endpoint_); }

Strand& PushSubject::strand() const { return endpoint_->home().strand; }

bool PushSubject::connected() const { return endpoint().connected(); }

bool PushSubject::new_data_arrived() const { return endpoint().has_new(); }

PushProxyHandle::PushProxyHandle(PortOwner& owner, std::string name, TypeId type, const PortOptions& options)
    : PushSubject(owner,
                  make_declaration(std::move(name), Pattern::push, Role::proxy, std::move(type), options)) {}

PushEdge& PushProxyHandle::edge() const { return *endpoint().edges().front(); }

void PushProxyHandle::subscribe() { endpoint().subscribe_all(); }

void PushProxyHandle::unsubscribe() { endpoint().unsubscribe_all(); }

bool PushProxyHandle::deadline_missed() const { return connected() && edge().deadline_missed(); }

UpdateGrant PushProxyHandle::granted() const { return connected() ? edge().grant() : UpdateGrant{}; }

Duration PushProxyHandle::base_period() const { return connected() ? edge().base_period() : Duration{0}; }

EdgeCounters PushProxyHandle::counters() const { return connected() ? edge().counters() : EdgeCounters{}; }

void PushProxyHandle::ask(const UpdateRate& rate) {
  if (connected()) edge().ask(rate);
}

ObjectRef PushProxyHandle::take() {
  if (!connected()) return {};
  ObjectRef object = edge().take();
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
  strand().wait_for(deadline, [&] {
    object = take();
    return static_cast<bool>(object);
  });
  return object;
}

ObjectRef PushProxyHandle::latest_ref() const { return connected() ? edge().latest() : ObjectRef{}; }

TimePoint PushProxyHandle::deadline_in(Duration limit) const { return endpoint().deadline_in(limit); }

PushEdge& PushSourceHandle::edge() const { return port_->edge(index_); }

std::string PushSourceHandle::path() const { return edge().source_path(); }

void PushSourceHandle::subscribe() const { edge().subscribe(); }

void PushSourceHandle::unsubscribe() const { edge().unsubscribe(); }

bool PushSourceHandle::new_data_arrived() const { return edge().has_new(); }

Duration PushSourceHandle::base_period() const { return edge().base_period(); }

ObjectRef PushSourceHandle::latest_ref() const { return edge().latest(); }

ObjectRef PushSourceHandle::take_ref() const { return edge().take(); }

ObjectRef PushSourceHandle::take_latest_ref() const {
  PushEdge& source = edge();
  while (source.take()) {
  }
  return source.latest();
}

namespace {

PortDeclaration make_array(std::string name, TypeId type, const PortOptions& options) {
  PortDeclaration declaration =
      make_declaration(std::move(name), Pattern::push, Role::proxy, std::move(type), options);
  declaration.contract.many = true;
  declaration.manual = true;
  return declaration;
}

}  // namespace

PushProxyArrayHandle::PushProxyArrayHandle(PortOwner& owner, std::string name, TypeId type,
                                           const PortOptions& options)
    : PushSubject(owner, make_array(std::move(name), std::move(type), options)) {}

std::string PushProxyArrayHandle::path() const { return endpoint().path(); }

void PushProxyArrayHandle::unsubscribe_all() { endpoint().unsubscribe_all(); }

std::size_t PushProxyArrayHandle::edge_count() const { return endpoint().edges().size(); }

bool PushProxyArrayHandle::is_connected(std::size_t edge) const { return this->edge(edge).has_server(); }

PushEdge& PushProxyArrayHandle::edge(std::size_t index) const { return *endpoint().edges().at(index); }

}  // namespace orca
