// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/reply.hpp"

#include <algorithm>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::sick_lms {
namespace {

using framing::ByteReader;

// Offsets of the status report, from its code on.
constexpr std::size_t kFirmwareSize = 7;
constexpr std::size_t kStatusVariantEnd = 111;

std::string trimmed(std::string_view text) {
  const auto end = text.find_last_not_of(std::string_view(" \0", 2));
  return std::string(text.substr(0, end == std::string_view::npos ? 0 : end + 1));
}

// A reader of the status report at an offset that counts from the code on.
ByteReader at(const Reply& reply, std::size_t offset) {
  return ByteReader(reply.data.subspan(std::min(offset - 1, reply.data.size())));
}

Variant read_variant(ByteReader& reader) {
  const unsigned angle = reader.u16();
  return {angle, reader.u16()};
}

}  // namespace

std::optional<Reply> parse_reply(std::span<const std::uint8_t> payload) {
  if (payload.size() < 2) return std::nullopt;
  return Reply{
      static_cast<ReplyCode>(payload.front()), payload.subspan(1, payload.size() - 2), {payload.back()}};
}

std::optional<ModeAnswer> parse_mode_answer(const Reply& reply) {
  if (reply.code != ReplyCode::mode || reply.data.empty()) return std::nullopt;
  return static_cast<ModeAnswer>(std::min<std::uint8_t>(reply.data[0], 3));
}

std::optional<VariantAnswer> parse_variant(const Reply& reply) {
  if (reply.code != ReplyCode::variant || reply.data.size() < 5) return std::nullopt;
  ByteReader reader(reply.data);
  const bool is_accepted = reader.u8() == 1;
  return VariantAnswer{is_accepted, read_variant(reader)};
}

std::optional<StatusReport> parse_status(const Reply& reply) {
  if (reply.code != ReplyCode::status || reply.data.size() + 1 < kStatusVariantEnd) return std::nullopt;
  StatusReport report;
  report.firmware = trimmed(at(reply, 1).text(kFirmwareSize));
  report.operating_mode = at(reply, 8).u8();
  report.is_defective = at(reply, 9).u8() != 0;
  report.variant_type = at(reply, 18).u8();
  report.motor_turns = at(reply, 67).u16();
  report.measuring_mode = at(reply, 102).u8();
  ByteReader variant = at(reply, 107);
  report.variant = read_variant(variant);
  ByteReader restart = at(reply, 111);
  report.restart_mode = restart.u8();
  report.restart_time = restart.u16();
  report.address = at(reply, 120).u8();
  report.unit = static_cast<Unit>(at(reply, 122).u8());
  report.is_laser_on = at(reply, 123).u8() != 0;
  report.boot_firmware = trimmed(at(reply, 124).text(kFirmwareSize));
  return report;
}

std::optional<std::vector<LaserError>> parse_errors(const Reply& reply) {
  if (reply.code != ReplyCode::errors) return std::nullopt;
  std::vector<LaserError> errors;
  for (std::size_t i = 0; i + 1 < reply.data.size(); i += 2)
    errors.push_back({reply.data[i], reply.data[i + 1]});
  return errors;
}

std::optional<Configuration> parse_configuration(const Reply& reply) {
  if (reply.code != ReplyCode::configuration) return std::nullopt;
  const auto configuration = Configuration::of(reply.data);
  if (!configuration) return std::nullopt;
  return *configuration;
}

std::optional<WriteAnswer> parse_written(const Reply& reply) {
  if (reply.code != ReplyCode::written || reply.data.empty()) return std::nullopt;
  const auto configuration = Configuration::of(reply.data.subspan(1));
  if (!configuration) return std::nullopt;
  return WriteAnswer{reply.data[0] == 1, *configuration};
}

std::optional<std::string> parse_type(const Reply& reply) {
  if (reply.code != ReplyCode::type && reply.code != ReplyCode::power_on) return std::nullopt;
  return trimmed(ByteReader(reply.data).text(reply.data.size()));
}

}  // namespace orca::hw::sick_lms
