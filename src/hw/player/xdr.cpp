// SPDX-License-Identifier: LGPL-3.0-or-later
#include "xdr.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace orca::hw::player {

namespace {

// XDR fills up with zeros to a multiple of 4 bytes.
constexpr std::size_t rounded_up(std::size_t size) { return (size + 3) / 4 * 4; }

}  // namespace

void XdrWriter::one(std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes_.push_back(static_cast<std::uint8_t>(value >> shift & 0xFF));
}

void XdrWriter::one(float value) { one(std::bit_cast<std::uint32_t>(value)); }

void XdrWriter::one(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  one(static_cast<std::uint32_t>(bits >> 32));
  one(static_cast<std::uint32_t>(bits & 0xFFFFFFFFU));
}

// The count includes the zero byte at the end. No text at all has the count 0, as in questions.
void XdrWriter::one(const std::string& text) {
  const std::string_view shown = std::string_view(text).substr(0, text.find('\0'));
  std::vector<std::uint8_t> characters(shown.begin(), shown.end());
  if (!characters.empty()) characters.push_back(0);
  one(characters);
}

void XdrWriter::one(const std::vector<std::uint8_t>& list) {
  counts(list.size());
  padded(list);
}

void XdrWriter::counts(std::size_t count) {
  one(static_cast<std::uint32_t>(count));
  one(static_cast<std::uint32_t>(count));
}

void XdrWriter::padded(std::span<const std::uint8_t> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  bytes_.resize(bytes_.size() + rounded_up(bytes.size()) - bytes.size());
}

void XdrReader::finish() {
  if (!bytes_.empty()) complain(std::to_string(bytes_.size()) + " bytes are left over");
}

void XdrReader::one(float& value) { value = std::bit_cast<float>(number()); }

void XdrReader::one(double& value) {
  const std::uint64_t high = number();
  value = std::bit_cast<double>(high << 32 | number());
}

void XdrReader::one(std::string& text) {
  const auto characters = padded(counts(1));
  const auto zero = std::ranges::find(characters, std::uint8_t{0});
  text.assign(characters.begin(), zero);
}

void XdrReader::one(std::vector<std::uint8_t>& list) {
  const auto bytes = padded(counts(1));
  list.assign(bytes.begin(), bytes.end());
}

std::uint32_t XdrReader::number() {
  std::uint32_t value = 0;
  for (const std::uint8_t byte : next(4)) value = value << 8 | byte;
  return value;
}

std::size_t XdrReader::counts(std::size_t element_size) {
  const std::size_t first = number();
  const std::size_t second = number();
  if (first != second)
    complain("a list has the counts " + std::to_string(first) + " and " + std::to_string(second) +
             ", which must be equal");
  else if (first > bytes_.size() / element_size)
    complain("a list of " + std::to_string(first) + " elements is announced, but only " +
             std::to_string(bytes_.size()) + " bytes follow");
  return trouble_.empty() ? first : 0;
}

std::span<const std::uint8_t> XdrReader::padded(std::size_t count) {
  const auto bytes = next(rounded_up(count));
  return bytes.first(std::min(count, bytes.size()));
}

// Exactly so many bytes, or none.
std::span<const std::uint8_t> XdrReader::next(std::size_t count) {
  if (count > bytes_.size()) complain("it ends too early");
  if (!trouble_.empty()) return {};
  const auto taken = bytes_.first(count);
  bytes_ = bytes_.subspan(count);
  return taken;
}

// The first complaint counts; the others follow from it.
void XdrReader::complain(std::string trouble) {
  if (trouble_.empty()) trouble_ = std::move(trouble);
}

}  // namespace orca::hw::player
