// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame_end.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/strand.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/request_link.hpp"

namespace orca::frames {

/// The types of the objects that an edge of Query or Send carries; those that travel may be derived from them.
struct RequestTypes {
  const ObjectType& request;
  const ObjectType* reply;  ///< Null for Send.
};

/// The client's end of a Query or Send edge. It stands for the server's target.
///
/// Thread contract: as RequestTarget.
template <class Answer>
class TargetOverFrames final : public RequestTarget<Answer>, public LinkEnd {
 public:
  /// @param strand    of the client.
  /// @param path      of the server.
  /// @param patience  [s] with which a client waits for an outcome that does not come at once; 0: 1 s.
  TargetOverFrames(std::unique_ptr<FrameEnd> end, Strand& strand, const RequestTypes& types, std::string path,
                   Duration patience);
  ~TargetOverFrames() override { end_->stop(); }

  std::optional<Answer> offer(const ObjectRef& object, ReplySink<Answer>& reply_to, RequestId id,
                              bool may_wait) override;
  /// Withdraws the request and waits until the server has confirmed that, at most 1 s. On a thread that runs no
  /// component it does not wait.
  void withdraw(RequestId id) override;
  [[nodiscard]] Duration patience() const override { return patience_; }
  [[nodiscard]] std::string path() const override { return path_; }
  [[nodiscard]] std::optional<std::uint64_t> renewals() const override { return renewals_; }

 private:
  struct Open {
    RequestId id;
    ReplySink<Answer>* reply_to;
  };

  Status receive(FrameReader& frame);
  void close(const Error& reason);
  void open_again();
  [[nodiscard]] Error refusal(Sent outcome) const;
  std::optional<Open> take(RequestId id);
  [[nodiscard]] bool is_withdrawn(RequestId id) const;

  Strand& strand_;
  const RequestTypes types_;
  const std::string path_;
  const Duration patience_;
  std::atomic<std::uint64_t> renewals_{0};

  mutable Mutex mutex_;
  std::vector<Open> open_ ORCA_GUARDED_BY(mutex_);       // offered and not yet answered
  RequestId withdrawn_ ORCA_GUARDED_BY(mutex_) = 0;      // the last one that was confirmed
  std::optional<Error> closed_ ORCA_GUARDED_BY(mutex_);  // because the link was cut

  const std::unique_ptr<FrameEnd> end_;  // the last member: its handlers use the others
};

/// The server's end of a Query or Send edge. It stands for the client. It gives each request an id of its own, so
/// that a late answer to a client that is lost does not reach the next one.
///
/// Thread contract: as ReplySink.
template <class Answer>
class CallerOverFrames final : public ReplySink<Answer>, public LinkEnd {
 public:
  CallerOverFrames(std::unique_ptr<FrameEnd> end, const RequestTypes& types, RequestTarget<Answer>& target);
  ~CallerOverFrames() override { end_->stop(); }

  void reply(RequestId id, Answer answer) override;

 private:
  struct Open {
    RequestId id;
    RequestId of_client;
  };

  Status receive(FrameReader& frame);
  Status receive_offer(FrameReader& frame);
  void withdraw(RequestId of_client);
  void lose_client();
  RequestId open(RequestId of_client);
  std::optional<Open> take(RequestId id, RequestId Open::*by);
  void send_answer(RequestId of_client, const Answer& answer);

  const RequestTypes types_;
  RequestTarget<Answer>& target_;

  Mutex mutex_;
  std::vector<Open> open_ ORCA_GUARDED_BY(mutex_);  // offered and not yet answered
  RequestId last_id_ ORCA_GUARDED_BY(mutex_) = 0;
  const std::unique_ptr<FrameEnd> end_;  // the last member: its handlers use the others
};

extern template class TargetOverFrames<Result<ObjectRef>>;
extern template class TargetOverFrames<Status>;
extern template class CallerOverFrames<Result<ObjectRef>>;
extern template class CallerOverFrames<Status>;

}  // namespace orca::frames
