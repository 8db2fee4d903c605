// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/idl/object.hpp"

namespace orca::bytes {

/// The kinds of frame. The number in a frame's header is the subscription's for Push, the request's for Query
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

/// A frame that is being written. It holds the length [bytes] of all that follows the length, the kind, the
/// number, then the fields as they are added. All numbers are little-endian.
class FrameWriter {
 public:
  FrameWriter(FrameKind kind, std::uint64_t number);

  void add(std::uint64_t value);
  void add(const std::string& text);
  /// Adds an object: the hash of its type's layout, then XCDR1. It must be the last field.
  void add(const ObjectRef& object);

  /// Returns the whole frame.
  [[nodiscard]] std::span<const std::byte> bytes();

 private:
  std::vector<std::byte> bytes_;
};

/// A frame that has been received. Its bytes are not trusted: a missing field reads as 0 or empty, and
/// status() reports it.
///
/// A view; it must not outlive the bytes.
class FrameReader {
 public:
  /// @param frame  all bytes that follow the length.
  explicit FrameReader(std::span<const std::byte> frame);

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

  std::span<const std::byte> rest_;
  bool cut_short_ = false;
  FrameKind kind_;
  std::uint64_t number_;
};

/// A stream of bytes that is cut into frames.
class FrameSplitter {
 public:
  void append(std::span<const std::byte> bytes);
  /// Returns the next whole frame without its length, valid until the next call; nothing if it is not whole yet.
  /// @errors  data_loss for an impossible length.
  Result<std::optional<std::span<const std::byte>>> next();

 private:
  std::vector<std::byte> bytes_;
  std::size_t used_ = 0;
};

}  // namespace orca::bytes
