// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "orca/patterns/endpoints/query_client_endpoint.hpp"
#include "orca/patterns/endpoints/query_server_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_server_endpoint.hpp"
#include "orca/patterns/port_owner.hpp"

namespace orca::host {

/// Returns whether the same connections may end at both ports, which have the same name.
[[nodiscard]] bool same_port(const PortContract& a, const PortContract& b);

/// The ports of one component, owned by the host process. They are made before the component's code is
/// loaded, stay when it is unloaded or exchanged, and queue meanwhile.
///
/// Thread contract: find() and is_asked() from anywhere; the rest on the component's strand, or before that starts.
class PortSet {
 public:
  template <class Kind>
  struct Intake {
    Kind* endpoint;
    typename Kind::Handler handler;
  };

  explicit PortSet(PortHome& home) : home_(home) {}

  /// Makes an endpoint.
  void add(const PortContract& contract);
  /// Returns the endpoint of a port; null if there is no such port.
  [[nodiscard]] Endpoint* find(const std::string& port) const;

  /// Returns the contracts of all ports, in order of declaration.
  /// @thread  as find().
  [[nodiscard]] std::vector<PortContract> contracts() const;

  /// Connects the handles of a newly constructed component with these ports.
  /// @errors  failed_precondition if it declares a port that is not there: its code is not the one that the
  ///          graph was checked with.
  Status bind(const std::vector<PortDeclaration>& declarations);
  /// Forgets everything that belongs to the component's code.
  void unbind();

  /// Passes requests and sent objects to the component's handlers from now on.
  void open();
  /// Lets requests and sent objects wait until the component is there.
  void hold();
  /// Refuses requests and sent objects from now on.
  void close(const std::string& reason);
  /// Returns whether something waits to be handled.
  [[nodiscard]] bool has_intake() const;
  /// Returns the same to other threads.
  [[nodiscard]] bool is_asked() const;

  [[nodiscard]] const std::vector<Intake<SendServerEndpoint>>& send_servers() const { return send_servers_; }
  [[nodiscard]] const std::vector<Intake<QueryServerEndpoint>>& query_servers() const {
    return query_servers_;
  }

  [[nodiscard]] bool has_subscribers() const;
  /// Returns whether somebody subscribes to what it pushes, or looks at it.
  [[nodiscard]] bool has_audience() const;
  /// Subscribes the clients whose subscriptions the runtime manages.
  void subscribe();
  void unsubscribe();

  /// Returns whether a connection that ends here has a deadline.
  [[nodiscard]] bool has_deadline() const;
  /// Reports missed deadlines.
  /// @return when to call it again if the strand is not woken before; kForever while no deadline runs.
  TimePoint watch_deadlines();

 private:
  template <class Kind>
  Kind& make(const PortContract& contract);
  void bind_handler(const PortDeclaration& declaration);

  PortHome& home_;
  mutable std::mutex mutex_;  // held while the strand changes the vectors, and while others read them
  std::vector<std::unique_ptr<Endpoint>> endpoints_;  // all, in order of declaration
  std::vector<PushServerEndpoint*> push_servers_;
  std::vector<PushClientEndpoint*> push_clients_;
  std::vector<PushClientEndpoint*> automatic_clients_;  // those that the runtime subscribes
  std::vector<Intake<SendServerEndpoint>> send_servers_;
  std::vector<Intake<QueryServerEndpoint>> query_servers_;
};

}  // namespace orca::host
