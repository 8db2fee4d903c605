// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "wire.hpp"

#include <fcntl.h>

#include <optional>

#include "orca/base/exhaustion.hpp"

namespace orca::view {

using boost::asio::posix::stream_descriptor;

std::shared_ptr<Wire> Wire::make(const boost::asio::any_io_executor& loop, Descriptor socket) {
  const int copy = ::fcntl(socket.number(), F_DUPFD_CLOEXEC, 0);
  return copy < 0 ? nullptr : std::make_shared<Wire>(loop, std::move(socket), copy);
}

Wire::Wire(const boost::asio::any_io_executor& loop, Descriptor socket, int copy)
    : channel_(std::move(socket)), waiting_(loop, copy) {}

void Wire::start(Taker take, Ended ended) {
  take_ = std::move(take);
  ended_ = std::move(ended);
  wait_to_receive();
}

void Wire::wait_to_receive() {
  waiting_.async_wait(stream_descriptor::wait_read,
                      [self = shared_from_this()](const boost::system::error_code& error) {
                        if (!error) self->receive_all();
                      });
}

void Wire::receive_all() {
  constexpr int kMostAtOnce = 200;  // the pages want to be served, too
  const Taker take = take_;         // which may close this wire
  for (int i = 0; i < kMostAtOnce && waiting_.is_open(); ++i) {
    using Received = Result<std::optional<supervisor::Message>>;
    Received message = contain_exhaustion([this]() -> Received { return channel_.receive(); });
    if (!message) return end(message.error());
    if (!message->has_value()) break;
    take(std::move(**message));
  }
  if (waiting_.is_open()) wait_to_receive();
}

Status Wire::post(supervisor::Message message) {
  if (!waiting_.is_open()) return fail(Code::unavailable, "the connection has ended");
  Status sent = channel_.post(std::move(message));
  wait_to_send();
  return sent;
}

void Wire::wait_to_send() {
  if (sends_ || !channel_.has_unsent()) return;
  sends_ = true;
  waiting_.async_wait(stream_descriptor::wait_write,
                      [self = shared_from_this()](const boost::system::error_code& error) {
                        self->sends_ = false;
                        if (error) return;
                        if (self->channel_.flush().ok()) self->wait_to_send();
                      });
}

void Wire::close() {
  boost::system::error_code ignored;
  waiting_.close(ignored);
  take_ = nullptr;
  ended_ = nullptr;
}

void Wire::end(const Error& why) {
  const Ended ended = std::move(ended_);
  close();
  if (ended) ended(why);
}

}  // namespace orca::view
