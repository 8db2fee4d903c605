// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/request_client.hpp"

#include <string>
#include <utility>

#include "orca/base/activity.hpp"

namespace orca {
namespace {

// Returns whether the caller is a stop(), which has more to do after a refusal.
bool is_stop() {
  const Activity* const activity = Activity::current();
  return activity != nullptr && activity->hook() == Hook::stop;
}

// Returns the object that an answer brings; null if it brings none.
ObjectRef object_of(const Result<ObjectRef>& answer) { return answer ? *answer : ObjectRef{}; }
ObjectRef object_of(const Status& /*outcome*/) { return {}; }

}  // namespace

template <class Answer>
RequestClient<Answer>::RequestClient(PortHome& home, PortContract contract, const Words& words)
    : Endpoint(home, std::move(contract)), words_(words) {}

template <class Answer>
void RequestClient<Answer>::connect(RequestTarget<Answer>& target) {
  if (alternatives_) alternatives_->add(target);
  if (!alternatives_ || target_ == nullptr) move(&target);
}

template <class Answer>
void RequestClient<Answer>::disconnect(const std::string& server) {
  if (target_ != nullptr && target_path_ == server) move(nullptr);
  for (Era& era : left_) {
    if (era.path != server || era.target == nullptr) continue;
    answer_all_of(era);
    era.target = nullptr;
  }
}

// Nothing is withdrawn from the server, because a wait for one that does not answer would block the strand. The server drops
// what is open when its own end goes.
template <class Answer>
void RequestClient<Answer>::answer_all_of(const Era& era) {
  const Error removed = fail(Code::unavailable, "the connection from " + path() + " to " + era.path +
                                                    " was removed before the answer came");
  for (const RequestId id : pending_.waiting())
    if (era_of(id).target == era.target) pending_.answer(id, removed);
}

template <class Answer>
void RequestClient<Answer>::allow_moves() {
  alternatives_.emplace(home().strand, [this](RequestTarget<Answer>& target) { move(&target); });
}

template <class Answer>
bool RequestClient<Answer>::move_to(const std::string& server) {
  return alternatives_ && alternatives_->want(server);
}

// Requests that the old server has are still answered by it, or withdrawn from it.
template <class Answer>
void RequestClient<Answer>::move(RequestTarget<Answer>* target) {
  if (target == target_) return;
  const auto renewals = [](const RequestTarget<Answer>* of) {
    return of == nullptr ? 0 : of->renewals().value_or(0);
  };
  if (target_ != nullptr) {
    left_.push_back(present());
    restarts_before_ += renewals(target_) + 1;
  }
  first_id_ = last_id_ + 1;
  target_ = target;
  if (target == nullptr) return;
  target_path_ = target->path();
  restarts_before_ -= renewals(target);
}

template <class Answer>
typename RequestClient<Answer>::Era RequestClient<Answer>::present() const {
  return {first_id_, target_, target_path_};
}

template <class Answer>
typename RequestClient<Answer>::Era RequestClient<Answer>::era_of(RequestId id) const {
  if (id >= first_id_) return present();
  for (auto era = left_.rbegin(); era != left_.rend(); ++era)
    if (id >= era->first) return *era;
  return present();
}

template <class Answer>
Result<typename RequestClient<Answer>::Offered> RequestClient<Answer>::offer(ObjectLoan loan,
                                                                             const Provenance* provenance,
                                                                             bool may_wait) {
  if (!admits_caller()) return foreign_call();
  if (contract().pattern == Pattern::send && !home().computing.finish()) throw Interrupted{};
  if (alternatives_) (void)alternatives_->take_in();
  if (target_ == nullptr)
    return fail(Code::failed_precondition, "port " + path() + " is not connected; add <connect from=\"" +
                                               path() + "\" to=\"...\"/> to the graph");
  stamp(loan, provenance);
  const RequestId id = last_id_ = pending_.add();
  ++sent_;
  const ObjectRef object = std::move(loan).seal();
  if (LinkObserver* observer = home().observer) observer->requested(component(), contract().name, object);
  std::optional<Answer> at_once = target_->offer(object, *this, id, may_wait);
  if (!at_once) return Offered{id, false};
  pending_.answer(id, std::move(*at_once));
  return Offered{id, true};
}

template <class Answer>
std::optional<Answer> RequestClient<Answer>::receive(RequestId id) {
  home().strand.take_in();
  std::optional<Answer> answer = pending_.take(id);
  if (!answer) {
    if (pending_.state(id) != Pending::State::unknown) return std::nullopt;
    return Answer(fail(Code::not_found, path() + " has " + words_.unknown + " " + std::to_string(id)));
  }
  if (!*answer) leave_if_ending();
  if (const ObjectRef object = object_of(*answer)) home().provenance.note(object.header());
  ++(*answer ? answered_ : failed_);
  if (!*answer) report(era_of(id).path, "refused: " + answer->error().text());
  return answer;
}

template <class Answer>
Answer RequestClient<Answer>::receive_until(RequestId id, TimePoint deadline) {
  home().strand.wait_for(deadline, [&] { return pending_.state(id) != Pending::State::waiting; });
  if (std::optional<Answer> answer = receive(id)) return std::move(*answer);
  const Era era = era_of(id);
  era.target->withdraw(id);
  if (std::optional<Answer> answer = receive(id)) return std::move(*answer);  // it came at the last moment
  pending_.forget(id);
  leave_if_ending();
  ++timed_out_;
  const Error late =
      fail(Code::deadline_exceeded, era.path + " " + words_.late + " " + path() + " " + words_.late_ending);
  report(era.path, late.message);
  return late;
}

template <class Answer>
void RequestClient<Answer>::leave_if_ending() const {
  if (home().strand.is_ending() && !is_stop()) throw Interrupted{};
}

template <class Answer>
void RequestClient<Answer>::report(const std::string& server, const std::string& failure) const {
  if (LinkObserver* observer = home().observer)
    observer->trouble(LinkTrouble::refused, path(), server, failure);
}

template <class Answer>
void RequestClient<Answer>::withdraw(RequestId id) {
  if (RequestTarget<Answer>* const target = era_of(id).target) target->withdraw(id);
  pending_.forget(id);
}

template <class Answer>
std::optional<std::uint64_t> RequestClient<Answer>::server_restarts() const {
  if (target_ == nullptr) return std::nullopt;
  home().strand.take_in();
  const std::optional<std::uint64_t> renewals = target_->renewals();
  const bool has_moved = alternatives_ || !left_.empty();
  return has_moved ? restarts_before_ + renewals.value_or(0) : renewals;
}

template <class Answer>
void RequestClient<Answer>::reply(RequestId id, Answer answer) {
  const ObjectRef object = object_of(answer);
  if (!pending_.answer(id, std::move(answer))) return;  // the client gave up waiting
  if (object) observe(object);
  home().strand.wake();
}

template <class Answer>
RequestCounters RequestClient<Answer>::counters() const {
  return {sent_, answered_, failed_, timed_out_};
}

template class RequestClient<Result<ObjectRef>>;
template class RequestClient<Status>;

}  // namespace orca
