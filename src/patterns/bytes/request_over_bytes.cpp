// SPDX-License-Identifier: LGPL-3.0-or-later
#include "request_over_bytes.hpp"

#include <algorithm>
#include <utility>

namespace orca::bytes {
namespace {

constexpr Duration kConfirmLimit = 1s;
constexpr std::uint64_t kGood = 0;  // code of an answer that is no error; errors are counted from 1

Error unexpected(const FrameReader& frame) {
  return fail(Code::data_loss, "a frame of kind " + std::to_string(static_cast<int>(frame.kind())) +
                                   " does not belong to Query or Send, or not in this direction");
}

void add_object(FrameWriter& frame, const Result<ObjectRef>& answer) { frame.add(*answer); }
void add_object(FrameWriter& /*frame*/, const Status& /*outcome*/) {}

template <class Answer>
FrameWriter answer_frame(RequestId id, const Answer& answer) {
  FrameWriter frame(FrameKind::answer, id);
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
TargetOverBytes<Answer>::TargetOverBytes(Connection connection, const RequestTypes& types, std::string path,
                                         Duration patience)
    : types_(types),
      path_(std::move(path)),
      patience_(patience > Duration{0} ? patience : kConfirmLimit),
      confirmed_(connection.executive.make_event()),
      end_(std::move(connection)) {
  end_.start([this](FrameReader& frame) { return receive(frame); },
             [this](const Error& reason) { close(reason); });
}

template <class Answer>
std::optional<Answer> TargetOverBytes<Answer>::offer(const ObjectRef& object, ReplySink<Answer>& reply_to,
                                                     RequestId id, bool may_wait) {
  const std::lock_guard lock(mutex_);
  if (closed_) return *closed_;
  open_.push_back({id, &reply_to});
  FrameWriter frame(FrameKind::offer, id);
  frame.add(std::uint64_t{may_wait});
  frame.add(object);
  end_.send(std::move(frame));
  return std::nullopt;
}

template <class Answer>
void TargetOverBytes<Answer>::withdraw(RequestId id) {
  end_.send(FrameWriter(FrameKind::withdraw, id));
  Executive& executive = end_.executive();
  const TimePoint limit = saturating_add(executive.now(), kConfirmLimit);
  while (!is_withdrawn(id) && executive.now() < limit) confirmed_->wait_until(limit);
  (void)take(id);
}

template <class Answer>
bool TargetOverBytes<Answer>::is_withdrawn(RequestId id) const {
  const std::lock_guard lock(mutex_);
  return withdrawn_ == id || closed_.has_value();
}

template <class Answer>
std::optional<typename TargetOverBytes<Answer>::Open> TargetOverBytes<Answer>::take(RequestId id) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(open_, id, &Open::id);
  if (found == open_.end()) return std::nullopt;
  const Open open = *found;
  open_.erase(found);
  return open;
}

template <class Answer>
Status TargetOverBytes<Answer>::receive(FrameReader& frame) {
  if (frame.kind() == FrameKind::withdrawn) {
    {
      const std::lock_guard lock(mutex_);
      withdrawn_ = frame.number();
    }
    confirmed_->notify();
    return ok();
  }
  if (frame.kind() != FrameKind::answer) return unexpected(frame);
  std::optional<Answer> answer;
  if (Status read = read_answer(frame, types_, answer); !read.ok()) return read;
  if (const auto open = take(frame.number())) open->reply_to->reply(open->id, std::move(*answer));
  return ok();
}

// Closes everything that is still open, because no answer can come any more.
template <class Answer>
void TargetOverBytes<Answer>::close(const Error& reason) {
  const Error error =
      fail(Code::unavailable, path_ + " cannot be reached: the link was cut, because " + reason.message);
  std::vector<Open> left;
  {
    const std::lock_guard lock(mutex_);
    closed_ = error;
    left.swap(open_);
  }
  for (const Open& open : left) open.reply_to->reply(open.id, error);
  confirmed_->notify();
}

template <class Answer>
CallerOverBytes<Answer>::CallerOverBytes(Connection connection, const RequestTypes& types,
                                         RequestTarget<Answer>& target)
    : types_(types), target_(target), end_(std::move(connection)) {
  end_.start([this](FrameReader& frame) { return receive(frame); }, [](const Error&) {});
}

template <class Answer>
Status CallerOverBytes<Answer>::receive(FrameReader& frame) {
  if (frame.kind() == FrameKind::withdraw) {
    target_.withdraw(frame.number());
    end_.send(FrameWriter(FrameKind::withdrawn, frame.number()));
    return ok();
  }
  if (frame.kind() != FrameKind::offer) return unexpected(frame);
  const bool may_wait = frame.read_number() != 0;
  const Result<ObjectRef> object = frame.read_object(types_.request);
  if (!object) return object.error();
  if (auto at_once = target_.offer(*object, *this, frame.number(), may_wait))
    reply(frame.number(), std::move(*at_once));
  return ok();
}

template <class Answer>
void CallerOverBytes<Answer>::reply(RequestId id, Answer answer) {
  end_.send(answer_frame(id, answer));
}

template class TargetOverBytes<Result<ObjectRef>>;
template class TargetOverBytes<Status>;
template class CallerOverBytes<Result<ObjectRef>>;
template class CallerOverBytes<Status>;

}  // namespace orca::bytes
