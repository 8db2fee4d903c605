// SPDX-License-Identifier: LGPL-3.0-or-later
#include "frame.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <iomanip>
#include <sstream>
#include <utility>

#include "orca/idl/time_shift.hpp"

namespace orca::frames {
namespace {

using Length = std::uint32_t;

static_assert(std::endian::native == std::endian::little, "numbers are written as the machine holds them");

// Writes what fits into memory of a fixed size, and counts the rest.
class Writer {
 public:
  Writer(std::span<std::byte> to, detail::BulkLender* lender) : to_(to), lender_(lender) {}

  void add(std::span<const std::byte> bytes) {
    const auto rest = free();
    if (!bytes.empty() && bytes.size() <= rest.size()) std::memcpy(rest.data(), bytes.data(), bytes.size());
    used_ += bytes.size();
  }
  template <class T>
  void add_plain(T value) {
    add(std::as_bytes(std::span(&value, 1)));
  }
  void add(const ObjectRef& object) {
    add_plain(object.type().layout_hash);
    const bool may_lend = lender_ != nullptr && object.type().bulk != nullptr;
    used_ += may_lend ? object.type().bulk->write(object.get(), free(), *lender_)
                      : object.type().write(object.get(), free());
  }
  [[nodiscard]] std::size_t size() const { return used_; }

 private:
  [[nodiscard]] std::span<std::byte> free() const { return to_.subspan(std::min(used_, to_.size())); }

  std::span<std::byte> to_;
  detail::BulkLender* lender_;
  std::size_t used_ = 0;
};

std::string no_subtype(const ObjectType& wanted, std::uint64_t hash) {
  std::ostringstream text;
  text << "an object whose type has the hash " << std::hex << std::setw(16) << std::setfill('0') << hash
       << ", where a " << wanted.name << " was expected; is the sender built for other types?";
  return text.str();
}

}  // namespace

std::size_t Frame::write(std::span<std::byte> to, detail::BulkLender* lender) const {
  Writer writer(to, lender);
  writer.add_plain(static_cast<std::uint64_t>(kind_));
  writer.add_plain(number_);
  for (std::size_t i = 0; i < number_count_; ++i) writer.add_plain(numbers_[i]);
  for (std::size_t i = 0; i < text_count_; ++i) {
    writer.add_plain(static_cast<Length>(texts_[i].size()));
    writer.add(std::as_bytes(std::span(texts_[i])));
  }
  if (object_) writer.add(object_);
  return writer.size();
}

void Frame::append_to(std::vector<std::byte>& bytes, detail::BulkLender* lender) const {
  const std::size_t start = bytes.size();
  bytes.resize(start + write({}, lender));
  write(std::span(bytes).subspan(start), lender);
}

FrameReader::FrameReader(std::span<const std::byte> frame, Duration clock_ahead)
    : rest_(frame), clock_ahead_(clock_ahead), kind_(read_kind()), number_(read_plain<std::uint64_t>()) {}
FrameReader::FrameReader(std::span<const std::byte> frame, detail::BulkSource* source) : FrameReader(frame) {
  source_ = source;
}

FrameKind FrameReader::read_kind() {
  const auto kind = read_plain<std::uint64_t>();
  return kind <= static_cast<std::uint64_t>(FrameKind::answer) ? static_cast<FrameKind>(kind) : FrameKind{};
}

template <class T>
T FrameReader::read_plain() {
  T value{};
  if (rest_.size() < sizeof value) {
    cut_short_ = true;
    rest_ = {};
    return value;
  }
  std::memcpy(&value, rest_.data(), sizeof value);
  std::atomic_signal_fence(std::memory_order_seq_cst);  // the compiler does not read it again
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
  const auto bytes = std::exchange(rest_, {});
  const bool may_borrow = source_ != nullptr && type->bulk != nullptr;
  Status read = may_borrow ? type->bulk->deserialize(bytes, loan.get(), *source_)
                           : type->deserialize(bytes, loan.get());
  if (!read.ok()) return read.error();
  shift_times(loan, -clock_ahead_);
  return std::move(loan).seal();
}

Status FrameReader::status() const {
  if (!cut_short_ && rest_.empty()) return ok();
  const std::string kind = std::to_string(static_cast<int>(kind_));
  if (cut_short_) return fail(Code::data_loss, "a frame of kind " + kind + " is too short");
  return fail(Code::data_loss, "a frame of kind " + kind + " has " + std::to_string(rest_.size()) +
                                   " bytes more than expected");
}

Error unexpected(const FrameReader& frame, std::string_view patterns) {
  return fail(Code::data_loss, "a frame of kind " + std::to_string(static_cast<int>(frame.kind())) +
                                   " does not belong to " + std::string(patterns) +
                                   ", or not in this direction");
}

}  // namespace orca::frames
