// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

struct ReplayOptions {
  std::string file;  ///< A byte log, see byte_record.hpp.
  NowFunction now;   ///< The clock that the recorded times run on.
};

/// What has been written to a replay, beside what the recording holds. A plain value.
struct ReplayComparison {
  std::size_t written = 0;   ///< [bytes] in this session.
  std::size_t recorded = 0;  ///< [bytes] in the whole session of the recording.
  std::size_t equal = 0;     ///< [bytes] at the beginning that are the same.

  /// Returns whether everything that was written is what was recorded, so far.
  [[nodiscard]] bool agrees() const { return equal == written; }
};

/// A recording that plays the device: what it sent then comes again, at the same times after open(). What is written is compared. As
/// long as it is what was recorded, an answer does not come before its request, which may be up to kMostLag late.
///
/// Each open() plays the next session of the recording. When a session is over, read() and write() give unavailable with
/// the recorded reason, if there is one. A recording of a line that had rates has those, and no others.
///
/// Thread contract: one strand.
class ReplayLink final : public ByteLink {
 public:
  static constexpr Duration kMostLag = 500ms;  ///< [s] of a request behind the recorded one.

  explicit ReplayLink(ReplayOptions options);
  ~ReplayLink() override;

  /// @errors  not_found: no such file; invalid_argument: it is no byte log; unavailable: all sessions have been played.
  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override;
  [[nodiscard]] std::size_t pending() const override { return 0; }
  /// Drops what is due and was not read.
  void discard_input() override;
  void discard_output() override {}
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] std::string name() const override { return "replay:" + options_.file; }
  /// @errors  invalid_argument for a rate that the recorded line did not have.
  [[nodiscard]] Status set_line(const Line& line) override;
  [[nodiscard]] double byte_time() const override;

  /// Compares what has been written since open() with the recording, also after close().
  [[nodiscard]] ReplayComparison comparison() const;
  /// Returns the first difference for people: where it is, what was recorded and what was written; empty: none so far.
  [[nodiscard]] std::string first_difference() const;

 private:
  struct Piece {
    Duration time{};         // after open()
    std::size_t end = 0;     // in Session::in
    std::size_t behind = 0;  // [bytes] that had been written before
  };
  struct Session {
    std::vector<Piece> pieces;
    std::vector<std::uint8_t> in;
    std::vector<std::uint8_t> out;
    Duration length{};
    std::string ending;
  };

  [[nodiscard]] Status load();
  void find_rates(std::string_view text);
  [[nodiscard]] const Session& session() const { return sessions_[played_ - 1]; }
  [[nodiscard]] std::size_t due() const;
  [[nodiscard]] bool is_due(const Piece& piece) const;
  [[nodiscard]] Status check_open() const;

  const ReplayOptions options_;
  std::vector<Session> sessions_;
  std::set<std::uint32_t> rates_;  // [baud] that were set; empty: it was no line with a rate
  Line line_;
  bool loaded_ = false;
  std::size_t played_ = 0;  // sessions, with the one that is played now
  bool open_ = false;
  TimePoint start_;
  std::size_t read_ = 0;  // [bytes] of this session
  std::vector<std::uint8_t> written_;
  bool agrees_ = true;  // what was written, with the recording
};

}  // namespace orca::hw::link
