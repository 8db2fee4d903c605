// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/scan.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::sick_lms {
namespace {

constexpr unsigned kCountMask = 0x03FF;
constexpr unsigned kUnitShift = 14;
constexpr int kReservedCodes = 8;     // below the highest distance: no echo, dazzling, too weak, too far
constexpr int kHighestCode = 0x7FFF;  // of the 32 m range, also where no bit of a value is a flag

double metres(Unit unit) {
  switch (unit) {
    case Unit::millimetre: return 0.001;
    case Unit::decimetre: return 0.1;
    default: return 0.01;
  }
}

}  // namespace

std::optional<std::uint16_t> distance_mask(std::uint8_t measuring_mode) {
  switch (measuring_mode) {
    case 0x00:
    case 0x01:
    case 0x02: return 0x1FFF;
    case 0x03:
    case 0x04: return 0x3FFF;
    case 0x05:
    case 0x06: return 0x7FFF;
    case 0x0F: return 0xFFFF;
    default: return std::nullopt;
  }
}

Status parse_scan(const Reply& reply, std::uint8_t measuring_mode, std::vector<double>& ranges) {
  ranges.clear();
  const auto mask = distance_mask(measuring_mode);
  if (!mask)
    return fail(Code::unimplemented, "measuring mode " + std::to_string(measuring_mode) +
                                         " of the laser is unknown; set one of 0 to 6 or 15");
  if (reply.code != ReplyCode::scan)
    return fail(Code::invalid_argument, "not a scan: its code is not B0 (hex)");
  framing::ByteReader reader(reply.data);
  const unsigned word = reader.u16();
  const std::size_t count = word & kCountMask;
  if (reader.remaining() < 2 * count)
    return fail(Code::data_loss, "a scan of " + std::to_string(count) + " values does not fit into " +
                                     std::to_string(reply.data.size()) + " bytes of data; it is not used");
  const double unit = metres(static_cast<Unit>(word >> kUnitShift));
  const int no_return = std::min<int>(*mask, kHighestCode) - kReservedCodes;
  for (std::size_t i = 0; i < count; ++i) {
    const int distance = reader.u16() & *mask;
    ranges.push_back(distance >= no_return ? std::numeric_limits<double>::infinity() : distance * unit);
  }
  return ok();
}

}  // namespace orca::hw::sick_lms
