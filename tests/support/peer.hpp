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

/// The least that ports need around them: a name, a strand, endpoints. What a component is in a system.
///
/// The strand has no task of its own until a Script or a Service gives it one; without it, the task that runs
/// the test acts for the peer and may call the blocking functions of its ports.
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
  /// Handles one object or question that waits at a server.
  /// @return false if there was none. What a handler throws passes.
  bool handle_one();

  /// Whether somebody subscribes to one of its PushServers.
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

/// Runs a function on a peer's strand. The end of the object interrupts and joins it.
class Script {
 public:
  Script(Peer& peer, std::function<void()> body);
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// @return whether it has come to its end within `limit`.
  [[nodiscard]] bool ends_within(Duration limit);
  [[nodiscard]] bool ended() const { return ended_; }
  /// Whether it left a wait because it was told to.
  [[nodiscard]] bool interrupted() const { return interrupted_; }

 private:
  Peer& peer_;
  std::atomic<bool> ended_{false};
  std::atomic<bool> interrupted_{false};
};

/// Opens a peer's servers and handles on its strand whatever comes, until the object's end.
class Service {
 public:
  explicit Service(Peer& peer);

 private:
  Script script_;
};

}  // namespace orca::test
