// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/rplidar/request.hpp"

#include <array>

namespace orca::hw::rplidar {

namespace {

constexpr unsigned kStart = 0xA5;
constexpr std::array<std::uint8_t, 5> kExpressArguments{};  // mode 0: capsules of 84 bytes

}  // namespace

RequestBytes encode(Request request) {
  RequestBytes bytes;
  bytes.u8(kStart).u8(static_cast<unsigned>(request));
  if (request != Request::express_scan) return bytes;
  bytes.u8(static_cast<unsigned>(kExpressArguments.size())).append(kExpressArguments);
  unsigned checksum = 0;
  for (const std::uint8_t byte : bytes) checksum ^= byte;
  bytes.u8(checksum);
  return bytes;
}

}  // namespace orca::hw::rplidar
