// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoints/alternatives.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"
#include "orca/patterns/endpoints/pending_answers.hpp"
#include "orca/patterns/endpoints/published.hpp"
#include "orca/patterns/endpoints/request_link.hpp"

namespace orca {

/// The common part of the clients of Query and Send: it offers an object to the server under an id and waits
/// for the answer.
///
/// @tparam Answer  the same as for ReplySink.
/// Thread contract: reply() from the server's side of the link, counters() from any thread, the rest from the
/// client's strand.
template <class Answer>
class RequestClient : public Endpoint, public MovablePort, public ReplySink<Answer> {
 public:
  /// Connects the port. If it can move, this is one more server to choose from; otherwise what it offers from now on goes to
  /// this one.
  /// @thread  before the component runs, or its strand between two laps.
  void connect(RequestTarget<Answer>& target);
  /// Lets the port use a server no more. Its open requests get an error at once, and the server is not touched any
  /// more; it drops these requests when its end of the connection goes. Nothing if the port has never used it.
  /// @pre  !can_move()
  /// @thread  as connect().
  void disconnect(const std::string& server);
  [[nodiscard]] bool connected() const { return target_ != nullptr; }

  void allow_moves() override;
  [[nodiscard]] bool can_move() const override { return alternatives_.has_value(); }
  bool move_to(const std::string& server) override;
  /// Returns "component.port" of the present server.
  /// @pre  connected()
  /// @thread  the component's strand.
  [[nodiscard]] std::string server() const { return target_->path(); }

  /// Returns the answer, or nothing while there is none yet. An answer that is an error goes to the observer,
  /// too.
  ///
  /// On a strand that is ending, an error is neither returned nor reported nor counted: the server may have ended
  /// first, and that is no news. Only a stop() hook gets it, because it goes on after a refusal.
  /// @errors  not_found for an id that was never given or whose answer has been taken; throws Interrupted for an
  ///          error on a strand that is ending.
  std::optional<Answer> receive(RequestId id);

  /// Blocks until the answer is there. At the deadline it withdraws the object and forgets its answer. On a strand
  /// that is ending, a missed deadline is an error as in receive().
  /// @errors  deadline_exceeded; throws Interrupted.
  Answer receive_until(RequestId id, TimePoint deadline);

  /// Withdraws the object. Its answer is discarded, now or when it comes.
  void withdraw(RequestId id);

  /// Takes in what has arrived, and returns RequestTarget::renewals(); nothing if not connected. If the port can move or has
  /// been moved, a move counts as well, and there is always a number.
  [[nodiscard]] std::optional<std::uint64_t> server_restarts() const;

  void reply(RequestId id, Answer answer) override;

  [[nodiscard]] RequestCounters counters() const;

 protected:
  /// The parts of the error texts in which the patterns differ.
  struct Words {
    const char* unknown;      ///< "PATH has ... 7"
    const char* late;         ///< "SERVER ... PATH"
    const char* late_ending;  ///< "PATH ..."
  };
  struct Offered {
    RequestId id;
    bool answered;  ///< receive() has something.
  };

  RequestClient(PortHome& home, PortContract contract, const Words& words);
  /// Stamps the object and offers it to the server. An object that is sent waits for the lap's computing; a question does not,
  /// because its answer is a part of that.
  /// @errors  failed_precondition if not connected, or if the calling thread runs no component; throws Interrupted if the
  ///          strand must end before the lap has computed.
  Result<Offered> offer(ObjectLoan loan, const Provenance* provenance, bool may_wait);
  /// @pre  connected()
  [[nodiscard]] RequestTarget<Answer>& target() const { return *target_; }

 private:
  using Pending = PendingAnswers<Answer>;

  // The requests from an id on, which went to one target until the next one took over.
  struct Era {
    RequestId first;
    RequestTarget<Answer>* target;  // null: none, or it is gone
    std::string path;               // of the target
  };

  void move(RequestTarget<Answer>* target);
  void answer_all_of(const Era& era);
  [[nodiscard]] Era present() const;
  [[nodiscard]] Era era_of(RequestId id) const;
  void report(const std::string& server, const std::string& failure) const;
  void leave_if_ending() const;

  const Words words_;
  RequestTarget<Answer>* target_ = nullptr;
  std::string target_path_;                                          // of the target, or of the last one
  std::optional<Alternatives<RequestTarget<Answer>>> alternatives_;  // if the port can move
  std::vector<Era> left_;              // the targets before this one, and the first id that each got
  RequestId first_id_ = 1;             // of the present target
  RequestId last_id_ = 0;              // that was given
  std::uint64_t restarts_before_ = 0;  // to be added to the renewals of the present target
  Pending pending_;
  Published<std::uint64_t> sent_;
  Published<std::uint64_t> answered_;
  Published<std::uint64_t> failed_;
  Published<std::uint64_t> timed_out_;
};

extern template class RequestClient<Result<ObjectRef>>;
extern template class RequestClient<Status>;

}  // namespace orca
