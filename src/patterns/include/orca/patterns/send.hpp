// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "orca/patterns/port_owner.hpp"

namespace orca {

/// The untyped part of SendServer.
class SendServerHandle {
 public:
  SendServerHandle(PortOwner& owner, std::string name, TypeId type, SendServerEndpoint::Handler handler,
                   const PortOptions& options);
  SendServerHandle(const SendServerHandle&) = delete;
  SendServerHandle& operator=(const SendServerHandle&) = delete;

 private:
  Endpoint* endpoint_ = nullptr;
};

/// Receives objects of type T that others send (thesis 7.3, Fig. 7.7). The handler is a member function
/// `Status on_goal(const ObjectPtr<T>&)`; it runs on the component's strand between two laps.
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

  [[nodiscard]] bool connected() const { return endpoint().connected(); }

 protected:
  Status send_loan(ObjectLoan loan);

 private:
  [[nodiscard]] SendClientEndpoint& endpoint() const { return static_cast<SendClientEndpoint&>(*endpoint_); }
  Endpoint* endpoint_ = nullptr;
};

/// Sends objects of type T to one SendServer (thesis 7.3, Fig. 7.8).
///
/// Thread contract: the component's strand.
template <class T>
class SendProxy : public SendProxyHandle {
 public:
  SendProxy(PortOwner& owner, std::string name, const PortOptions& options = {})
      : SendProxyHandle(owner, std::move(name), type_id(object_type<T>()), options) {}

  [[nodiscard]] Loan<T> loan() const { return make_object<T>(); }

  /// @return ok once the server has accepted the object: from then on it is not lost.
  /// @errors  failed_precondition if not connected, unavailable with the server's reason if refused.
  Status send(Loan<T> object) { return send_loan(std::move(object)); }
  Status send(const T& value) {
    Loan<T> object = make_object<T>();
    *object = value;
    return send(std::move(object));
  }
};

}  // namespace orca
