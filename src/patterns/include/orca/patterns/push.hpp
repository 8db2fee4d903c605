// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "orca/patterns/counters.hpp"
#include "orca/patterns/port_owner.hpp"
#include "orca/patterns/update_rate.hpp"

namespace orca {

class PushClientEndpoint;
class PushEdge;
class PushProxyArrayHandle;
class PushServerEndpoint;
class Strand;

/// The untyped part of PushServer.
class PushServerHandle {
 public:
  PushServerHandle(PortOwner& owner, std::string name, TypeId type, const PortOptions& options);
  PushServerHandle(const PushServerHandle&) = delete;
  PushServerHandle& operator=(const PushServerHandle&) = delete;

  /// Announces the base period (thesis: start): from now on an object comes every `base_period` [s]. 0:
  /// irregularly, as if start() had never been called. Subscribers are granted multiples of the base period.
  void start(Duration base_period);
  [[nodiscard]] Duration base_period() const;

  /// Returns how many clients are subscribed now; one more if somebody looks on, such as a recording.
  [[nodiscard]] std::size_t subscriber_count() const;
  /// Returns whether a client has subscribed, or somebody has begun to look on, since the last call of this function or, before the first,
  /// since the port was made. Others may have left meanwhile, so subscriber_count() need not have grown.
  [[nodiscard]] bool take_new_subscribers();

 protected:
  /// Stamps the object as an answer to what the component currently handles, and pushes it.
  bool push_loan(ObjectLoan loan);
  /// Stamps an object that answers nothing, pushes it, and returns it; null if the calling thread runs no component.
  /// @thread  the device's strand, for a port that is declared with from_device.
  ObjectRef push_reading(ObjectLoan reading);

 private:
  [[nodiscard]] PushServerEndpoint& endpoint() const;

  Endpoint* endpoint_ = nullptr;
  std::uint64_t subscriptions_taken_ = 0;  // by take_new_subscribers()
  bool was_looked_at_ = false;
};

/// The server of a Push port. It pushes objects of type T to every subscriber (thesis 7.3, Fig. 7.1).
///
/// Thread contract: the component's strand.
template <class T>
class PushServer : public PushServerHandle {
 public:
  PushServer(PortOwner& owner, std::string name, const PortOptions& options = {})
      : PushServerHandle(owner, std::move(name), type_id(object_type<T>()), options) {}

  /// Returns an empty object to fill in and push. There is no copy and, after warm-up, no allocation from the
  /// heap.
  [[nodiscard]] Loan<T> loan() const { return make_object<T>(); }

  /// Pushes a loaned object, of T or a type derived from it; it arrives whole. Its header is filled in here. It waits only where the graph says
  /// overflow="block" for an edge that is full: at most the edge's block_limit, and after all other
  /// subscribers have the object.
  /// @return false if the calling thread runs no component: a thread that the component or a library has started.
  /// Nobody gets the object then, and the alarm FOREIGN_THREAD is raised. A component need not look at it.
  bool push(Loan<T> object) { return push_loan(std::move(object)); }

  /// Pushes a copy of a value, of T or a type derived from it.
  template <std::derived_from<T> U = T>
  bool push(const U& value) {
    return push(Loan<T>(make_object(value)));
  }
};

/// A port at which objects of PushServers arrive: a PushProxy, or a port array (thesis 7.4: Subject).
///
/// Thread contract: the component's strand.
class PushSubject {
 public:
  PushSubject(const PushSubject&) = delete;
  PushSubject& operator=(const PushSubject&) = delete;

  /// Returns the name under which the component declares this port; the graph may use another name.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns whether the graph connects this port at all.
  [[nodiscard]] bool connected() const;
  /// Returns whether an object has arrived, from any server, that the component has not taken yet (thesis:
  /// newDataArrived).
  [[nodiscard]] bool new_data_arrived() const;

 protected:
  PushSubject(PortOwner& owner, PortDeclaration declaration);
  ~PushSubject() = default;

  [[nodiscard]] Strand& strand() const;
  [[nodiscard]] PushClientEndpoint& endpoint() const;

 private:
  friend class Synchronizer;

  std::string name_;
  Endpoint* endpoint_ = nullptr;
};

/// The untyped part of PushProxy: everything that does not look into an object.
class PushProxyHandle : public PushSubject {
 public:
  PushProxyHandle(PortOwner& owner, std::string name, TypeId type, const PortOptions& options);

  /// Subscribes a `manual` port; the runtime subscribes all others while the component works.
  void subscribe();
  void unsubscribe();

  /// Returns whether the deadline that the graph sets for the edge has passed without a new object. It stays
  /// true until one comes.
  [[nodiscard]] bool deadline_missed() const;

  /// Requests another update rate (thesis 7.3), before or while subscribed: at most one object per interval
  /// [s], or only every n-th object. The graph's interval is the limit. Has no effect on a port that is not
  /// connected.
  void set_interval(Duration interval) { ask({interval, 1}); }
  void set_multiple(std::uint32_t multiple) { ask({Duration{0}, multiple}); }
  /// Returns the rate that the server granted; UpdateGrant{} for a port that is not connected.
  [[nodiscard]] UpdateGrant granted() const;
  /// Returns the time between two objects that the server announces [s]; 0: none.
  [[nodiscard]] Duration base_period() const;

  [[nodiscard]] EdgeCounters counters() const;

 protected:
  /// Takes the oldest new object, or null.
  ObjectRef take();
  ObjectRef get_update_ref();
  ObjectRef get_update_wait_ref(TimePoint deadline);
  [[nodiscard]] ObjectRef latest_ref() const;
  [[nodiscard]] TimePoint deadline_in(Duration limit) const;

 private:
  [[nodiscard]] PushEdge& edge() const;
  void ask(const UpdateRate& rate);
};

/// The client of a Push port. It receives the objects that one PushServer pushes (thesis 7.3, Fig. 7.3).
///
/// Every blocking call throws Interrupted when the component must leave its lap; let it pass.
/// Thread contract: the component's strand.
template <class T>
class PushProxy : public PushProxyHandle {
 public:
  PushProxy(PortOwner& owner, std::string name, const PortOptions& options = {})
      : PushProxyHandle(owner, std::move(name), type_id(object_type<T>()), options) {}

  /// Returns the next new object, or the last one again if there is none. Blocks only before the first object
  /// of this subscription.
  ObjectPtr<T> get_update() { return object_cast<T>(get_update_ref()); }

  /// Blocks until there is a new object and returns it; never null.
  ObjectPtr<T> get_update_wait() { return object_cast<T>(get_update_wait_ref(kForever)); }

  /// Blocks until there is a new object, at most `limit`, and returns it; null when the time has passed.
  ObjectPtr<T> get_update_wait_max(Duration limit) {
    return object_cast<T>(get_update_wait_ref(deadline_in(limit)));
  }

  /// Returns the newest object, without blocking and without taking it; null before the first.
  [[nodiscard]] ObjectPtr<T> latest() const { return object_cast<T>(latest_ref()); }
};

/// The untyped part of a source of a port array.
class PushSourceHandle {
 public:
  /// Returns "component.port" of the server.
  [[nodiscard]] std::string path() const;

  void subscribe() const;
  void unsubscribe() const;
  /// Returns whether an object has arrived that take_latest() has not returned yet.
  [[nodiscard]] bool new_data_arrived() const;
  /// Returns the time between two objects that the server announces [s]; 0: none.
  [[nodiscard]] Duration base_period() const;

  /// Compares two sources: equal if they are the same source of the same port.
  friend bool operator==(const PushSourceHandle&, const PushSourceHandle&) = default;

 protected:
  PushSourceHandle(const PushProxyArrayHandle& port, std::size_t index) : port_(&port), index_(index) {}
  [[nodiscard]] ObjectRef latest_ref() const;
  [[nodiscard]] ObjectRef take_ref() const;
  [[nodiscard]] ObjectRef take_latest_ref() const;

 private:
  [[nodiscard]] PushEdge& edge() const;

  // The port's place is the same for the component's whole life, but the edges behind it are those of another port while
  // a new object of the component is configured beside the old one.
  const PushProxyArrayHandle* port_;
  std::size_t index_;
};

/// One PushServer that the graph connects to a port array.
///
/// A value that refers to the port. Thread contract: the component's strand.
template <class T>
class PushSourceOf : public PushSourceHandle {
 public:
  PushSourceOf(const PushProxyArrayHandle& port, std::size_t index) : PushSourceHandle(port, index) {}

  /// Returns the newest object, without taking it; null before the first of this subscription.
  [[nodiscard]] ObjectPtr<T> latest() const { return object_cast<T>(latest_ref()); }
  /// Takes the oldest new object; null if there is none.
  [[nodiscard]] ObjectPtr<T> take() const { return object_cast<T>(take_ref()); }
  /// Takes all waiting objects, and returns the newest object, new or not; null before the first.
  [[nodiscard]] ObjectPtr<T> take_latest() const { return object_cast<T>(take_latest_ref()); }
};

/// The untyped part of PushProxyArray.
class PushProxyArrayHandle : public PushSubject {
 public:
  PushProxyArrayHandle(PortOwner& owner, std::string name, TypeId type, const PortOptions& options);

  /// Returns "component.port" of this port.
  [[nodiscard]] std::string path() const;
  void unsubscribe_all();

 protected:
  [[nodiscard]] std::size_t edge_count() const;
  [[nodiscard]] bool is_connected(std::size_t edge) const;

 private:
  friend class PushSourceHandle;

  [[nodiscard]] PushEdge& edge(std::size_t index) const;
};

/// A port array: it receives objects of one type from any number of PushServers, distinguished by the
/// servers' names. The component itself subscribes to them, by name, at run time.
///
/// Thread contract: the component's strand.
template <class T>
class PushProxyArray : public PushProxyArrayHandle {
 public:
  using Source = PushSourceOf<T>;

  PushProxyArray(PortOwner& owner, std::string name, const PortOptions& options = {})
      : PushProxyArrayHandle(owner, std::move(name), type_id(object_type<T>()), options) {}

  /// Returns the servers that the graph connects here, subscribed to or not. Their order means nothing: those of other
  /// processes come later, and so may those that were connected while the system ran; path() distinguishes them. A source whose
  /// connection was removed meanwhile brings nothing any more.
  [[nodiscard]] std::vector<Source> sources() const {
    std::vector<Source> all;
    for (std::size_t i = 0; i < edge_count(); ++i)
      if (is_connected(i)) all.emplace_back(*this, i);
    return all;
  }
};

}  // namespace orca
