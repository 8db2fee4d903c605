// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"
#include "orca/patterns/request_id.hpp"

namespace orca {

/// The client's side of one Query or Send edge, as its link sees it: the destination of answers.
///
/// @tparam Answer  Result<ObjectRef> for Query: the reply, or the reason why there is none. Status for Send:
/// the object was accepted (or handled, where the edge confirms that), or the reason why not.
template <class Answer>
class ReplySink {
 public:
  virtual ~ReplySink() = default;
  /// Takes the answer to an offer that was not answered at once.
  /// @thread  any task; called with the server's lock held: must not call the target back.
  virtual void reply(RequestId id, Answer answer) = 0;
};

/// The server's side of one Query or Send edge, as its link sees it: the destination of questions and sent
/// objects.
///
/// Thread contract: one task at a time.
template <class Answer>
class RequestTarget {
 public:
  virtual ~RequestTarget() = default;

  /// Accepts or refuses the object; never blocks.
  /// @param may_wait  whether the client waits for the answer: a full Send server then keeps the offer until it has room,
  /// and a link may use the client's thread. Where the edge's policy is `block`, a server keeps every offer.
  /// @return the answer if it is there at once, as every refusal is within a process; otherwise it comes
  /// through `reply_to`.
  virtual std::optional<Answer> offer(const ObjectRef& object, ReplySink<Answer>& reply_to, RequestId id,
                                      bool may_wait) = 0;
  /// Takes back an offer for which the client no longer waits. If it has not been accepted by now, it never
  /// will be.
  virtual void withdraw(RequestId id) = 0;
  /// Returns how long a client should wait for an outcome of Send that does not come at once [s].
  [[nodiscard]] virtual Duration patience() const = 0;
  /// Returns "component.port" of the server.
  [[nodiscard]] virtual std::string path() const = 0;
  /// Returns how often the server's process was replaced by a new one since the edge was made; nothing if the server
  /// is in the client's process.
  /// @thread  any.
  [[nodiscard]] virtual std::optional<std::uint64_t> renewals() const { return std::nullopt; }
};

using QueryReplySink = ReplySink<Result<ObjectRef>>;
using QueryTarget = RequestTarget<Result<ObjectRef>>;
using SendReplySink = ReplySink<Status>;
using SendTarget = RequestTarget<Status>;

}  // namespace orca
