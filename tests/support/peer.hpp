// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "orca/patterns/endpoints/query_client_endpoint.hpp"
#include "orca/patterns/endpoints/query_server_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_server_endpoint.hpp"
#include "orca/patterns/port_owner.hpp"
#include "orca/patterns/push.hpp"
#include "orca/patterns/query.hpp"
#include "orca/patterns/send.hpp"

namespace orca::test {

/// A minimal owner of ports: a name, a strand and endpoints. It stands for a component of a system.
///
/// The strand has no task of its own until a Script or a Service gives it one. Without one, the task of the
/// test acts for the peer and may call the blocking functions of its ports.
class Peer : public PortOwner {
 public:
  Peer(Executive& executive, std::string name, LinkObserver* observer = nullptr);

  void declare_port(PortDeclaration declaration) override;
  [[nodiscard]] Endpoint& endpoint(const std::string& port) const;
  /// The edges of a PushProxy or a port array.
  [[nodiscard]] const std::vector<std::unique_ptr<PushEdge>>& edges(const std::string& port) const {
    return static_cast<const PushClientEndpoint&>(endpoint(port)).edges();
  }

  /// Opens or closes all Send and Query servers.
  void open();
  void close(const std::string& reason);
  /// Handles one object or question that waits at a server. The exception of a handler passes through.
  /// @return false if there was none.
  bool handle_one();

  /// Returns whether one of its PushServers has a subscriber.
  [[nodiscard]] bool has_subscribers() const;
  [[nodiscard]] const std::vector<std::unique_ptr<Endpoint>>& endpoints() const { return endpoints_; }

  /// Makes every wait of the strand throw Interrupted from now on.
  void leave();
  [[nodiscard]] bool leaving() const { return leaving_; }

  [[nodiscard]] PortHome& home() { return home_; }
  [[nodiscard]] Strand& strand() { return strand_; }
  [[nodiscard]] Executive& executive() { return strand_.executive(); }

 private:
  template <class Kind>
  struct Intake {
    Kind* endpoint;
    typename Kind::Handler handler;
  };

  Strand strand_;
  PortHome home_;
  std::vector<std::unique_ptr<Endpoint>> endpoints_;
  std::vector<PushServerEndpoint*> push_servers_;
  std::vector<Intake<SendServerEndpoint>> send_servers_;
  std::vector<Intake<QueryServerEndpoint>> query_servers_;
  std::atomic<bool> leaving_{false};
};

/// A function that runs on a peer's strand. The destructor interrupts and joins it.
class Script {
 public:
  Script(Peer& peer, std::function<void()> body);
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// @return whether it has ended within `limit`.
  [[nodiscard]] bool ends_within(Duration limit);
  [[nodiscard]] bool ended() const { return ended_; }
  /// Returns whether it was interrupted in a wait.
  [[nodiscard]] bool interrupted() const { return interrupted_; }

 private:
  Peer& peer_;
  std::atomic<bool> ended_{false};
  std::atomic<bool> interrupted_{false};
};

/// A service that opens a peer's servers and handles, on its strand, everything that arrives, until it is
/// destroyed.
class Service {
 public:
  explicit Service(Peer& peer);

 private:
  Script script_;
};

}  // namespace orca::test
