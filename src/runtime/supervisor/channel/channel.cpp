// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/channel.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "channel/packets.hpp"
#include "orca/base/exhaustion.hpp"

namespace orca::supervisor {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int kSocketBuffer = 256 * 1024;  // [bytes] must hold a packet

// Room for the descriptors of one packet, aligned as the system wants it.
struct alignas(cmsghdr) Control {
  std::array<char, CMSG_SPACE(kPacketDescriptors * sizeof(int))> bytes{};
};

Error gone() { return fail(Code::unavailable, "the peer of the control channel is gone"); }

Error broken(int reason) {
  if (reason == EPIPE || reason == ECONNRESET) return gone();
  return fail(Code::unavailable, std::string("the control channel is broken: ") + std::strerror(reason));
}

void attach(msghdr& header, Control& control, std::span<const Descriptor> descriptors) {
  if (descriptors.empty()) return;
  header.msg_control = control.bytes.data();
  header.msg_controllen = CMSG_SPACE(descriptors.size() * sizeof(int));
  cmsghdr* const rights = CMSG_FIRSTHDR(&header);
  rights->cmsg_level = SOL_SOCKET;
  rights->cmsg_type = SCM_RIGHTS;
  rights->cmsg_len = CMSG_LEN(descriptors.size() * sizeof(int));
  auto* at = CMSG_DATA(rights);
  for (const Descriptor& descriptor : descriptors) {
    const int number = descriptor.number();
    std::memcpy(at, &number, sizeof number);
    at += sizeof number;
  }
}

// Returns 0 or the system's number.
int send_packet(int socket, const Packet& packet) {
  iovec data{const_cast<std::byte*>(packet.bytes.data()), packet.bytes.size()};
  Control control;
  msghdr header{};
  header.msg_iov = &data;
  header.msg_iovlen = 1;
  attach(header, control, packet.descriptors);
  while (sendmsg(socket, &header, MSG_NOSIGNAL | MSG_DONTWAIT) < 0)
    if (errno != EINTR) return errno;
  return 0;
}

// A packet that has arrived. The bytes are a view of the buffer.
struct Arrival {
  std::span<const std::byte> bytes;
  std::vector<Descriptor> descriptors;
};

// Takes over all descriptors that came with a packet. `to` has room for them, so nothing throws before they are owned.
void detach(msghdr& header, std::vector<Descriptor>& to) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t count = (part->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < count; ++i) {
      int number = -1;
      std::memcpy(&number, CMSG_DATA(part) + i * sizeof number, sizeof number);
      to.emplace_back(number);
    }
  }
}

// Receives into `header`; a lost connection is told apart only when all that was sent before it has been read.
ssize_t receive_raw(int socket, msghdr& header) {
  const std::size_t room = header.msg_controllen;
  for (;;) {
    header.msg_controllen = room;
    const ssize_t size = recvmsg(socket, &header, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
    if (size >= 0 || (errno != EINTR && errno != ECONNRESET)) return size;
  }
}

// Returns the next packet; nothing if none has arrived.
Result<std::optional<Arrival>> receive_packet(int socket, std::span<std::byte> buffer) {
  Arrival arrival;
  arrival.descriptors.reserve(kPacketDescriptors);
  iovec data{buffer.data(), buffer.size()};
  Control control;
  msghdr header{};
  header.msg_iov = &data;
  header.msg_iovlen = 1;
  header.msg_control = control.bytes.data();
  header.msg_controllen = control.bytes.size();
  const ssize_t size = receive_raw(socket, header);
  if (size < 0 && errno == EAGAIN) return std::optional<Arrival>{};
  if (size < 0) return broken(errno);
  detach(header, arrival.descriptors);
  if (size == 0) return gone();
  if ((header.msg_flags & MSG_CTRUNC) != 0)
    return fail(Code::data_loss, "the control channel lost descriptors; raise the limit (ulimit -n)");
  if ((header.msg_flags & MSG_TRUNC) != 0)
    return fail(Code::data_loss, "a packet of the control channel is too long");
  arrival.bytes = buffer.first(static_cast<std::size_t>(size));
  return std::optional(std::move(arrival));
}

// Returns whether the socket became ready before the deadline.
bool wait_for(int socket, short what, SteadyClock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - SteadyClock::now()).count();
  pollfd ready[] = {{socket, what, 0}};
  return left > 0 && poll(ready, std::size(ready), static_cast<int>(left)) != 0;
}

SteadyClock::time_point after(Duration limit) {
  return SteadyClock::now() + std::chrono::duration_cast<SteadyClock::duration>(limit);
}

}  // namespace

Result<SocketPair> make_socket_pair() {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    const int reason = errno;
    throw_if_exhausted(reason);
    return fail(Code::unavailable, std::string("cannot make a control channel: ") + std::strerror(reason));
  }
  SocketPair pair{Descriptor(ends[0]), Descriptor(ends[1])};
  for (const int end : ends) setsockopt(end, SOL_SOCKET, SO_SNDBUF, &kSocketBuffer, sizeof kSocketBuffer);
  return pair;
}

Channel::Channel(Descriptor socket, std::size_t bound)
    : socket_(std::move(socket)),
      bound_(bound),
      joiner_(std::make_unique<PacketJoiner>()),
      buffer_(kPacketBytes) {}

Channel::Channel(Descriptor socket, std::size_t bound, std::size_t longest)
    : socket_(std::move(socket)),
      bound_(bound),
      joiner_(std::make_unique<PacketJoiner>(longest, 0)),
      buffer_(kPacketBytes) {}

Channel::~Channel() = default;

void Channel::shut_down() {
  const MutexLock lock(mutex_);
  (void)::shutdown(descriptor(), SHUT_RDWR);
  broken_ = gone();
  unsent_.clear();
  unsent_bytes_ = 0;
}

Status Channel::post(Message message) {
  const MutexLock lock(mutex_);
  if (Status queued = enqueue(std::move(message)); !queued.ok()) return queued;
  return flush_locked();
}

Status Channel::send(Message message, Duration limit) {
  const auto deadline = after(limit);
  MutexLock lock(mutex_);
  if (Status queued = enqueue(std::move(message)); !queued.ok()) return queued;
  for (;;) {
    if (Status flushed = flush_locked(); !flushed.ok() || unsent_.empty()) return flushed;
    lock.unlock();
    const bool ready = wait_for(descriptor(), POLLOUT, deadline);
    lock.lock();
    if (!ready) return fail(Code::deadline_exceeded, "the peer of the control channel does not read");
  }
}

Status Channel::flush() {
  const MutexLock lock(mutex_);
  return flush_locked();
}

bool Channel::has_unsent() const {
  const MutexLock lock(mutex_);
  return !unsent_.empty();
}

Status Channel::enqueue(Message message) {
  if (broken_) return *broken_;
  if (unsent_bytes_ > bound_)
    return fail(Code::deadline_exceeded, "the peer of the control channel does not read: " +
                                             std::to_string(unsent_bytes_) + " bytes wait for it");
  auto packets = split(std::move(message));
  if (!packets) return packets.error();
  for (Packet& packet : *packets) {
    unsent_bytes_ += packet.bytes.size();
    unsent_.push_back(std::move(packet));
  }
  return ok();
}

Status Channel::flush_locked() {
  while (!broken_ && !unsent_.empty()) {
    const int reason = send_packet(descriptor(), unsent_.front());
    if (reason == EAGAIN) return ok();
    if (reason != 0) {
      broken_ = broken(reason);
      unsent_.clear();
      unsent_bytes_ = 0;
    } else {
      unsent_bytes_ -= unsent_.front().bytes.size();
      unsent_.pop_front();
    }
  }
  return broken_ ? Status(*broken_) : ok();
}

Result<std::optional<Message>> Channel::receive() {
  while (!cut_) {
    auto arrival = receive_packet(descriptor(), buffer_);
    if (arrival && !*arrival) return std::optional<Message>{};
    auto message = arrival ? joiner_->add((*arrival)->bytes, std::move((*arrival)->descriptors))
                           : Result<std::optional<Message>>(arrival.error());
    if (message && *message) return message;
    if (!message) cut_ = message.error();
  }
  return *cut_;
}

Result<Message> Channel::wait_for_message(Duration limit) {
  const auto deadline = after(limit);
  for (;;) {
    auto message = receive();
    if (!message) return message.error();
    if (*message) return std::move(**message);
    if (!wait_for(descriptor(), POLLIN, deadline))
      return fail(Code::deadline_exceeded, "nothing came over the control channel in time");
  }
}

}  // namespace orca::supervisor
