// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "orca/patterns/endpoints/query_client_endpoint.hpp"
#include "orca/patterns/endpoints/query_server_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_server_endpoint.hpp"

namespace orca {

/// A factory of edges of one kind of link. Whoever wires a system asks it for each edge.
///
/// Thread contract: connect() before the components of either end run; the rest see there.
class Links {
 public:
  virtual ~Links() = default;

  /// Connects two ports.
  ///
  /// @param from    a PushServer, QueryProxy or SendProxy, as in `<connect from= to=>`.
  /// @param to      the other end.
  /// @param policy  how the edge buffers, for Push and Send; without it, the policy of the receiving port's
  /// author.
  /// The objects may be of a type that is derived from the one that their receiver asks for.
  ///
  /// @errors  invalid_argument if the ends do not fit each other, or if the policy lets a device wait;
  /// already_exists if the proxy is taken.
  Status connect(Endpoint& from, Endpoint& to, const QueuePolicy& policy);
  Status connect(Endpoint& from, Endpoint& to) { return connect(from, to, to.contract().queue); }

  /// Lets a port use its connection to a peer no more, and destroys its end of the link. A request that was not answered yet
  /// gets an error. A server still handles its accepted objects, unless the sender waits for the handler's outcome.
  /// Objects that wait at a PushProxy are dropped. The other end has to leave as well: the client first.
  /// @param peer  "component.port" of the other end. Nothing happens if there is no such connection.
  /// @pre  the port is not movable (MovablePort::can_move()).
  /// @thread  the strand of the port between two laps; for a server in the same process, that of the client as well.
  static void leave(Endpoint& port, const std::string& peer);

 protected:
  /// Checks that two ends fit each other, apart from whether the proxy is taken.
  /// @errors  those of connect().
  static Status check_fit(const Endpoint& from, const Endpoint& to, const QueuePolicy& policy);
  /// Connects two ends that fit each other, without a look at whether the proxy is taken.
  void join(Endpoint& from, Endpoint& to, const QueuePolicy& policy);

 private:
  // Connect two ends that fit each other and are free.
  virtual void push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) = 0;
  virtual void query(QueryClientEndpoint& client, QueryServerEndpoint& server) = 0;
  virtual void send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) = 0;
};

}  // namespace orca
