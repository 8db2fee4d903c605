// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "deployer.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/steady_clock.hpp"

namespace orca::test::player {

using namespace std::chrono_literals;

using Bytes = std::vector<std::uint8_t>;

struct Answer {
  std::uint32_t interface = 0, type = 0, subtype = 0;
  Bytes payload;
};

inline constexpr std::uint32_t kPlayer = 1, kPosition2d = 4, kSonar = 5, kRanger = 62;
inline constexpr std::uint32_t kData = 1, kCommand = 2, kRequest = 3, kAck = 4, kSynch = 5, kNack = 6;

inline void add_word(Bytes& bytes, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}
inline void add_double(Bytes& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  add_word(bytes, static_cast<std::uint32_t>(bits >> 32));
  add_word(bytes, static_cast<std::uint32_t>(bits));
}
inline std::uint32_t word_at(const Bytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes.at(at + i);
  return value;
}
inline double double_at(const Bytes& bytes, std::size_t at) {
  return std::bit_cast<double>(std::uint64_t{word_at(bytes, at)} << 32 | word_at(bytes, at + 4));
}

/// A program that somebody has written for Player: its bytes are those of the protocol's description, written out by hand.
///
/// Thread contract: one thread.
class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(connect(socket_.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0);
    banner_ = read(32);
  }
  [[nodiscard]] std::string banner() const { return {banner_.begin(), banner_.end()}; }

  void send(std::uint32_t interface, std::uint32_t type, std::uint32_t subtype, const Bytes& payload = {}) {
    send_bytes(message(interface, type, subtype, payload));
  }
  static Bytes message(std::uint32_t interface, std::uint32_t type, std::uint32_t subtype,
                       const Bytes& payload) {
    Bytes message;
    for (const std::uint32_t word : {0U, 0U, interface, 0U, type, subtype, 0U, 0U, 0U})
      add_word(message, word);
    add_word(message, static_cast<std::uint32_t>(payload.size()));
    message.insert(message.end(), payload.begin(), payload.end());
    return message;
  }
  void send_bytes(const Bytes& bytes) { REQUIRE(takes(bytes)); }
  /// Returns whether the server is still there.
  bool takes(const Bytes& bytes) {
    return ::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  Answer receive() {
    const Bytes header = read(40);
    return {word_at(header, 8), word_at(header, 16), word_at(header, 20), read(word_at(header, 36))};
  }
  /// Returns the first message of a type; passes over others, such as data.
  Answer receive(std::uint32_t interface, std::uint32_t type) {
    for (;;) {
      Answer answer = receive();
      if (answer.interface == interface && answer.type == type) return answer;
    }
  }
  Answer ask(std::uint32_t interface, std::uint32_t subtype, const Bytes& payload = {}) {
    send(interface, kRequest, subtype, payload);
    for (;;) {
      Answer answer = receive();
      if (answer.interface == interface && (answer.type == kAck || answer.type == kNack)) return answer;
    }
  }
  Answer subscribe(std::uint32_t interface) {
    Bytes wish;
    for (const std::uint32_t word : {0U, 0U, interface, 0U, 1U, 0U, 0U}) add_word(wish, word);
    return ask(1, 3, wish);
  }
  void drive(double forward, double turn_rate) { REQUIRE(tries_to_drive(forward, turn_rate)); }
  bool tries_to_drive(double forward, double turn_rate) {
    Bytes velocity;
    for (const double value : {forward, 0.0, turn_rate}) add_double(velocity, value);
    add_word(velocity, 1);
    return takes(message(kPosition2d, kCommand, 1, velocity));
  }
  /// Returns whether the server ends the connection within 10 s.
  bool is_cut_off() {
    std::array<std::uint8_t, 4096> bytes{};
    for (const TimePoint end = steady_now() + 10s; steady_now() < end;) {
      pollfd waiting{socket_.number(), POLLIN, 0};
      if (poll(&waiting, 1, 100) > 0 && recv(socket_.number(), bytes.data(), bytes.size(), 0) <= 0)
        return true;
    }
    return false;
  }

 private:
  Bytes read(std::size_t count) {
    Bytes bytes(count);
    for (std::size_t at = 0; at < count;) {
      pollfd waiting{socket_.number(), POLLIN, 0};
      REQUIRE(poll(&waiting, 1, 10'000 * static_cast<int>(kSlowdown)) > 0);
      const ssize_t got = recv(socket_.number(), bytes.data() + at, count - at, 0);
      REQUIRE(got > 0);
      at += static_cast<std::size_t>(got);
    }
    return bytes;
  }

  Descriptor socket_;
  Bytes banner_;
};

/// Drives ahead for a while, ten times a second, and returns how far it has come by the odometry that the client gets.
inline double way_driven(Client& client, Duration time) {
  const double before = double_at(client.receive(kPosition2d, kData).payload, 0);
  double after = before;
  for (const TimePoint end = steady_now() + time; steady_now() < end;) {
    client.drive(0.3, 0.0);
    after = double_at(client.receive(kPosition2d, kData).payload, 0);
  }
  return after - before;
}

}  // namespace orca::test::player
