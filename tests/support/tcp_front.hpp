// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/firmware.hpp"

namespace orca::test {

using namespace std::chrono_literals;

/// A device that is reached over TCP: it listens on a port of this machine that the kernel has chosen, and has one client at a time. Its
/// firmware runs as long as this lives.
/// @tparam Body  has go_on(Duration, TimePoint) beside what the firmware wants of it.
///
/// Thread contract: one thread.
template <class Firmware, class Body>
class TcpFront {
 public:
  /// @param more  what the firmware's constructor takes behind the body.
  template <class... More>
  explicit TcpFront(More&&... more) : firmware_(body_, std::forward<More>(more)...) {
    open_listener();
    thread_ = std::thread([this] { run(); });
  }
  ~TcpFront() {
    ends_ = true;
    thread_.join();
  }
  TcpFront(const TcpFront&) = delete;
  TcpFront& operator=(const TcpFront&) = delete;

  /// Returns what a driver's parameter `device` names.
  [[nodiscard]] std::string address() const { return "tcp:127.0.0.1:" + std::to_string(port_); }

  /// Looks at firmware and body, or changes them, between two of their steps.
  template <class Look>
  auto with(Look look) {
    const std::lock_guard lock(mutex_);
    return look(firmware_, body_);
  }
  /// Cuts the connection, and takes no other one.
  void shut() {
    const std::lock_guard lock(mutex_);
    client_.reset();
    listener_.reset();
  }
  /// Takes connections again, at the same port.
  void listen() {
    const std::lock_guard lock(mutex_);
    open_listener();
  }

 private:
  void open_listener() {
    Descriptor made(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    REQUIRE(made);
    const int yes = 1;
    REQUIRE(setsockopt(made.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port_);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(bind(made.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0);
    REQUIRE(::listen(made.number(), 1) == 0);
    socklen_t size = sizeof place;
    REQUIRE(getsockname(made.number(), reinterpret_cast<sockaddr*>(&place), &size) == 0);
    port_ = ntohs(place.sin_port);
    listener_ = std::move(made);
  }

  void run() {
    for (TimePoint last = steady_now(); !ends_; std::this_thread::sleep_for(1ms)) {
      const std::lock_guard lock(mutex_);
      const TimePoint now = steady_now();
      body_.go_on(now - last, now);
      last = now;
      exchange(now);
    }
  }
  void exchange(TimePoint now) {
    if (!client_ && listener_)
      client_ = Descriptor(accept4(listener_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    std::array<std::uint8_t, 256> bytes{};
    const ssize_t count = client_ ? recv(client_.number(), bytes.data(), bytes.size(), 0) : 0;
    if (client_ && (count == 0 || (count < 0 && errno != EAGAIN))) client_.reset();
    firmware_.note_host(static_cast<bool>(client_), now);
    if (client_ && count > 0) firmware_.take({bytes.data(), static_cast<std::size_t>(count)}, 0, now);
    const std::vector<std::uint8_t> sent = firmware_.advance(now);
    if (client_ && !sent.empty()) (void)send(client_.number(), sent.data(), sent.size(), MSG_NOSIGNAL);
  }

  std::uint16_t port_ = 0;
  Descriptor listener_;
  Descriptor client_;
  Body body_;
  Firmware firmware_;
  std::mutex mutex_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace orca::test
