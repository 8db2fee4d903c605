// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/supervisor/message.hpp"

namespace orca::supervisor {

class PacketJoiner;
struct Packet;

/// Two connected sockets, one for each end of a control channel. Both are closed on exec.
struct SocketPair {
  Descriptor supervisor;
  Descriptor host;
};

/// Makes the sockets of a new control channel.
/// @errors  throws std::system_error if there are no descriptors left (orca/base/exhaustion.hpp).
/// @thread  any.
[[nodiscard]] Result<SocketPair> make_socket_pair();

/// One end of a control channel between the supervisor and a host process. It carries messages with descriptors over a
/// socket that keeps packets apart. A long message travels in several packets.
///
/// The peer is not trusted: impossible bytes are an error, and so is the end of the connection. After either, nothing
/// more is received. Descriptors that arrived with them are closed.
///
/// Thread contract: post(), send() and flush() from any thread; receive() and wait_for_message() from one thread at a
/// time.
class Channel {
 public:
  /// Messages that a peer does not read wait here, up to this size [bytes].
  static constexpr std::size_t kDefaultBound = std::size_t{4} << 20;

  /// @param socket  one end of make_socket_pair().
  /// @param bound   [bytes] if more than this waits for the peer, post() and send() take nothing more.
  explicit Channel(Descriptor socket, std::size_t bound = kDefaultBound);
  /// Makes a channel to a peer that sends no descriptors.
  /// @param longest  [bytes] of a message that the peer may send.
  Channel(Descriptor socket, std::size_t bound, std::size_t longest);
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  /// Ends the connection from this end: the peer reads what it has got, and then learns that nothing more comes.
  void shut_down();
  /// Sends a message, or queues what the socket does not take now. Never waits.
  /// @errors  deadline_exceeded if more than the bound waits already: the peer does not read. unavailable if the peer is
  ///          gone. invalid_argument if the message is too long for any channel. In each case it is not sent.
  Status post(Message message);
  /// Sends a message, and waits until the socket has taken it and all before it.
  /// @param limit  longest wait [s].
  /// @errors  as post(); deadline_exceeded also if the limit passed. Then the message may still be sent later.
  Status send(Message message, Duration limit);
  /// Sends what is queued, as far as the socket takes it.
  /// @errors  unavailable if the peer is gone.
  Status flush();
  /// Returns whether something is queued: whoever polls the descriptor should wait for POLLOUT as well.
  [[nodiscard]] bool has_unsent() const;

  /// Returns the next message that has arrived; nothing if none is complete. Never waits.
  /// @errors  unavailable if the peer has closed its end, after all that it had sent. data_loss for impossible bytes.
  Result<std::optional<Message>> receive();
  /// Waits for the next message.
  /// @errors  as receive(); deadline_exceeded if the limit [s] passed.
  Result<Message> wait_for_message(Duration limit);

  /// Returns the number of the socket, for poll(): POLLIN calls for receive(), POLLOUT for flush().
  [[nodiscard]] int descriptor() const { return socket_.number(); }

 private:
  Status enqueue(Message message) ORCA_REQUIRES(mutex_);
  Status flush_locked() ORCA_REQUIRES(mutex_);

  const Descriptor socket_;
  const std::size_t bound_;

  // Below: used by the receiving thread only.
  std::unique_ptr<PacketJoiner> joiner_;
  std::vector<std::byte> buffer_;
  std::optional<Error> cut_;  // why nothing more is received

  mutable Mutex mutex_;
  std::deque<Packet> unsent_ ORCA_GUARDED_BY(mutex_);  // oldest first
  std::size_t unsent_bytes_ ORCA_GUARDED_BY(mutex_) = 0;
  std::optional<Error> broken_ ORCA_GUARDED_BY(mutex_);  // why nothing more can be sent
};

}  // namespace orca::supervisor
