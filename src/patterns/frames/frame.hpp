// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/bulk.hpp"
#include "orca/idl/object.hpp"

namespace orca::frames {

/// The kinds of frame. The number in a frame's head is the subscription's for Push, the request's for Query
/// and Send.
enum class FrameKind : std::uint8_t {
  attach = 1,  ///< Push, client: subscribes. Interval [ns], multiple.
  detach,      ///< Push, client: ends the subscription.
  change,      ///< Push, client: asks for another rate. Interval [ns], multiple.
  granted,     ///< Push, server: base period [ns], multiple, interval [ns].
  object,      ///< Push, server: a ticket, 0 if nobody waits for it to be taken; the object.
  taken,       ///< Push, client: the object with this ticket was taken, or dropped and counted.
  give_up,     ///< Push, server: nobody waits any longer for the object with this ticket to be taken.
  lost,        ///< Push, server: so many objects found no room on the way.
  offer,       ///< Request, client: whether it may wait for room; the object.
  withdraw,    ///< Request, client: waits no longer.
  withdrawn,   ///< Request, server: what was not accepted before this never will be.
  answer,      ///< Request, server: a code, a text, a place; of a reply, the object.
};

/// The fewest bytes that a frame takes: its kind and its number.
inline constexpr std::size_t kShortest = 2 * sizeof(std::uint64_t);

/// A frame that is to be sent: a small head and at most one object. It is encoded only when the transport has a
/// place for it. A frame without texts uses no heap.
///
/// Encoded it is the kind, the number, the numbers that were added, the texts, each behind its length (32 bits),
/// and the object, as the hash of its type's layout and XCDR1. All numbers are little-endian; those without a
/// size here have 64 bits.
///
/// Thread contract: one thread at a time.
class Frame {
 public:
  Frame(FrameKind kind, std::uint64_t number) : kind_(kind), number_(number) {}

  /// @pre  no text and no object was added; at most 3 numbers.
  void add(std::uint64_t value) { numbers_[number_count_++] = value; }
  /// @pre  no object was added; at most 2 texts.
  void add(std::string text) { texts_[text_count_++] = std::move(text); }
  /// @pre  the frame has no object.
  void add(ObjectRef object) { object_ = std::move(object); }

  [[nodiscard]] FrameKind kind() const { return kind_; }
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// Returns the number that was added first.
  /// @pre  there is one.
  [[nodiscard]] std::uint64_t first_number() const { return numbers_[0]; }
  /// Returns the object; empty if there is none.
  [[nodiscard]] const ObjectRef& object() const { return object_; }

  /// Encodes the frame as far as it fits into `to`.
  /// @return the bytes that the whole frame takes. If `to` has fewer, its contents are unspecified.
  /// @param lender  lends the object's bulk data, which is not encoded then; null: nothing is lent.
  std::size_t write(std::span<std::byte> to, detail::BulkLender* lender = nullptr) const;

  /// Appends the encoded frame.
  void append_to(std::vector<std::byte>& bytes, detail::BulkLender* lender = nullptr) const;

 private:
  FrameKind kind_;
  std::uint64_t number_;
  std::array<std::uint64_t, 3> numbers_{};
  std::size_t number_count_ = 0;
  std::array<std::string, 2> texts_;
  std::size_t text_count_ = 0;
  ObjectRef object_;
};

/// A frame that has been received. Its bytes are not trusted: a missing field reads as 0 or empty, and
/// status() reports it. They may even change meanwhile, because each is read once.
///
/// A view; it must not outlive the bytes.
class FrameReader {
 public:
  /// @param clock_ahead  by how much the sender's clock is ahead of this one [s]: the instants in its objects are set back by that.
  explicit FrameReader(std::span<const std::byte> frame, Duration clock_ahead = Duration{0});
  /// @param source  of bulk data that the peer has lent; null: it lends none.
  explicit FrameReader(std::span<const std::byte> frame, detail::BulkSource* source);

  [[nodiscard]] FrameKind kind() const { return kind_; }
  [[nodiscard]] std::uint64_t number() const { return number_; }

  std::uint64_t read_number();
  std::string read_text();
  /// Reads the object that is the rest of the frame. It has the type that it was sent with.
  /// @errors  data_loss if the bytes are no object of `wanted` or a type derived from it.
  Result<ObjectRef> read_object(const ObjectType& wanted);

  /// Returns whether all fields could be read. Called after the last field.
  /// @errors  data_loss if a field was missing or if bytes are left over.
  [[nodiscard]] Status status() const;

 private:
  template <class T>
  T read_plain();
  FrameKind read_kind();

  std::span<const std::byte> rest_;
  Duration clock_ahead_;
  detail::BulkSource* source_ = nullptr;
  bool cut_short_ = false;
  FrameKind kind_;
  std::uint64_t number_;
};

/// Makes the error of a frame that should not have come.
/// @param patterns  that it does not belong to, for people: "Push".
[[nodiscard]] Error unexpected(const FrameReader& frame, std::string_view patterns);

}  // namespace orca::frames
