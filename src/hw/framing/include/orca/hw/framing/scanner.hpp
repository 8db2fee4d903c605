// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// Frames in streams of bytes: the part of a serial protocol that does not depend on the device.
namespace orca::hw::framing {

/// The answer of a protocol to the question: does a frame begin at the first of these bytes?
struct Finding {
  enum class Kind {
    nothing,       ///< No frame begins here.
    need_more,     ///< A frame may begin here; its end has not arrived yet.
    frame,         ///< The first `size` bytes are a good frame.
    bad_checksum,  ///< They have the form of a frame, but its checksum is wrong.
  };
  Kind kind = Kind::nothing;
  std::size_t size = 0;  ///< [bytes] of the frame, for Kind::frame.
};

/// The framing of a protocol: how its frames are recognised.
struct Protocol {
  /// Judges a frame by its bytes alone; it is never called with no bytes.
  Finding (*look)(std::span<const std::uint8_t> bytes) = nullptr;
  std::size_t longest =
      0;  ///< [bytes] of the longest frame. It bounds how long a false beginning is waited for.
};

/// A frame that was found in the stream.
struct Frame {
  std::span<const std::uint8_t> bytes;  ///< The whole frame. Valid only during the call that hands it out.
  std::uint64_t begin = 0;              ///< Number of bytes that came before its first one in the stream.
  std::uint64_t skipped = 0;            ///< Number of bytes between the frame before it and this one.
};

/// What a scanner has counted since it was made.
struct Statistics {
  std::uint64_t frames = 0;              ///< Good frames.
  std::uint64_t bad_checksums = 0;       ///< Beginnings that had the form of a frame, but a wrong checksum.
  std::uint64_t skipped_bytes = 0;       ///< Bytes that belong to no good frame.
  std::uint64_t resynchronisations = 0;  ///< Good frames that came after skipped bytes.
  friend bool operator==(const Statistics&, const Statistics&) = default;
};

/// The frames of a byte stream that arrives in pieces of any size.
///
/// After a beginning that turns out to be false, it goes on from the next byte. So it finds a good frame inside
/// garbage, and inside a frame that was cut short. It keeps at most twice the longest frame, and takes memory only when it is
/// made. It has no clock: a driver that hears nothing for too long calls give_up().
///
/// Thread contract: not synchronised; one thread.
class Scanner {
 public:
  /// @pre  protocol.look is set and protocol.longest > 0.
  explicit Scanner(const Protocol& protocol);

  /// Takes the next bytes of the stream and calls sink(const Frame&) for each frame that they complete, in order.
  /// The sink must not call the scanner.
  template <class Sink>
  void feed(std::span<const std::uint8_t> bytes, Sink&& sink) {
    while (!bytes.empty()) {
      bytes = bytes.subspan(take(bytes));
      while (const auto frame = next()) sink(*frame);
    }
  }

  /// Gives up the frame whose end is missing, for a line that is silent or closed. Frames that are found inside
  /// it go to the sink; all other bytes are skipped.
  template <class Sink>
  void give_up(Sink&& sink) {
    while (waiting() > 0) {
      skip_byte();
      while (const auto frame = next()) sink(*frame);
    }
  }

  /// Returns the number of bytes that wait for the rest of their frame.
  [[nodiscard]] std::size_t waiting() const { return end_ - begin_; }
  /// Returns the number of bytes taken so far, which is the index of the next one.
  [[nodiscard]] std::uint64_t received() const { return index_ + waiting(); }
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }

 private:
  std::size_t take(std::span<const std::uint8_t> bytes);
  std::optional<Frame> next();
  [[nodiscard]] Finding judge() const;
  Frame accept(std::size_t size);
  void skip_byte();

  Protocol protocol_;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;  // of the bytes in the buffer that wait
  std::size_t end_ = 0;
  std::uint64_t index_ = 0;    // in the stream, of the first byte that waits
  std::uint64_t skipped_ = 0;  // bytes since the last frame
  Statistics statistics_;
};

}  // namespace orca::hw::framing
