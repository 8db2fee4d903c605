// SPDX-License-Identifier: LGPL-3.0-or-later
#include "channel/fields.hpp"

#include <bit>
#include <cstring>
#include <utility>

namespace orca::supervisor {

static_assert(std::endian::native == std::endian::little, "numbers are written as the machine holds them");

void FieldWriter::append(std::span<const std::byte> bytes) {
  message_.body.insert(message_.body.end(), bytes.begin(), bytes.end());
}

void FieldWriter::number(std::uint64_t& value) { append(std::as_bytes(std::span(&value, 1))); }

void FieldWriter::text(std::string& text) {
  std::uint64_t length = text.size();
  number(length);
  append(std::as_bytes(std::span(text)));
}

void FieldWriter::bytes(std::vector<std::byte>& bytes) {
  std::uint64_t length = bytes.size();
  number(length);
  append(bytes);
}

void FieldWriter::descriptor(Descriptor& descriptor) {
  message_.descriptors.push_back(std::move(descriptor));
}

void FieldReader::require(bool condition) {
  if (condition) return;
  whole_ = false;
  rest_ = {};
}

std::span<const std::byte> FieldReader::take(std::uint64_t count) {
  require(count <= rest_.size());
  if (!whole_) return {};
  const auto taken = rest_.first(count);
  rest_ = rest_.subspan(count);
  return taken;
}

std::span<const std::byte> FieldReader::take_counted() {
  std::uint64_t length = 0;
  number(length);
  return take(length);
}

void FieldReader::number(std::uint64_t& value) {
  const auto taken = take(sizeof value);
  value = 0;
  if (!taken.empty()) std::memcpy(&value, taken.data(), sizeof value);
}

void FieldReader::text(std::string& text) {
  const auto taken = take_counted();
  text.assign(reinterpret_cast<const char*>(taken.data()), taken.size());
}

void FieldReader::bytes(std::vector<std::byte>& bytes) {
  const auto taken = take_counted();
  bytes.assign(taken.begin(), taken.end());
}

void FieldReader::descriptor(Descriptor& descriptor) {
  require(used_ < message_.descriptors.size());
  if (whole_) descriptor = std::move(message_.descriptors[used_++]);
}

}  // namespace orca::supervisor
