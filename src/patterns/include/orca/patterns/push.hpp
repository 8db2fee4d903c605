// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "orca/patterns/port_owner.hpp"

namespace orca {

/// The untyped part of PushServer.
class PushServerHandle {
 public:
  PushServerHandle(PortOwner& owner, std::string name, TypeId type, const PortOptions& options);
  PushServerHandle(const PushServerHandle&) = delete;
  PushServerHandle& operator=(const PushServerHandle&) = delete;

  /// Announces the base period (thesis: start): from now on an object comes each `base_period`; 0:
  /// irregularly, as if start() had never been called. Subscribers are granted multiples of it.
  void start(Duration base_period) { endpoint().announce(base_period); }
  [[nodiscard]] Duration base_period() const { return endpoint().base_period(); }

  /// How many clients are subscribed now.
  [[nodiscard]] std::size_t subscriber_count() const { return endpoint().subscriber_count(); }

 protected:
  void push_loan(ObjectLoan loan);
  [[nodiscard]] PushServerEndpoint& endpoint() const { return static_cast<PushServerEndpoint&>(*endpoint_); }

 private:
  Endpoint* endpoint_ = nullptr;
};

/// Pushes objects of type T to whoever subscribed (thesis 7.3, Fig. 7.1).
///
/// Thread contract: the component's strand.
template <class T>
class PushServer : public PushServerHandle {
 public:
  PushServer(PortOwner& owner, std::string name, const PortOptions& options = {})
      : PushServerHandle(owner, std::move(name), type_id(object_type<T>()), options) {}

  /// An empty object to fill in and push, without a copy and, after warm-up, without memory from the heap.
  [[nodiscard]] Loan<T> loan() const { return make_object<T>(); }

  /// Pushes a loaned object. Its header is filled in here. Waits only where the graph says overflow="block"
  /// of an edge that is full: at most its block_limit, and after all other subscribers have the object.
  void push(Loan<T> object) { push_loan(std::move(object)); }

  /// Pushes a copy of a value.
  void push(const T& value) {
    Loan<T> object = make_object<T>();
    *object = value;
    push(std::move(object));
  }
};

/// The untyped part of PushProxy: everything that does not look into an object.
class PushProxyHandle {
 public:
  PushProxyHandle(PortOwner& owner, std::string name, TypeId type, const PortOptions& options);
  PushProxyHandle(const PushProxyHandle&) = delete;
  PushProxyHandle& operator=(const PushProxyHandle&) = delete;

  /// For a `manual` port; otherwise the runtime subscribes while the component works.
  void subscribe() { endpoint().subscribe_all(); }
  void unsubscribe() { endpoint().unsubscribe_all(); }

  /// Whether the graph connects this port at all.
  [[nodiscard]] bool connected() const { return endpoint().connected(); }
  /// Whether an object has arrived that no get_update has returned yet (thesis: newDataArrived).
  [[nodiscard]] bool new_data_arrived() const { return endpoint().has_new(); }
  /// Whether the deadline that the graph sets for the edge has passed without a new object; true until one
  /// comes.
  [[nodiscard]] bool deadline_missed() const { return connected() && edge().deadline_missed(); }

  /// Asks for another update rate (thesis 7.3), before or while subscribed: at most one object per interval,
  /// only every n-th object. The graph's interval is the limit. Without effect on a port that is not
  /// connected.
  void set_interval(Duration interval) { ask({interval, 1}); }
  void set_multiple(std::uint32_t multiple) { ask({Duration{0}, multiple}); }
  /// What the server granted; all zero for a port that is not connected.
  [[nodiscard]] UpdateGrant granted() const { return connected() ? edge().grant() : UpdateGrant{}; }
  /// Time between two objects that the server announces [s]; 0: none.
  [[nodiscard]] Duration base_period() const { return connected() ? edge().base_period() : Duration{0}; }

  [[nodiscard]] EdgeCounters counters() const { return connected() ? edge().counters() : EdgeCounters{}; }

  [[nodiscard]] PushClientEndpoint& endpoint() const { return static_cast<PushClientEndpoint&>(*endpoint_); }

 protected:
  /// Takes the oldest new object, or null.
  ObjectRef take();
  ObjectRef get_update_ref();
  ObjectRef get_update_wait_ref(TimePoint deadline);
  [[nodiscard]] ObjectRef latest_ref() const;
  [[nodiscard]] TimePoint deadline_in(Duration limit) const;

 private:
  [[nodiscard]] PushEdge& edge() const { return *endpoint().edges().front(); }
  void ask(const UpdateRate& rate) {
    if (connected()) edge().ask(rate);
  }

  Endpoint* endpoint_ = nullptr;
};

/// Receives the objects that one PushServer pushes (thesis 7.3, Fig. 7.3).
///
/// Every blocking call throws Interrupted when the component must leave its lap; let it pass.
/// Thread contract: the component's strand.
template <class T>
class PushProxy : public PushProxyHandle {
 public:
  PushProxy(PortOwner& owner, std::string name, const PortOptions& options = {})
      : PushProxyHandle(owner, std::move(name), type_id(object_type<T>()), options) {}

  /// The next new object, or the last one again if there is none; blocks only before the first of this
  /// subscription.
  ObjectPtr<T> get_update() { return object_cast<T>(get_update_ref()); }

  /// Blocks until there is a new object. Never null.
  ObjectPtr<T> get_update_wait() { return object_cast<T>(get_update_wait_ref(kForever)); }

  /// Blocks until there is a new object, at most `limit`. Null when the time has passed.
  ObjectPtr<T> get_update_wait_max(Duration limit) {
    return object_cast<T>(get_update_wait_ref(deadline_in(limit)));
  }

  /// The newest object, without blocking and without taking it. Null before the first.
  [[nodiscard]] ObjectPtr<T> latest() const { return object_cast<T>(latest_ref()); }
};

/// A port array: objects of one type from any number of PushServers, told apart by the servers' names.
/// Subscriptions are made by the component, by name, at run time.
///
/// Thread contract: the component's strand.
template <class T>
class PushProxyArray {
 public:
  PushProxyArray(PortOwner& owner, std::string name, const PortOptions& options = {}) {
    PortDeclaration declaration =
        make_declaration(std::move(name), Pattern::push, Role::proxy, type_id(object_type<T>()), options);
    declaration.contract.many = true;
    declaration.manual = true;
    declaration.slot = &endpoint_;
    owner.declare_port(std::move(declaration));
  }
  PushProxyArray(const PushProxyArray&) = delete;
  PushProxyArray& operator=(const PushProxyArray&) = delete;

  /// The edges that the graph connects here, subscribed or not.
  [[nodiscard]] const std::vector<std::unique_ptr<PushEdge>>& edges() const { return endpoint().edges(); }

  /// The newest object of an edge, or null; takes everything that waits on it.
  [[nodiscard]] static ObjectPtr<T> take_latest(PushEdge& edge) {
    while (edge.take()) {
    }
    return object_cast<T>(edge.latest());
  }

  void unsubscribe_all() { endpoint().unsubscribe_all(); }
  [[nodiscard]] PushClientEndpoint& endpoint() const { return static_cast<PushClientEndpoint&>(*endpoint_); }

 private:
  Endpoint* endpoint_ = nullptr;
};

}  // namespace orca
