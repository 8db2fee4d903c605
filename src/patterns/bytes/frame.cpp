// SPDX-License-Identifier: LGPL-3.0-or-later
#include "frame.hpp"

#include <bit>
#include <cstring>
#include <iomanip>
#include <sstream>
#include <utility>

namespace orca::bytes {
namespace {

using Length = std::uint32_t;

constexpr std::size_t kHeader = sizeof(std::uint8_t) + sizeof(std::uint64_t);  // [bytes] kind and number
constexpr std::size_t kLongest = std::size_t{64} << 20;                        // [bytes]

static_assert(std::endian::native == std::endian::little, "numbers are written as the machine holds them");

template <class T>
void append_plain(std::vector<std::byte>& to, T value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  to.insert(to.end(), bytes.begin(), bytes.end());
}

std::string no_subtype(const ObjectType& wanted, std::uint64_t hash) {
  std::ostringstream text;
  text << "an object whose type has the hash " << std::hex << std::setw(16) << std::setfill('0') << hash
       << ", where a " << wanted.name << " was expected; is the sender built for other types?";
  return text.str();
}

}  // namespace

FrameWriter::FrameWriter(FrameKind kind, std::uint64_t number) {
  append_plain(bytes_, Length{0});
  append_plain(bytes_, kind);
  append_plain(bytes_, number);
}

void FrameWriter::add(std::uint64_t value) { append_plain(bytes_, value); }

void FrameWriter::add(const std::string& text) {
  append_plain(bytes_, static_cast<Length>(text.size()));
  const auto bytes = std::as_bytes(std::span(text));
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

void FrameWriter::add(const ObjectRef& object) {
  add(object.type().layout_hash);
  object.type().serialize(object.get(), bytes_);
}

std::span<const std::byte> FrameWriter::bytes() {
  const auto length = static_cast<Length>(bytes_.size() - sizeof(Length));
  std::memcpy(bytes_.data(), &length, sizeof length);
  return bytes_;
}

FrameReader::FrameReader(std::span<const std::byte> frame)
    : rest_(frame), kind_(read_plain<FrameKind>()), number_(read_plain<std::uint64_t>()) {}

template <class T>
T FrameReader::read_plain() {
  T value{};
  if (rest_.size() < sizeof value) {
    cut_short_ = true;
    rest_ = {};
    return value;
  }
  std::memcpy(&value, rest_.data(), sizeof value);
  rest_ = rest_.subspan(sizeof value);
  return value;
}

std::uint64_t FrameReader::read_number() { return read_plain<std::uint64_t>(); }

std::string FrameReader::read_text() {
  const auto length = read_plain<Length>();
  if (rest_.size() < length) {
    cut_short_ = true;
    rest_ = {};
    return {};
  }
  const auto bytes = rest_.first(length);
  rest_ = rest_.subspan(length);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Result<ObjectRef> FrameReader::read_object(const ObjectType& wanted) {
  const std::uint64_t hash = read_number();
  if (Status whole = cut_short_ ? status() : ok(); !whole.ok()) return whole.error();
  const ObjectType* const type = find_subtype(wanted, hash);
  if (type == nullptr) return fail(Code::data_loss, no_subtype(wanted, hash));
  ObjectLoan loan = make_object(*type);
  if (Status read = type->deserialize(std::exchange(rest_, {}), loan.get()); !read.ok()) return read.error();
  return std::move(loan).seal();
}

Status FrameReader::status() const {
  const std::string kind = std::to_string(static_cast<int>(kind_));
  if (cut_short_) return fail(Code::data_loss, "a frame of kind " + kind + " is too short");
  if (rest_.empty()) return ok();
  return fail(Code::data_loss, "a frame of kind " + kind + " has " + std::to_string(rest_.size()) +
                                   " bytes more than expected");
}

void FrameSplitter::append(std::span<const std::byte> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(std::exchange(used_, 0)));
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<std::span<const std::byte>>> FrameSplitter::next() {
  using Frame = std::optional<std::span<const std::byte>>;
  const auto rest = std::span<const std::byte>(bytes_).subspan(used_);
  Length length = 0;
  if (rest.size() < sizeof length) return Frame{};
  std::memcpy(&length, rest.data(), sizeof length);
  if (length < kHeader || length > kLongest)
    return fail(Code::data_loss, "a frame of " + std::to_string(length) + " bytes; expected " +
                                     std::to_string(kHeader) + " to " + std::to_string(kLongest));
  if (rest.size() - sizeof length < length) return Frame{};
  used_ += sizeof length + length;
  return Frame(rest.subspan(sizeof length, length));
}

}  // namespace orca::bytes
