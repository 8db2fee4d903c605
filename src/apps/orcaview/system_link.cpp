// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "system_link.hpp"

#include <chrono>

#include "orca/supervisor/control_socket.hpp"

namespace orca::view {
namespace {

constexpr std::chrono::milliseconds kRetry{500};

}  // namespace

SystemLink::SystemLink(const boost::asio::any_io_executor& loop, std::string system,
                       std::function<void(bool)> changed)
    : loop_(loop), system_(std::move(system)), changed_(std::move(changed)), retry_(loop) {}

SystemLink::~SystemLink() {
  if (wire_) wire_->close();
}

void SystemLink::start() {
  Result<Descriptor> socket = supervisor::connect_to_system(system_);
  if (!socket) return try_later();
  wire_ = std::make_shared<Wire>(loop_, std::move(socket).value());
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
  const std::uint64_t request = ++last_request_;
  open_.emplace(request, Question{std::move(take), std::move(done)});
  const Status sent = wire_->post(supervisor::encode(std::move(ask), request));
  if (sent.ok()) return;
  const auto question = open_.extract(request);
  if (question) question.mapped().done(sent);
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
  const std::map<std::uint64_t, Question> asked = std::exchange(open_, {});
  for (const auto& [request, question] : asked)
    question.done(fail(Code::unavailable, "the system " + system_ + " has ended"));
  changed_(false);
  try_later();
}

}  // namespace orca::view
