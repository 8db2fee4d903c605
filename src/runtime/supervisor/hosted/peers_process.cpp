// SPDX-License-Identifier: LGPL-3.0-or-later
#include "peers_process.hpp"

#include <poll.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <utility>

#include "orca/base/files/own_library.hpp"
#include "orca/supervisor/bulletin.hpp"
#include "orca/supervisor/own_process.hpp"

namespace orca::supervisor {
namespace {

constexpr std::size_t kLongest = std::size_t{64} << 10;  // [bytes] of a state
constexpr int kMostInASecond = 500;                      // states; more are a flood

// Lets through what a supervisor can cope with, whoever floods the network.
class FloodGate {
 public:
  bool lets_through(std::size_t bytes) {
    const auto now = std::chrono::steady_clock::now();
    if (now - since_ > std::chrono::seconds(1)) since_ = now, count_ = 0;
    return bytes <= kLongest && ++count_ <= kMostInASecond;
  }

 private:
  std::chrono::steady_clock::time_point since_{};
  int count_ = 0;
};

Result<std::unique_ptr<Bulletin>> open_bulletin(const Meet& meet, Channel& channel) {
  const auto open = late_function<decltype(orca_open_bulletin)>("liborca_bulletin.so", "orca_open_bulletin");
  if (!open) return open.error();
  auto gate = std::make_shared<FloodGate>();
  const auto hear = [&channel, gate](std::span<const std::byte> state) {
    if (gate->lets_through(state.size()))
      (void)channel.post(encode(Report(HeardReport{{state.begin(), state.end()}})));
  };
  Error error;
  std::unique_ptr<Bulletin> bulletin(
      open->get()({meet.type, meet.topic, meet.address, meet.interface, meet.others, meet.domain, meet.keys},
                  hear, error));
  if (bulletin == nullptr) return error;
  return bulletin;
}

// Waits until the supervisor has said something, or can take more of what waits for it.
void wait(const Channel& channel) {
  constexpr int kFlushMs = 50;  // what another thread could not send waits for this long at most
  const short events = channel.has_unsent() ? POLLIN | POLLOUT : POLLIN;
  pollfd fd{channel.descriptor(), events, 0};
  poll(&fd, 1, kFlushMs);
}

}  // namespace

Status carry_states(Channel& channel, const Meet& meet, std::uint64_t request) {
  set_process_name(meet.name);
  std::signal(SIGTERM, SIG_IGN);  // it ends with the supervisor, after the others have heard of its end
  Result<std::unique_ptr<Bulletin>> bulletin = open_bulletin(meet, channel);
  const Status opened = bulletin ? ok() : Status(bulletin.error());
  if (Status told = channel.post(encode(Report(Answer{opened}), request)); !told.ok() || !opened.ok())
    return opened.ok() ? told : opened;
  for (;;) {
    wait(channel);
    (void)channel.flush();  // its error comes back from receive()
    Result<std::optional<Message>> message = channel.receive();
    if (!message) return message.error();
    if (!message->has_value()) continue;
    const std::uint64_t number = (*message)->request;
    const Result<Order> order = decode_order(std::move(**message));
    if (!order) return order.error();
    if (const auto* say = std::get_if<Say>(&*order)) (*bulletin)->say(say->state);
    (void)channel.post(encode(Report(Answer{ok()}), number));
    if (std::holds_alternative<TakeDown>(*order)) return ok();
  }
}

}  // namespace orca::supervisor
