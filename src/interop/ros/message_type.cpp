// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/ros/message_type.hpp"

#include <algorithm>
#include <array>

namespace orca::ros {
namespace {

struct Row {
  std::string_view name;
  std::string_view definition;
  std::string_view hash;
};

constexpr auto kRows = std::to_array<Row>({
#include "orca/ros/generated/message_table.inc"
});

}  // namespace

std::optional<MessageType> standard_message_type(std::string_view name) {
  const auto* const row = std::ranges::find(kRows, name, &Row::name);
  if (row == kRows.end()) return std::nullopt;
  return MessageType{std::string(row->name), std::string(row->definition), std::string(row->hash)};
}

std::string dds_type_name(std::string_view message) {
  const std::size_t first = message.find('/');
  const std::size_t last = message.rfind('/');
  return std::string(message.substr(0, first)) + "::msg::dds_::" + std::string(message.substr(last + 1)) +
         "_";
}

}  // namespace orca::ros
