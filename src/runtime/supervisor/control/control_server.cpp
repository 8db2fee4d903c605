// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/control_server.hpp"

#include <fcntl.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "orca/base/log.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kFullPause = 200ms;  // until the next look for descriptors
constexpr Duration kGracePause = 10ms;  // until the next look for a client that may go
constexpr int kMostAtOnce = 16;         // messages of one client; the robot's processes want to be heard, too
constexpr int kMostNew = 16;            // clients in a turn

}  // namespace

void ControlServer::add_to(std::vector<pollfd>& all) const {
  if (!is_full_) all.push_back({socket_.descriptor(), POLLIN, 0});
  for (const Client& client : clients_) {
    const short events = client.channel->has_unsent() ? POLLIN | POLLOUT : POLLIN;
    all.push_back({client.channel->descriptor(), events, 0});
  }
}

void ControlServer::serve(Moment now) {
  serve_all(now);  // first, so that nobody has to go who has asked something
  take_in_clients(now);
  serve_all(now);
}

void ControlServer::serve_all(Moment now) {
  std::erase_if(clients_, [&](Client& client) { return !is_served(client, now); });
}

void ControlServer::take_in_clients(Moment now) {
  if (is_full_ && now < accept_at_) return;
  is_full_ = false;
  if (!reserve_) reserve_ = Descriptor(open("/dev/null", O_RDONLY | O_CLOEXEC));
  for (int i = 0; i < kMostNew; ++i) {
    if (!trim(now)) return;
    Result<Descriptor> client = accept(now);
    if (!client || !*client) return;
    Asker asker = asker_at(*client);
    clients_.push_back(
        {std::make_shared<Channel>(std::move(client).value(), kBound, kLongestAsk), std::move(asker), now});
  }
  (void)trim(now);
}

// Returns false if one is too many, and none of them may go yet, because they are just going to ask.
bool ControlServer::trim(Moment now) {
  if (clients_.size() <= kMostClients || drop_one(now)) return true;
  is_full_ = true;
  accept_at_ = now + kGracePause;
  return false;
}

Result<Descriptor> ControlServer::accept(Moment now) {
  Result<Descriptor> client = socket_.accept();
  if (!client && (reserve_ || drop_one(now))) {
    reserve_.reset();
    client = socket_.accept();
  }
  is_full_ = !client;
  accept_at_ = now + kFullPause;
  return client;
}

// Returns false if all are to stay for now.
bool ControlServer::drop_one(Moment now) {
  const auto worth = [this](const Client& client) {
    return std::tuple(-static_cast<std::ptrdiff_t>(connections_of(client.asker.who.pid)),
                      !client.last_reply.expired(), client.since);
  };
  const auto least = std::ranges::min_element(clients_, {}, worth);
  if (least == clients_.end()) return false;
  const bool has_grace = connections_of(least->asker.who.pid) <= kShare && now - least->since < kGrace;
  if (has_grace) return false;
  clients_.erase(least);
  return true;
}

std::size_t ControlServer::connections_of(pid_t process) const {
  return static_cast<std::size_t>(
      std::ranges::count(clients_, process, [](const Client& client) { return client.asker.who.pid; }));
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
    const auto reply = std::make_shared<Reply>(client.channel, request, ask->as_json);
    client.last_reply = reply;
    handler_(*ask, client.asker, reply);
  }
  return true;
}

}  // namespace orca::supervisor
