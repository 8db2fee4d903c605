// SPDX-License-Identifier: LGPL-3.0-or-later
#include "request_over_frames.hpp"

#include <algorithm>
#include <utility>

namespace orca::frames {
namespace {

constexpr Duration kConfirmLimit = 1s;
constexpr std::uint64_t kGood = 0;  // code of an answer that is no error; errors are counted from 1

void add_object(Frame& frame, const Result<ObjectRef>& answer) { frame.add(*answer); }
void add_object(Frame& /*frame*/, const Status& /*outcome*/) {}

template <class Answer>
Frame answer_frame(RequestId id, const Answer& answer) {
  Frame frame(FrameKind::answer, id);
  const Error error = answer ? Error{} : answer.error();
  frame.add(answer ? kGood : static_cast<std::uint64_t>(error.code) + 1);
  frame.add(error.message);
  frame.add(error.where);
  if (answer) add_object(frame, answer);
  return frame;
}

// Reads the part that follows an answer's head when it is no error.
Status read_rest(FrameReader& frame, const RequestTypes& types, std::optional<Result<ObjectRef>>& answer) {
  Result<ObjectRef> object = frame.read_object(*types.reply);
  if (!object) return object.error();  // the fault of the link, not the answer
  answer.emplace(std::move(object));
  return ok();
}
Status read_rest(FrameReader& frame, const RequestTypes& /*types*/, std::optional<Status>& outcome) {
  outcome.emplace();
  return frame.status();
}

template <class Answer>
Status read_answer(FrameReader& frame, const RequestTypes& types, std::optional<Answer>& answer) {
  const std::uint64_t code = frame.read_number();
  std::string message = frame.read_text();
  std::string where = frame.read_text();
  if (code == kGood) return read_rest(frame, types, answer);
  if (code > static_cast<std::uint64_t>(Code::internal) + 1)
    return fail(Code::data_loss, "an answer with the unknown code " + std::to_string(code));
  answer.emplace(fail(static_cast<Code>(code - 1), std::move(message), std::move(where)));
  return frame.status();
}

}  // namespace

template <class Answer>
TargetOverFrames<Answer>::TargetOverFrames(std::unique_ptr<FrameEnd> end, Strand& strand,
                                           const RequestTypes& types, std::string path, Duration patience)
    : strand_(strand),
      types_(types),
      path_(std::move(path)),
      patience_(patience > Duration{0} ? patience : kConfirmLimit),
      end_(std::move(end)) {
  end_->start({[this](FrameReader& frame) { return receive(frame); },
               [this](const Error& reason) { close(reason); }, [this] { open_again(); }});
}

template <class Answer>
std::optional<Answer> TargetOverFrames<Answer>::offer(const ObjectRef& object, ReplySink<Answer>& reply_to,
                                                      RequestId id, bool may_wait) {
  const MutexLock lock(mutex_);
  if (closed_) return *closed_;
  Frame frame(FrameKind::offer, id);
  frame.add(std::uint64_t{may_wait});
  frame.add(object);
  const Sent outcome = end_->send(frame, Loss::allowed, may_wait ? Caller::waits : Caller::goes_on);
  if (outcome == Sent::no_room || outcome == Sent::too_large) return refusal(outcome);
  open_.push_back({id, &reply_to});  // if the link has just been cut, close() answers it
  return std::nullopt;
}

template <class Answer>
Error TargetOverFrames<Answer>::refusal(Sent outcome) const {
  if (outcome == Sent::too_large)
    return fail(Code::invalid_argument, "the object is larger than what the link to " + path_ + " can carry");
  return fail(Code::unavailable,
              path_ + " was not reached: its queue between the processes is full; send again later");
}

template <class Answer>
void TargetOverFrames<Answer>::withdraw(RequestId id) {
  end_->send(Frame(FrameKind::withdraw, id));
  const Executive& executive = strand_.executive();
  const TimePoint limit = saturating_add(executive.now(), kConfirmLimit);
  while (executive.runs_here() && !is_withdrawn(id) && executive.now() < limit) strand_.pause_until(limit);
  (void)take(id);
}

template <class Answer>
bool TargetOverFrames<Answer>::is_withdrawn(RequestId id) const {
  const MutexLock lock(mutex_);
  return withdrawn_ == id || closed_.has_value();
}

template <class Answer>
std::optional<typename TargetOverFrames<Answer>::Open> TargetOverFrames<Answer>::take(RequestId id) {
  const MutexLock lock(mutex_);
  const auto found = std::ranges::find(open_, id, &Open::id);
  if (found == open_.end()) return std::nullopt;
  const Open open = *found;
  open_.erase(found);
  return open;
}

template <class Answer>
Status TargetOverFrames<Answer>::receive(FrameReader& frame) {
  if (frame.kind() == FrameKind::withdrawn) {
    {
      const MutexLock lock(mutex_);
      withdrawn_ = frame.number();
    }
    strand_.wake();
    return ok();
  }
  if (frame.kind() != FrameKind::answer) return unexpected(frame, "Query or Send");
  std::optional<Answer> answer;
  if (Status read = read_answer(frame, types_, answer); !read.ok()) return read;
  if (const auto open = take(frame.number())) open->reply_to->reply(open->id, std::move(*answer));
  return ok();
}

// Closes everything that is still open, because no answer can come any more.
template <class Answer>
void TargetOverFrames<Answer>::close(const Error& reason) {
  const Error error =
      fail(Code::unavailable, path_ + " cannot be reached: the link was cut, because " + reason.message);
  std::vector<Open> left;
  {
    const MutexLock lock(mutex_);
    closed_ = error;
    left.swap(open_);
  }
  for (const Open& open : left) open.reply_to->reply(open.id, error);
  strand_.wake();
}

template <class Answer>
void TargetOverFrames<Answer>::open_again() {
  {
    const MutexLock lock(mutex_);
    closed_.reset();
  }
  ++renewals_;
}

template <class Answer>
CallerOverFrames<Answer>::CallerOverFrames(std::unique_ptr<FrameEnd> end, const RequestTypes& types,
                                           RequestTarget<Answer>& target)
    : types_(types), target_(target), end_(std::move(end)) {
  end_->start({[this](FrameReader& frame) { return receive(frame); },
               [this](const Error& /*reason*/) { lose_client(); }, [] {}});
}

template <class Answer>
Status CallerOverFrames<Answer>::receive(FrameReader& frame) {
  if (frame.kind() == FrameKind::offer) return receive_offer(frame);
  if (frame.kind() != FrameKind::withdraw) return unexpected(frame, "Query or Send");
  withdraw(frame.number());
  return ok();
}

template <class Answer>
Status CallerOverFrames<Answer>::receive_offer(FrameReader& frame) {
  const bool may_wait = frame.read_number() != 0;
  const Result<ObjectRef> object = frame.read_object(types_.request);
  if (!object) return object.error();
  const RequestId id = open(frame.number());
  if (auto at_once = target_.offer(*object, *this, id, may_wait)) reply(id, std::move(*at_once));
  return ok();
}

template <class Answer>
void CallerOverFrames<Answer>::withdraw(RequestId of_client) {
  if (const auto open = take(of_client, &Open::of_client)) target_.withdraw(open->id);
  end_->send(Frame(FrameKind::withdrawn, of_client));
}

template <class Answer>
void CallerOverFrames<Answer>::lose_client() {
  std::vector<Open> left;
  {
    const MutexLock lock(mutex_);
    left.swap(open_);
  }
  for (const Open& open : left) target_.withdraw(open.id);
}

template <class Answer>
RequestId CallerOverFrames<Answer>::open(RequestId of_client) {
  const MutexLock lock(mutex_);
  open_.push_back({++last_id_, of_client});
  return last_id_;
}

// Takes the request for which one of the two ids is the given one.
template <class Answer>
std::optional<typename CallerOverFrames<Answer>::Open> CallerOverFrames<Answer>::take(RequestId id,
                                                                                      RequestId Open::*by) {
  const MutexLock lock(mutex_);
  const auto found = std::ranges::find(open_, id, by);
  if (found == open_.end()) return std::nullopt;
  const Open open = *found;
  open_.erase(found);
  return open;
}

template <class Answer>
void CallerOverFrames<Answer>::reply(RequestId id, Answer answer) {
  if (const auto open = take(id, &Open::id)) send_answer(open->of_client, answer);
}

template <class Answer>
void CallerOverFrames<Answer>::send_answer(RequestId of_client, const Answer& answer) {
  if (end_->send(answer_frame(of_client, answer)) != Sent::too_large) return;
  const Answer instead =
      fail(Code::unavailable, target_.path() + " has an answer that is larger than what the link can carry");
  end_->send(answer_frame(of_client, instead));
}

template class TargetOverFrames<Result<ObjectRef>>;
template class TargetOverFrames<Status>;
template class CallerOverFrames<Result<ObjectRef>>;
template class CallerOverFrames<Status>;

}  // namespace orca::frames
