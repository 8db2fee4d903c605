// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

/// Checksums of serial protocols. Pure functions; any thread.
namespace orca::hw::framing {

/// Returns the sum of big-endian 16-bit words, modulo 65536. A last odd byte is combined by exclusive or.
/// @source  P2OS, "Packet checksum" in the Pioneer 2 operations manual.
[[nodiscard]] std::uint16_t sum_of_words(std::span<const std::uint8_t> bytes);

/// Returns the check word of LMS2xx telegrams. It is not one of the common CRC-16: each byte enters together with
/// the byte before it.
/// @source  LMS2xx telegram listing, "CRC16 generator", generator 8005h.
[[nodiscard]] std::uint16_t crc_of_pairs(std::span<const std::uint8_t> bytes);

/// Returns the sum of all bytes, modulo 256.
/// @source  Nomad Scout host protocol.
[[nodiscard]] std::uint8_t sum_of_bytes(std::span<const std::uint8_t> bytes);

/// Returns the CRC-16 with generator 1021h that begins with FFFFh and takes the highest bit of each byte first.
/// @source  Catalogue of parametrised CRC algorithms, "CRC-16/IBM-3740", also called CCITT-FALSE.
[[nodiscard]] std::uint16_t crc_ccitt(std::span<const std::uint8_t> bytes);

}  // namespace orca::hw::framing
