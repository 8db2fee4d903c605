// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/control_server.hpp"

#include <utility>

#include "orca/base/log.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kFullPause = 200ms;  // until the next look for descriptors
constexpr int kMostAtOnce = 16;         // messages of one client; the robot's processes want to be heard, too

}  // namespace

void ControlServer::add_to(std::vector<pollfd>& all) const {
  if (!is_full_) all.push_back({socket_.descriptor(), POLLIN, 0});
  for (const Client& client : clients_) {
    const short events = client.channel->has_unsent() ? POLLIN | POLLOUT : POLLIN;
    all.push_back({client.channel->descriptor(), events, 0});
  }
}

void ControlServer::serve(Moment now) {
  take_in_clients(now);
  std::erase_if(clients_, [&](Client& client) { return !is_served(client, now); });
}

void ControlServer::take_in_clients(Moment now) {
  if (is_full_ && now < accept_at_) return;
  for (;;) {
    Result<Descriptor> client = socket_.accept();
    is_full_ = !client;
    accept_at_ = now + kFullPause;
    if (!client || !*client) return;
    if (clients_.size() == kMostClients) clients_.pop_front();
    clients_.push_back({std::make_shared<Channel>(std::move(client).value(), kBound, kLongestAsk)});
  }
}

// Returns false if the client is gone, or is to be cut off.
bool ControlServer::is_served(Client& client, Moment now) {
  if (!client.channel->flush().ok()) return false;
  if (now - client.second >= 1s) {
    client.second = now;
    client.asks = 0;
  }
  for (int i = 0; i < kMostAtOnce; ++i) {
    Result<std::optional<Message>> message = client.channel->receive();
    if (!message) return false;
    if (!message->has_value()) return true;
    if (++client.asks > kMostAsks) {
      log::warning(kLogName, "a client of the control socket asks without end, and is cut off");
      return false;
    }
    const std::uint64_t request = (*message)->request;
    const Result<Ask> ask = decode_ask(std::move(**message));
    if (!ask) return false;
    handler_(*ask, std::make_shared<Reply>(client.channel, request, ask->as_json));
  }
  return true;
}

}  // namespace orca::supervisor
