// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "system_link.hpp"

#include <chrono>

#include "orca/base/exhaustion.hpp"

namespace orca::view {
namespace {

constexpr std::chrono::milliseconds kRetry{500};
constexpr int kMostInSecond = 150;                           // ControlServer::kMostAsks is 200
constexpr std::size_t kLongestAsk = std::size_t{200} << 10;  // [bytes] ControlServer::kLongestAsk is 256 KiB
constexpr std::size_t kMostQueued = 1000;

}  // namespace

SystemLink::SystemLink(const boost::asio::any_io_executor& loop, std::string system, Connect connect,
                       std::function<void(bool)> changed)
    : loop_(loop),
      system_(std::move(system)),
      connect_(std::move(connect)),
      changed_(std::move(changed)),
      retry_(loop),
      second_(loop) {}

SystemLink::~SystemLink() {
  if (wire_) wire_->close();
}

void SystemLink::start() {
  Result<Descriptor> socket = contain_exhaustion([this]() -> Result<Descriptor> { return connect_(); });
  wire_ = socket ? Wire::make(loop_, std::move(socket).value()) : nullptr;
  if (!wire_) return try_later();
  wire_->start([this](supervisor::Message message) { take(std::move(message)); },
               [this](const Error& why) { lose(why); });
  changed_(true);
}

void SystemLink::try_later() {
  retry_.expires_after(kRetry);
  retry_.async_wait([this](const boost::system::error_code& error) {
    if (!error) start();
  });
}

void SystemLink::ask(supervisor::Ask ask, Taker take, Done done) {
  if (!wire_) return done(fail(Code::unavailable, "the system " + system_ + " does not run"));
  std::size_t size = ask.command.size();
  for (const std::string& word : ask.words) size += word.size();
  if (size > kLongestAsk || waiting_.size() >= kMostQueued)
    return done(fail(Code::invalid_argument,
                     size > kLongestAsk ? "the question is too long" : "too many questions wait"));
  const std::uint64_t request = ++last_request_;
  open_.emplace(request, Question{std::move(take), std::move(done)});
  if (asked_ >= kMostInSecond && ask.command != "estop")
    return waiting_.emplace_back(request, std::move(ask)), void();
  send(request, std::move(ask));
}

void SystemLink::send(std::uint64_t request, supervisor::Ask ask) {
  if (asked_++ == 0) {
    second_.expires_after(std::chrono::seconds(1));
    second_.async_wait([this](const boost::system::error_code& error) {
      if (!error) send_waiting();
    });
  }
  const Status sent = wire_ ? wire_->post(supervisor::encode(std::move(ask), request))
                            : fail(Code::unavailable, "the system " + system_ + " has ended");
  if (sent.ok()) return;
  const auto question = open_.extract(request);
  if (question) question.mapped().done(sent);
}

void SystemLink::send_waiting() {
  asked_ = 0;
  while (!waiting_.empty() && asked_ < kMostInSecond) {
    auto [request, ask] = std::move(waiting_.front());
    waiting_.pop_front();
    send(request, std::move(ask));
  }
}

void SystemLink::take(supervisor::Message message) {
  const auto question = open_.find(message.request);
  if (question == open_.end()) return;
  Result<supervisor::ControlAnswer> answer = supervisor::decode_answer(std::move(message));
  if (!answer) return lose(answer.error());
  const auto* const end = std::get_if<supervisor::EndAnswer>(&*answer);
  if (end == nullptr) return question->second.take(std::move(*answer));
  const Done done = std::move(question->second.done);
  open_.erase(question);
  done(end->outcome);
}

void SystemLink::lose(const Error& /*why*/) {
  if (wire_) wire_->close();
  wire_ = nullptr;
  waiting_.clear();
  const std::map<std::uint64_t, Question> asked = std::exchange(open_, {});
  for (const auto& [request, question] : asked)
    question.done(fail(Code::unavailable, "the system " + system_ + " has ended"));
  changed_(false);
  try_later();
}

}  // namespace orca::view
