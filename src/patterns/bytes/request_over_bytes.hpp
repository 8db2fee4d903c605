// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "byte_end.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/request_link.hpp"

namespace orca::bytes {

/// The types of the objects that an edge of Query or Send carries; those that travel may be derived from them.
struct RequestTypes {
  const ObjectType& request;
  const ObjectType* reply;  ///< Null for Send.
};

/// The client's end of a Query or Send edge. It stands for the server's target.
///
/// Thread contract: as RequestTarget.
template <class Answer>
class TargetOverBytes final : public RequestTarget<Answer>, public LinkEnd {
 public:
  /// @param path      of the server.
  /// @param patience  [s] with which a client waits for an outcome that does not come at once.
  TargetOverBytes(Connection connection, const RequestTypes& types, std::string path, Duration patience);
  ~TargetOverBytes() override { end_.stop(); }

  std::optional<Answer> offer(const ObjectRef& object, ReplySink<Answer>& reply_to, RequestId id,
                              bool may_wait) override;
  /// Withdraws the request and waits until the server has confirmed that, at most 1 s.
  void withdraw(RequestId id) override;
  [[nodiscard]] Duration patience() const override { return patience_; }
  [[nodiscard]] std::string path() const override { return path_; }

 private:
  struct Open {
    RequestId id;
    ReplySink<Answer>* reply_to;
  };

  Status receive(FrameReader& frame);
  void close(const Error& reason);
  std::optional<Open> take(RequestId id);
  [[nodiscard]] bool is_withdrawn(RequestId id) const;

  const RequestTypes types_;
  const std::string path_;
  const Duration patience_;
  std::unique_ptr<Event> confirmed_;

  mutable std::mutex mutex_;
  // Below: guarded by mutex_.
  std::vector<Open> open_;       // offered and not yet answered
  RequestId withdrawn_ = 0;      // the last one that was confirmed
  std::optional<Error> closed_;  // because the link was cut

  ByteEnd end_;  // the last member: its task uses the others
};

/// The server's end of a Query or Send edge. It stands for the client.
///
/// Thread contract: as ReplySink.
template <class Answer>
class CallerOverBytes final : public ReplySink<Answer>, public LinkEnd {
 public:
  CallerOverBytes(Connection connection, const RequestTypes& types, RequestTarget<Answer>& target);
  ~CallerOverBytes() override { end_.stop(); }

  void reply(RequestId id, Answer answer) override;

 private:
  Status receive(FrameReader& frame);

  const RequestTypes types_;
  RequestTarget<Answer>& target_;
  ByteEnd end_;  // the last member: its task uses the others
};

extern template class TargetOverBytes<Result<ObjectRef>>;
extern template class TargetOverBytes<Status>;
extern template class CallerOverBytes<Result<ObjectRef>>;
extern template class CallerOverBytes<Status>;

}  // namespace orca::bytes
