// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// An emulated Player server and its clients. The bytes are those of the protocol's description, written out by hand.
#pragma once

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "hex_bytes.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "robot_line.hpp"

namespace orca::test {

using namespace std::chrono_literals;
using emulators::PlayerFirmware;
using emulators::PlayerSettings;
using hw::test::Bytes;

/// Of "Player v.3.1.1-dev", filled up to 32 bytes.
inline constexpr const char* kBanner =
    "506C6179 65722076 2E332E31 2E312D64 65760000 00000000 00000000 00000000";

/// Returns the bytes of e.g. "0000003E 01"; blanks mean nothing.
inline Bytes from_words(const std::string& text) {
  Bytes bytes;
  std::string digits;
  for (const char c : text)
    if (c != ' ') digits += c;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  return bytes;
}

/// Returns words of four bytes with blanks between them.
inline std::string in_words(std::span<const std::uint8_t> bytes) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i > 0 && i % 4 == 0) text += ' ';
    text += kDigits[bytes[i] / 16];
    text += kDigits[bytes[i] % 16];
  }
  return text;
}

/// A mirror that has shown three beams.
class StillMirror final : public emulators::Mirror {
 public:
  [[nodiscard]] std::optional<emulators::MirrorTurn> last_turn() const override {
    if (!stamp) return std::nullopt;
    return emulators::MirrorTurn{*stamp, -0.5, 0.5, ranges};
  }
  std::optional<TimePoint> stamp;
  std::array<double, 3> ranges{1.0, 2.0, std::numeric_limits<double>::infinity()};
};

inline PlayerSettings with_two_sonars() {
  PlayerSettings settings;
  settings.sonars = {{0.0, 0.5, 1.0}, {0.0, -0.5, -1.0}};
  return settings;
}

/// A server and its client, which hears everything that it sends.
struct PlayerDesk {
  explicit PlayerDesk(PlayerSettings settings = with_two_sonars())
      : server(body, std::move(settings), &mirror) {
    body.ranges = {{1, 0.5}};
    (void)server.advance(now);
  }
  /// Connects, and returns what the server sends by itself.
  std::string connect() {
    server.note_host(true, now);
    return in_words(pass(100ms));
  }
  Bytes pass(Duration time) {
    now += time;
    return server.advance(now);
  }
  /// Sends a message, whose header begins with host 0, robot 0, and has time 0 and a sequence. @param kind  interface, index,
  /// type, subtype. @return what comes back at once.
  Bytes say(const std::string& kind, const std::string& payload = "") {
    return say_to(server, kind, payload);
  }
  Bytes say_to(emulators::Firmware& place, const std::string& kind, const std::string& payload = "") {
    Bytes message = from_words("00000000 00000000" + kind + "0000000000000000 0000002A");
    const Bytes content = from_words(payload);
    for (int shift = 24; shift >= 0; shift -= 8)
      message.push_back(static_cast<std::uint8_t>((content.size() >> shift) & 0xFF));
    message.insert(message.end(), content.begin(), content.end());
    place.take(message, 0, now);
    return place.advance(now);
  }
  /// Opens a device. @return the answer's payload.
  std::string open(const std::string& interface) {
    const Bytes answer = open_at(server, interface);
    return in_words(std::span(answer).subspan(40));
  }
  Bytes open_at(emulators::Firmware& place, const std::string& interface) {
    return say_to(place, "00000001 00000000 00000003 00000003",
                  "00000000 00000000" + interface + "00000000 00000001 00000000 00000000");
  }
  /// Makes the place of one more client, which has connected.
  std::unique_ptr<emulators::Firmware> other_client() {
    auto other = server.for_another_host();
    REQUIRE(other);
    other->note_host(true, now);
    now += 100ms;
    (void)server.advance(now);
    CHECK(in_words(other->advance(now)) == kBanner);
    return other;
  }

  emulators::test::ScriptedBody body;
  StillMirror mirror;
  TimePoint now{100s};
  PlayerFirmware server;
};

/// Header and payload of the only message in these bytes; the time stamp, which is the server's, is left out.
struct Parts {
  explicit Parts(const Bytes& bytes) {
    REQUIRE(bytes.size() >= 40);
    head = in_words(std::span(bytes).first(24));
    tail = in_words(std::span(bytes).subspan(32, 8));
    payload = in_words(std::span(bytes).subspan(40));
    size = bytes.size();
  }
  std::string head, tail, payload;
  std::size_t size = 0;
};

inline constexpr const char* kMotorsOn = "00000004 00000000 00000003 00000002";
inline constexpr const char* kVelocity = "00000004 00000000 00000002 00000001";
// 0.2 m/s, 0.1 rad/s, motors on.
inline constexpr const char* kAheadLeft = "3FC999999999999A 0000000000000000 3FB999999999999A 00000001";

/// The same, when the client has connected.
struct ConnectedDesk : PlayerDesk {
  explicit ConnectedDesk(PlayerSettings settings = with_two_sonars()) : PlayerDesk(std::move(settings)) {
    (void)connect();
  }
};

}  // namespace orca::test
