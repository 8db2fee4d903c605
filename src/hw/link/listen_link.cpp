// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/listen_link.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "tcp_socket.hpp"

namespace orca::hw::link {
namespace {

constexpr int kBacklog = 4;  // clients that wait for the present one to go

// Returns a place to listen at; nothing: the text is no address.
std::optional<Address> place_of(const std::string& address, std::uint16_t port) {
  Address place;
  auto* const v4 = reinterpret_cast<sockaddr_in*>(&place.place);
  if (inet_pton(AF_INET, address.c_str(), &v4->sin_addr) == 1) {
    v4->sin_family = AF_INET;
    v4->sin_port = htons(port);
    place.size = sizeof *v4;
    return place;
  }
  auto* const v6 = reinterpret_cast<sockaddr_in6*>(&place.place);
  if (inet_pton(AF_INET6, address.c_str(), &v6->sin6_addr) != 1) return std::nullopt;
  v6->sin6_family = AF_INET6;
  v6->sin6_port = htons(port);
  place.size = sizeof *v6;
  return place;
}

// Returns the port of a socket that listens; both families have it at the same place.
std::uint16_t port_of(int socket) {
  sockaddr_storage place{};
  socklen_t size = sizeof place;
  (void)getsockname(socket, reinterpret_cast<sockaddr*>(&place), &size);
  return ntohs(reinterpret_cast<const sockaddr_in*>(&place)->sin_port);
}

}  // namespace

ListenLink::ListenLink(ListenOptions options)
    : StreamLink(Kind::socket, "the driver has hung up"),
      options_(std::move(options)),
      port_(options_.port) {}

ListenLink::~ListenLink() { ListenLink::close(); }

Result<Opening> ListenLink::open() {
  if (listener_) return Opening::done;
  const std::optional<Address> place = place_of(options_.address, options_.port);
  if (!place)
    return fail(Code::invalid_argument,
                options_.address +
                    " is no address; write 127.0.0.1 for programs of this machine, 0.0.0.0 for others, too",
                name());
  Descriptor socket(::socket(place->place.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket) return refused(errno);
  const int on = 1;
  (void)setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(socket.number(), reinterpret_cast<const sockaddr*>(&place->place), place->size) != 0 ||
      listen(socket.number(), kBacklog) != 0)
    return refused(errno);
  port_ = port_of(socket.number());
  listener_ = std::make_shared<const Descriptor>(std::move(socket));
  return Opening::done;
}

Error ListenLink::refused(int reason) const {
  throw_if_exhausted(reason);
  switch (reason) {
    case EADDRINUSE:
      return fail(
          Code::already_exists,
          "another program listens there; stop it, or choose another port here and in the driver's device",
          name());
    case EACCES:
      return fail(Code::failed_precondition, "this user may not have that port; choose one above 1023",
                  name());
    case EADDRNOTAVAIL:
      return fail(Code::not_found, "this machine does not have that address; ip address lists those it has",
                  name());
    default: return fail(Code::unavailable, std::string("cannot listen: ") + std::strerror(reason), name());
  }
}

std::unique_ptr<ListenLink> ListenLink::another() const {
  auto link = std::make_unique<ListenLink>(options_);
  link->listener_ = listener_;
  link->port_ = port_;
  return link;
}

void ListenLink::close() {
  // Or the system cuts the connection, and the driver loses what was written last.
  StreamLink::discard_input();
  detach();
  listener_.reset();
  port_ = options_.port;
}

// Takes the next client, if there is none.
Status ListenLink::admit() {
  if (!listener_) return not_open(*this);
  if (is_attached()) return ok();
  Descriptor client(accept4(listener_->number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client) {
    if (errno != EAGAIN) throw_if_exhausted(errno);  // which EAGAIN is elsewhere
    return fail(Code::unavailable, "no driver is connected", name());
  }
  keep_fresh(client.number());
  attach(std::move(client));
  return ok();
}

// After a client that has gone the next one gets in.
Result<std::size_t> ListenLink::read(std::span<std::uint8_t> into) {
  if (const Status there = admit(); !there.ok()) return there.error();
  Result<std::size_t> count = StreamLink::read(into);
  if (!count) detach();
  return count;
}

Status ListenLink::write(std::span<const std::uint8_t> bytes) {
  if (Status there = admit(); !there.ok()) return there;
  return StreamLink::write(bytes);
}

Status ListenLink::flush() {
  if (Status there = admit(); !there.ok()) return there;
  return StreamLink::flush();
}

void ListenLink::discard_input() {
  (void)admit();  // a client that waits may have said something
  StreamLink::discard_input();
}

int ListenLink::descriptor() const {
  if (is_attached() || !listener_) return StreamLink::descriptor();
  return listener_->number();
}

std::string ListenLink::name() const { return "listen:" + with_port(options_.address, port_); }

}  // namespace orca::hw::link
