// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/measuring_mode.hpp"

#include <algorithm>
#include <bit>

namespace orca::hw::sick_lms {
namespace {

constexpr int kReservedCodes = 8;     // below the highest distance
constexpr int kHighestCode = 0x7FFF;  // of the 32 m range, also where no bit of a value is a flag

}  // namespace

double metres(Unit unit) {
  switch (unit) {
    case Unit::millimetre: return 0.001;
    case Unit::decimetre: return 0.1;
    default: return 0.01;
  }
}

bool ValueLayout::is_no_return(std::uint16_t distance) const {
  return distance >= std::min<int>(distance_mask, kHighestCode) - kReservedCodes;
}

std::uint8_t ValueLayout::flags(std::uint16_t value) const {
  return static_cast<std::uint8_t>(std::uint32_t{value} >> std::popcount(distance_mask));
}

std::optional<ValueLayout> layout_of(std::uint8_t measuring_mode) {
  switch (measuring_mode) {
    case 0x00:
    case 0x02: return ValueLayout{0x1FFF, false};
    case 0x01: return ValueLayout{0x1FFF, true};
    case 0x03: return ValueLayout{0x3FFF, true};
    case 0x04: return ValueLayout{0x3FFF, false};
    case 0x05: return ValueLayout{0x7FFF, true};
    case 0x06: return ValueLayout{0x7FFF, false};
    case 0x0F: return ValueLayout{0xFFFF, false};
    case 0x3F: return ValueLayout{0x0000, false};
    default: return std::nullopt;
  }
}

}  // namespace orca::hw::sick_lms
