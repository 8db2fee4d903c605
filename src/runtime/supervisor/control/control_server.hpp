// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <vector>

#include "members/reply.hpp"
#include "orca/supervisor/access.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// The clients of a system's socket. It passes on what they ask. A client costs the supervisor little, whatever it does:
/// one that sends rubbish or too many requests is cut off, and of what one does not read, little is kept.
///
/// A newcomer always finds a place, because it may come to stop the robot: of more than kMostClients, and of more than there are
/// descriptors for, the one goes that is missed least. That is one of the process with the most connections, and of those
/// rather one that waits for no answer, and the oldest. Each process keeps its first connections for kGrace, in which to ask.
///
/// Thread contract: the supervisor's thread.
class ControlServer {
 public:
  static constexpr std::size_t kMostClients = 32;
  static constexpr std::size_t kLongestAsk = std::size_t{256} << 10;  ///< [bytes]
  static constexpr std::size_t kBound = std::size_t{1} << 20;         ///< [bytes] that wait for a client.
  static constexpr int kMostAsks = 200;                               ///< Of one client within a second.
  static constexpr std::size_t kShare = 4;                            ///< First connections of a process.
  static constexpr Duration kGrace = 50ms;

  /// Carries out what a client has asked, now or later.
  /// @param asker  the client, as the system knows it: it has made the connection.
  using Handler = std::function<void(const Ask& ask, const Asker& asker, const ReplyPtr& reply)>;

  ControlServer(ControlSocket socket, Handler handler)
      : socket_(std::move(socket)), handler_(std::move(handler)) {}

  /// Adds what it waits for.
  void add_to(std::vector<pollfd>& all) const;
  /// Takes in new clients and what they ask, and sends what waits for them. Never waits. While there are no descriptors
  /// left, new clients wait, and nothing is done for them but a look now and then.
  void serve(Moment now);

  /// Makes the file of the socket again if somebody has removed it.
  /// @return whether it had been removed.
  /// @errors  as ControlSocket::restore().
  [[nodiscard]] Result<bool> restore_socket() { return socket_.restore(); }

  [[nodiscard]] std::size_t clients() const { return clients_.size(); }

 private:
  struct Client {
    std::shared_ptr<Channel> channel;
    Asker asker{};
    Moment since{};
    Moment second{};  // the beginning of the second in which requests are counted
    int asks = 0;     // since then
    std::weak_ptr<Reply> last_reply{};
  };
  void serve_all(Moment now);
  void take_in_clients(Moment now);
  [[nodiscard]] bool trim(Moment now);
  [[nodiscard]] Result<Descriptor> accept(Moment now);
  [[nodiscard]] bool drop_one(Moment now);
  [[nodiscard]] std::size_t connections_of(pid_t process) const;
  [[nodiscard]] bool is_served(Client& client, Moment now);

  ControlSocket socket_;
  const Handler handler_;
  std::list<Client> clients_;  // the oldest first
  Descriptor reserve_;         // given up for a client when there are no descriptors left
  Moment accept_at_{};         // not before, because there was no room
  bool is_full_ = false;       // meanwhile
};

}  // namespace orca::supervisor
