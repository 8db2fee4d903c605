// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "orca/patterns/counters.hpp"
#include "orca/patterns/port_owner.hpp"
#include "orca/patterns/request_id.hpp"

namespace orca {

class QueryClientEndpoint;

/// The untyped part of QueryServer.
class QueryServerHandle {
 public:
  QueryServerHandle(PortOwner& owner, std::string name, TypeId request, TypeId reply, QueryHandler handler,
                    const PortOptions& options);
  QueryServerHandle(const QueryServerHandle&) = delete;
  QueryServerHandle& operator=(const QueryServerHandle&) = delete;

 private:
  Endpoint* endpoint_ = nullptr;
};

/// The server of a Query port. It answers requests of type Q with objects of type A (thesis 7.3, Fig. 7.4).
/// The handler is a member function `Result<Loan<A>> on_ask(const ObjectPtr<Q>&)`; it runs on the component's
/// strand between two laps.
template <class Q, class A>
class QueryServer : public QueryServerHandle {
 public:
  template <class C>
  QueryServer(C& owner, std::string name, Result<Loan<A>> (C::*handler)(const ObjectPtr<Q>&),
              const PortOptions& options = {})
      : QueryServerHandle(
            owner, std::move(name), type_id(object_type<Q>()), type_id(object_type<A>()),
            [&owner, handler](const ObjectRef& request) -> Result<ObjectLoan> {
              Result<Loan<A>> answer = (owner.*handler)(object_cast<Q>(request));
              if (!answer) return answer.error();
              return ObjectLoan(std::move(answer).value());
            },
            options) {}
};

/// The untyped part of QueryProxy.
class QueryProxyHandle {
 public:
  QueryProxyHandle(PortOwner& owner, std::string name, TypeId request, TypeId reply,
                   const PortOptions& options);
  QueryProxyHandle(const QueryProxyHandle&) = delete;
  QueryProxyHandle& operator=(const QueryProxyHandle&) = delete;

  [[nodiscard]] bool connected() const;
  [[nodiscard]] RequestCounters counters() const;
  /// Returns how often the server's process was replaced by a new one since this component was built; nothing if
  /// the server is in this process, or the port is not connected.
  ///
  /// A new process knows nothing of what was asked of its predecessor. Read the number before you ask: if it differs later,
  /// the answer may be its predecessor's. A wait of the component looks at its condition again
  /// when the number changes, such as Synchronizer::wait(limit, unless).
  /// @thread  the component's strand.
  [[nodiscard]] std::optional<std::uint64_t> server_restarts() const;

 protected:
  Result<ObjectRef> ask_loan(ObjectLoan loan, Duration timeout);
  Result<QueryId> request_loan(ObjectLoan loan);
  std::optional<Result<ObjectRef>> receive_ref(QueryId id);
  Result<ObjectRef> receive_wait_ref(QueryId id, Duration timeout);
  void withdraw(QueryId id);

 private:
  [[nodiscard]] QueryClientEndpoint& endpoint() const;

  Endpoint* endpoint_ = nullptr;
};

/// The client of a Query port. It asks one QueryServer (thesis 7.3, Fig. 7.5): blocking with query(), or in
/// two steps with query_request() and query_receive(), query_receive_wait() or query_forget().
///
/// The waits throw Interrupted when the component must leave its lap; let it pass. So does an error while the system
/// is being stopped, except in stop(), which gets the error.
/// Thread contract: the component's strand.
template <class Q, class A>
class QueryProxy : public QueryProxyHandle {
 public:
  QueryProxy(PortOwner& owner, std::string name, const PortOptions& options = {})
      : QueryProxyHandle(owner, std::move(name), type_id(object_type<Q>()), type_id(object_type<A>()),
                         options) {}

  [[nodiscard]] Loan<Q> loan() const { return make_object<Q>(); }

  /// Sends a question and waits for the answer.
  /// @errors  failed_precondition if not connected or called by a thread that runs no component, unavailable if
  /// refused, deadline_exceeded, or the server's own.
  Result<ObjectPtr<A>> query(Loan<Q> request, Duration timeout = 1s) {
    return typed(ask_loan(std::move(request), timeout));
  }

  /// Sends a question without waiting for the answer.
  /// @errors  failed_precondition as query(); unavailable if refused within this process. A server in
  /// another process sends its refusal as the answer.
  Result<QueryId> query_request(Loan<Q> request) { return request_loan(std::move(request)); }

  /// Returns the answer if it is there; nothing while it is not.
  std::optional<Result<ObjectPtr<A>>> query_receive(QueryId id) {
    std::optional<Result<ObjectRef>> answer = receive_ref(id);
    if (!answer) return std::nullopt;
    return typed(std::move(*answer));
  }

  /// Waits for the answer, at most `timeout`; after that the question is forgotten.
  Result<ObjectPtr<A>> query_receive_wait(QueryId id, Duration timeout = 1s) {
    return typed(receive_wait_ref(id, timeout));
  }

  /// Gives up the question: its answer is discarded, now or when it comes. Nothing is reported, because nobody has
  /// waited for it. Has no effect for an id whose answer has been taken.
  void query_forget(QueryId id) { withdraw(id); }

 private:
  static Result<ObjectPtr<A>> typed(Result<ObjectRef> answer) {
    if (!answer) return answer.error();
    return object_cast<A>(std::move(answer).value());
  }
};

}  // namespace orca
