// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/dump_writer.hpp"

#include <charconv>
#include <cstdint>

namespace orca::detail {
namespace {

constexpr std::string_view kDigits = "0123456789abcdef";

std::string shown(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (c == '\n') return " ";
  if (c == '"' || c == '\\') return {'\\', c};
  if (byte < 0x20 || byte == 0x7F) return {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
  return {c};
}

}  // namespace

void DumpWriter::write(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text_.append(digits.data(), end);
}

void DumpWriter::write(const std::string& value) {
  text_ += '"';
  for (const char c : value) text_ += shown(c);
  text_ += '"';
}

void DumpWriter::write(const idl::TimeValue& value) {
  constexpr std::uint64_t kNsPerSecond = 1'000'000'000;
  const auto ns = static_cast<std::uint64_t>(value.ns());
  const std::uint64_t magnitude = value.ns() < 0 ? 0 - ns : ns;
  const std::string fraction = std::to_string(magnitude % kNsPerSecond);
  text_ += (value.ns() < 0 ? "-" : "") + std::to_string(magnitude / kNsPerSecond) + "." +
           std::string(9 - fraction.size(), '0') + fraction + " s";
}

void DumpWriter::start_field(std::string_view name) {
  text_ += depth_ == 0 ? "\n  " : first_ ? "" : ", ";
  text_ += name;
  text_ += ": ";
  first_ = false;
}

void DumpWriter::start_element(std::size_t index, bool own_line) {
  if (own_line && depth_ == 0) {
    text_ += "\n    " + std::to_string(index) + ": ";
  } else if (index > 0) {
    text_ += ", ";
  }
}

void DumpWriter::add_unit(std::string_view unit) {
  text_ += ' ';
  text_ += unit;
}

}  // namespace orca::detail
