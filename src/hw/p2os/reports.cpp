// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/reports.hpp"

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::p2os {
namespace {

constexpr std::size_t kEncoderSize = 8;
constexpr std::size_t kGyroReadingSize = 3;
constexpr int kStill = 512;

bool is_of(std::span<const std::uint8_t> body, PacketType type) {
  return !body.empty() && body[0] == static_cast<std::uint8_t>(type);
}

// Reads a list behind its number of elements; false if it is cut short.
template <class List, class ReadOne>
bool read_list(framing::ByteReader& reader, List& list, std::size_t element_size, const ReadOne& read_one) {
  const bool has_count = reader.remaining() > 0;
  const std::size_t count = reader.u8();
  if (!has_count || reader.remaining() < count * element_size) return false;
  for (std::size_t i = 0; i < count; ++i) list.push_back(read_one());
  return true;
}

}  // namespace

std::optional<EncoderReport> parse_encoder(std::span<const std::uint8_t> body) {
  if (!is_of(body, PacketType::encoder) || body.size() < 1 + kEncoderSize) return std::nullopt;
  framing::ByteReader reader(body.subspan(1));
  const std::int32_t left = reader.s32();
  return EncoderReport{left, reader.s32()};
}

std::optional<GyroReport> parse_gyro(std::span<const std::uint8_t> body) {
  if (!is_of(body, PacketType::gyro)) return std::nullopt;
  framing::ByteReader reader(body.subspan(1));
  GyroReport report;
  const auto read_one = [&] {
    const int rate = (reader.u16() & 0x3FF) - kStill;
    return GyroReading{rate, reader.u8()};
  };
  if (!read_list(reader, report, kGyroReadingSize, read_one)) return std::nullopt;
  return report;
}

std::optional<IoReport> parse_io(std::span<const std::uint8_t> body) {
  if (!is_of(body, PacketType::io)) return std::nullopt;
  framing::ByteReader reader(body.subspan(1));
  IoReport report;
  const auto byte = [&] { return reader.u8(); };
  const auto word = [&] { return reader.u16(); };
  const bool is_whole = read_list(reader, report.digital_in, 1, byte) &&
                        read_list(reader, report.digital_out, 1, byte) &&
                        read_list(reader, report.analog, 2, word);
  if (!is_whole) return std::nullopt;
  return report;
}

std::optional<std::span<const std::uint8_t>> parse_aux(std::span<const std::uint8_t> body, PacketType port) {
  if (!is_of(body, port)) return std::nullopt;
  return body.subspan(1);
}

}  // namespace orca::hw::p2os
