// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace orca::emulators {

/// What of Player's messages the emulation of a server writes and reads. It shares no code with the driver.
/// @source  Player 3.1 server, TCP protocol in XDR.

enum PlayerInterface : std::uint32_t {
  kPlayerServer = 1,
  kPlayerPower = 2,
  kPlayerPosition = 4,
  kPlayerSonar = 5,
  kPlayerLaser = 6,
  kPlayerBumper = 14,
  kPlayerRanger = 62
};

enum PlayerType : std::uint32_t {
  kPlayerData = 1,
  kPlayerCommand = 2,
  kPlayerRequest = 3,
  kPlayerAck = 4,
  kPlayerSynch = 5,
  kPlayerNack = 6
};

inline constexpr std::size_t kPlayerHeader = 40;               // [bytes]
inline constexpr std::uint32_t kPlayerLongest = 8388608 - 40;  // [bytes] of a payload

// The header of a message, without the host and the port of its device, which the server fills in, and its time.
struct PlayerHeader {
  std::uint32_t interface = 0;
  std::uint32_t index = 0;
  std::uint32_t type = 0;
  std::uint32_t subtype = 0;
  std::uint32_t sequence = 0;
  std::uint32_t size = 0;
};

// Numbers with their high byte first, each of a multiple of 4 bytes.
class PlayerWriter {
 public:
  PlayerWriter& word(std::uint32_t value);
  PlayerWriter& single(double value);  // as a float
  PlayerWriter& real(double value);    // as a double
  // The number of a list's elements, twice.
  PlayerWriter& count(std::size_t count);
  // A list of bytes, filled up to a multiple of 4.
  PlayerWriter& octets(std::span<const std::uint8_t> list);
  PlayerWriter& text(std::string_view text);
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

// Returns the number at an offset; 0 beyond the end.
[[nodiscard]] std::uint32_t player_word(std::span<const std::uint8_t> bytes, std::size_t offset);
[[nodiscard]] double player_real(std::span<const std::uint8_t> bytes, std::size_t offset);

// @pre  there are kPlayerHeader bytes.
[[nodiscard]] PlayerHeader read_player_header(std::span<const std::uint8_t> bytes);

}  // namespace orca::emulators
