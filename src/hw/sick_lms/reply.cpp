// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/reply.hpp"

#include <algorithm>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::sick_lms {
namespace {

using framing::ByteReader;

// Of the configuration.
constexpr std::size_t kMeasuringMode = 5;
constexpr std::size_t kUnit = 6;

std::string trimmed(std::string_view text) {
  const auto end = text.find_last_not_of(std::string_view(" \0", 2));
  return std::string(text.substr(0, end == std::string_view::npos ? 0 : end + 1));
}

Variant read_variant(ByteReader& reader) {
  const unsigned angle = reader.u16();
  return {angle, reader.u16()};
}

}  // namespace

Result<Configuration> Configuration::of(std::span<const std::uint8_t> block) {
  if (block.size() > kMostBytes)
    return fail(Code::data_loss, "a configuration of " + std::to_string(block.size()) +
                                     " bytes; a telegram holds at most " + std::to_string(kMostBytes));
  Configuration configuration;
  for (const std::uint8_t byte : block) configuration.block_.push_back(byte);
  return configuration;
}

std::optional<std::uint8_t> Configuration::byte_at(std::size_t offset) const {
  return offset < block_.size() ? std::optional(block_[offset]) : std::nullopt;
}

std::optional<std::uint8_t> Configuration::measuring_mode() const { return byte_at(kMeasuringMode); }

std::optional<Unit> Configuration::unit() const {
  const auto byte = byte_at(kUnit);
  if (!byte) return std::nullopt;
  return static_cast<Unit>(*byte);
}

Status Configuration::set(std::size_t offset, std::uint8_t byte) {
  if (offset >= block_.size())
    return fail(Code::failed_precondition, "the laser's configuration has " + std::to_string(block_.size()) +
                                               " bytes and no byte " + std::to_string(offset) +
                                               "; this laser does not have the setting");
  block_[offset] = byte;
  return ok();
}

Status Configuration::set_measuring_mode(std::uint8_t mode) { return set(kMeasuringMode, mode); }
Status Configuration::set_unit(Unit unit) { return set(kUnit, static_cast<std::uint8_t>(unit)); }

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
  if (reply.code != ReplyCode::type) return std::nullopt;
  return trimmed(ByteReader(reply.data).text(reply.data.size()));
}

}  // namespace orca::hw::sick_lms
