// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/trial/questioner.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "orca/idl/object_type.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::supervisor {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Duration kServerLimit = 2s;
constexpr Duration kLookAround = 50ms;                         // between two questions whether to give up
constexpr std::size_t kMostQuestions = 100;                    // that differ, in one trial
constexpr std::size_t kLongestAnswer = std::size_t{64} << 20;  // [bytes], as of a large map

Result<ObjectRef> object_in(const OfferOutcome& answer) {
  if (!answer.outcome.ok()) return answer.outcome.error();
  const ObjectType* const type = find_object_type(answer.type);
  if (type == nullptr) return fail(Code::data_loss, "the answer is of an unknown type, " + answer.type);
  ObjectLoan object = make_object(*type);
  if (Status read = type->deserialize(answer.object, object.get()); !read.ok()) return read.error();
  return std::move(object).seal();
}

}  // namespace

Questioner::Questioner(std::vector<ServerLine> lines, std::function<bool()> give_up)
    : give_up_(std::move(give_up)) {
  for (ServerLine& line : lines)
    lines_[line.server] =
        std::make_unique<Channel>(std::move(line.line), Channel::kDefaultBound, kLongestAnswer);
}

Result<ObjectRef> Questioner::ask(const graph::PortRef& server, ObjectLoan question) {
  question.header() = idl::OrcaObject();  // it says when and by whom it was asked
  std::vector<std::byte> bytes;
  question.type().serialize(question.get(), bytes);
  const auto known = known_.find({server, bytes});
  if (known != known_.end()) return known->second;
  if (known_.size() == kMostQuestions)
    return note_silence(server, "more than " + std::to_string(kMostQuestions) +
                                    " different questions are not asked in a trial");
  Result<ObjectRef> answer = ask_for_real(server, std::string(question.type().name), bytes);
  known_.emplace(std::pair(server, std::move(bytes)), answer);
  return answer;
}

Result<ObjectRef> Questioner::ask_for_real(const graph::PortRef& server, const std::string& type,
                                           const std::vector<std::byte>& bytes) {
  const auto line = lines_.find(server);
  if (line == lines_.end()) return note_silence(server, "its process takes no questions now");
  Channel& channel = *line->second;
  const std::uint64_t request = ++last_request_;
  if (const Status sent = channel.post(encode(LineWord(Offer{type, bytes}), request)); !sent.ok())
    return note_silence(server, sent.error().message);
  for (const auto end = Clock::now() + kServerLimit; Clock::now() < end && !give_up_();) {
    Result<Message> message = channel.wait_for_message(kLookAround);
    if (!message && message.error().code == Code::deadline_exceeded) continue;
    if (!message) return note_silence(server, message.error().message);
    const bool is_this = message->request == request;  // another one came too late
    const Result<LineWord> word = decode_line_word(std::move(message).value());
    const auto* const answer = word ? std::get_if<OfferOutcome>(&*word) : nullptr;
    if (answer == nullptr) return note_silence(server, "its process has said something impossible");
    if (is_this) return object_in(*answer);
  }
  return note_silence(server, "it has not answered within 2 s");
}

// Whoever is silent once is not asked again: the trial would take too long.
Error Questioner::note_silence(const graph::PortRef& server, const std::string& why) {
  lines_.erase(server);
  if (silence_.empty()) silence_ = "what it asks " + server.text() + " gets no answer: " + why;
  return fail(Code::unavailable, why, server.text());
}

}  // namespace orca::supervisor
