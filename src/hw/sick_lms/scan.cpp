// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/scan.hpp"

#include <limits>
#include <numbers>
#include <string>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::sick_lms {
namespace {

using framing::ByteReader;

constexpr unsigned kCountMask = 0x03FF;
constexpr unsigned kQuarterShift = 11;
constexpr unsigned kPartialBit = 0x2000;
constexpr unsigned kUnitShift = 14;

// What stands before the values.
struct ScanHead {
  std::size_t count = 0;
  double unit = 0.0;  // [m]
};

ScanHead read_count_word(ByteReader& reader, Scan& scan) {
  const unsigned word = reader.u16();
  if ((word & kPartialBit) != 0) scan.quarter = (word >> kQuarterShift) & 3U;
  return {word & kCountMask, metres(static_cast<Unit>(word >> kUnitShift))};
}

Error too_short(const Reply& reply, std::size_t count) {
  return fail(Code::data_loss, "a scan of " + std::to_string(count) + " values does not fit into " +
                                   std::to_string(reply.data.size()) + " bytes of data; it is not used");
}

double range_of(std::uint16_t distance, const ValueLayout& layout, double unit) {
  return layout.is_no_return(distance) ? std::numeric_limits<double>::infinity() : distance * unit;
}

void read_value(std::uint16_t value, const ValueLayout& layout, double unit, Scan& scan) {
  if (!layout.is_distance()) {
    scan.reflectivity.push_back(value);
    return;
  }
  scan.ranges.push_back(range_of(value & layout.distance_mask, layout, unit));
  if (layout.distance_mask != 0xFFFF) scan.flags.push_back(layout.flags(value));
}

void clear(Scan& scan) {
  scan.first_beam = 0;
  scan.quarter.reset();
  scan.ranges.clear();
  scan.flags.clear();
  scan.reflectivity.clear();
  scan.real_time_index.reset();
  scan.telegram_index.reset();
}

// Reads the ends of a part of the beams. Returns how many values it should have; 0 if that cannot be.
std::size_t read_range(ByteReader& reader, Scan& scan) {
  const std::size_t first = reader.u16();
  const std::size_t last = reader.u16();
  if (first == 0 || last < first) return 0;
  scan.first_beam = first - 1;
  return last - first + 1;
}

Error wrong_range(std::size_t promised, std::size_t count) {
  return fail(Code::data_loss, "a scan of a range of " + std::to_string(promised) + " beams has " +
                                   std::to_string(count) + " values; it is not used");
}

Status read_plain(const Reply& reply, const ScanFormat& format, const ValueLayout& layout, Scan& scan) {
  ByteReader reader(reply.data);
  const bool has_range = reply.code == ReplyCode::range_scan;
  const std::size_t promised = has_range ? read_range(reader, scan) : 0;
  const ScanHead head = read_count_word(reader, scan);
  if (reader.remaining() < 2 * head.count) return too_short(reply, head.count);
  if (has_range && promised != head.count) return wrong_range(promised, head.count);
  for (std::size_t i = 0; i < head.count; ++i) read_value(reader.u16(), layout, head.unit, scan);
  if (format.has_real_time_index && reader.remaining() > 0) scan.real_time_index = reader.u8();
  if (format.has_telegram_index && reader.remaining() > 0) scan.telegram_index = reader.u8();
  return ok();
}

// Here each distance has all 16 bits, and the reflectivity follows it.
Status read_with_reflectivity(const Reply& reply, const ValueLayout& layout, Scan& scan) {
  ByteReader reader(reply.data);
  const unsigned parts = reader.u16();
  if (parts != 1)
    return fail(Code::unimplemented, "a scan with reflectivity in " + std::to_string(parts) +
                                         " parts; ask the laser for one part");
  const std::size_t promised = read_range(reader, scan);
  const ScanHead head = read_count_word(reader, scan);
  if (reader.remaining() < 4 * head.count) return too_short(reply, head.count);
  if (promised != head.count) return wrong_range(promised, head.count);
  for (std::size_t i = 0; i < head.count; ++i) {
    scan.ranges.push_back(range_of(reader.u16(), layout, head.unit));
    scan.reflectivity.push_back(reader.u16());
  }
  return ok();
}

}  // namespace

Status parse_scan(const Reply& reply, const ScanFormat& format, Scan& scan) {
  clear(scan);
  scan.status = reply.status;
  const auto layout = layout_of(format.measuring_mode);
  if (!layout)
    return fail(Code::unimplemented, "measuring mode " + std::to_string(format.measuring_mode) +
                                         " of the laser is unknown; set one of 0 to 6, 15 or 63");
  switch (reply.code) {
    case ReplyCode::scan:
    case ReplyCode::range_scan: return read_plain(reply, format, *layout, scan);
    case ReplyCode::reflectivity_scan: return read_with_reflectivity(reply, *layout, scan);
    default: return fail(Code::invalid_argument, "not a scan: its code is none of B0, B7 and F5 (hex)");
  }
}

double angle_of(const Scan& scan, std::size_t i, const Variant& variant) {
  constexpr double kQuarter = std::numbers::pi / 720.0;
  const Variant spacing{variant.angle, scan.quarter ? 100 : variant.resolution};
  return beam_angle(spacing, scan.first_beam + i) + scan.quarter.value_or(0) * kQuarter;
}

}  // namespace orca::hw::sick_lms
