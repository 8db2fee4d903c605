// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "orca/hw/framing/short_list.hpp"

/// The serial protocol of the laser scanner RPLIDAR A1: bytes to values and back, without clock and I/O. All its
/// functions are pure; any thread. The line has 115200 baud, 8 data bits, no parity, 1 stop bit. Numbers have their low
/// byte first. The motor is not part of the protocol: on the A1 the adapter's DTR line switches it (from the vendor's
/// SDK alone).
/// @source  SLAMTEC, "RPLIDAR Interface Protocol and Application Notes", for the A1 and A2.
namespace orca::hw::rplidar {

inline constexpr int kBaud = 115200;

/// What the scanner can be asked for.
enum class Request : std::uint8_t {
  stop = 0x25,          ///< Ends a scan. No answer; wait 10 ms.
  reset = 0x40,         ///< As after power-on. The answer is some lines of text; wait 1 s.
  scan = 0x20,          ///< Points one by one, as soon as the motor turns evenly.
  express_scan = 0x82,  ///< Points in capsules, twice as many in a second.
  info = 0x50,          ///< DeviceInfo.
  health = 0x52,        ///< Health.
  sample_rates = 0x59,  ///< SampleRates.
};

/// A whole request, ready to be sent.
using RequestBytes = framing::FrameBytes<16>;

/// Returns a request, with the arguments that it must have: A5, the request, and for express_scan a length, 5 zero bytes,
/// and the exclusive or of all bytes before.
[[nodiscard]] RequestBytes encode(Request request);

}  // namespace orca::hw::rplidar
