// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "orca/patterns/counters.hpp"
#include "orca/patterns/port_owner.hpp"
#include "orca/patterns/request_id.hpp"

namespace orca {

class SendClientEndpoint;

/// The untyped part of SendServer.
class SendServerHandle {
 public:
  SendServerHandle(PortOwner& owner, std::string name, TypeId type, SendHandler handler,
                   const PortOptions& options);
  SendServerHandle(const SendServerHandle&) = delete;
  SendServerHandle& operator=(const SendServerHandle&) = delete;

 private:
  Endpoint* endpoint_ = nullptr;
};

/// The server of a Send port. It receives objects of type T that others send (thesis 7.3, Fig. 7.7). The
/// handler is a member function `Status on_goal(const ObjectPtr<T>&)`; it runs on the component's strand
/// between two laps.
template <class T>
class SendServer : public SendServerHandle {
 public:
  template <class C>
  SendServer(C& owner, std::string name, Status (C::*handler)(const ObjectPtr<T>&),
             const PortOptions& options = {})
      : SendServerHandle(
            owner, std::move(name), type_id(object_type<T>()),
            [&owner, handler](const ObjectRef& object) { return (owner.*handler)(object_cast<T>(object)); },
            options) {}
};

/// The untyped part of SendProxy.
class SendProxyHandle {
 public:
  SendProxyHandle(PortOwner& owner, std::string name, TypeId type, const PortOptions& options);
  SendProxyHandle(const SendProxyHandle&) = delete;
  SendProxyHandle& operator=(const SendProxyHandle&) = delete;

  [[nodiscard]] bool connected() const;
  [[nodiscard]] RequestCounters counters() const;
  /// Returns how often the server's process was replaced by a new one since this component was built; nothing if
  /// the server is in this process, or the port is not connected.
  ///
  /// A new process knows nothing of what was sent to its predecessor. Read the number before you send: if it differs later,
  /// the object may be unknown to the server, even if it was accepted. A wait of the component looks at its condition again
  /// when the number changes, such as Synchronizer::wait(limit, unless).
  /// @thread  the component's strand.
  [[nodiscard]] std::optional<std::uint64_t> server_restarts() const;

  /// Reports whether an object sent by send_request() was accepted or refused; returns nothing while that is
  /// open.
  /// @errors  not_found for an id that was never given or whose outcome has been taken.
  std::optional<Status> send_receive(SendId id);
  /// Does the same, but waits at most `timeout` [s]; after that the object is withdrawn.
  /// @errors  deadline_exceeded; throws Interrupted.
  Status send_receive_wait(SendId id, Duration timeout = 1s);

 protected:
  Status send_loan(ObjectLoan loan);
  Status send_wait_loan(ObjectLoan loan, std::optional<Duration> limit);
  Result<SendId> request_loan(ObjectLoan loan);

 private:
  [[nodiscard]] SendClientEndpoint& endpoint() const;

  Endpoint* endpoint_ = nullptr;
};

/// The client of a Send port. It sends objects of type T to one SendServer (thesis 7.3, Fig. 7.8): at once
/// with send(), waiting for room with send_wait() and send_wait_max(), or in two steps with send_request()
/// and send_receive().
///
/// The waits throw Interrupted when the component must leave its lap; let it pass. So does a refusal while the system
/// is being stopped, except in stop(), which gets the refusal.
/// Thread contract: the component's strand.
template <class T>
class SendProxy : public SendProxyHandle {
 public:
  SendProxy(PortOwner& owner, std::string name, const PortOptions& options = {})
      : SendProxyHandle(owner, std::move(name), type_id(object_type<T>()), options) {}

  [[nodiscard]] Loan<T> loan() const { return make_object<T>(); }

  /// Sends an object of T or a type derived from it; it arrives whole. A full server refuses it. Waits only where the
  /// graph says overflow="block" (at most the edge's block_limit) or confirm="handled", and on links to other processes
  /// for their answer.
  /// @return ok once the server has accepted the object: from then on it is lost only with the server's process. With
  /// confirm="handled", what the server's handler returned.
  /// @errors  failed_precondition if not connected or called by a thread that runs no component, unavailable with the
  /// server's reason if refused, deadline_exceeded after a wait; an object that is just being handled then cannot be
  /// taken back.
  Status send(Loan<T> object) { return send_loan(std::move(object)); }
  template <std::derived_from<T> U = T>
  Status send(const U& value) {
    return send(Loan<T>(make_object(value)));
  }

  /// Sends an object and waits for room for as long as it takes. Other refusals come at once.
  Status send_wait(Loan<T> object) { return send_wait_loan(std::move(object), std::nullopt); }

  /// Sends an object and waits for room, at most `limit`.
  /// @errors  as send().
  Status send_wait_max(Loan<T> object, Duration limit) { return send_wait_loan(std::move(object), limit); }

  /// Sends an object without waiting for anything; send_receive() reports what became of it.
  /// @errors  failed_precondition as send().
  Result<SendId> send_request(Loan<T> object) { return request_loan(std::move(object)); }
};

}  // namespace orca
