// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// The text form of what went over a link: one line per event, for people and to be played back.
///
///     # orca byte log 1
///     # serial:/dev/ttyUSB0
///     0.000000 open
///     0.000214 out  fa fb 03 00 00 00
///     0.014871 in   fa fb 03 00 00 00
///     7.201553 gone the device has gone: was it unplugged or switched off?
///     7.201601 close
///
/// A line is a time, a word and what belongs to it, with spaces between. The time is in seconds since the log began, with
/// six digits behind the point; it never decreases. The words:
///
/// | word    | then  | meaning                                                                             |
/// |---------|-------|-------------------------------------------------------------------------------------|
/// | open    |       | The link is open; a session begins.                                                 |
/// | in      | bytes | They were read from the device, in hexadecimal, two digits each.                    |
/// | dropped | bytes | They had come from the device and were discarded.                                   |
/// | out     | bytes | They were given to the link to be sent to the device.                               |
/// | gone    | text  | The other end has gone; the link's error.                                           |
/// | close   |       | The link was closed.                                                                |
/// | full    | text  | The last line: what came later is not in the log.                                   |
///
/// Lines that begin with # are remarks. A last line without its line break was cut when the process ended, or the disk was
/// full, and does not count.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::hw::link {

/// The first line of every log.
inline constexpr std::string_view kByteLogTitle = "# orca byte log 1";

/// One event of a link. A plain value.
struct ByteRecord {
  enum class Kind { open, in, dropped, out, gone, close, full };

  Duration time{0};  ///< Since the log began [us resolution].
  Kind kind = Kind::open;
  std::vector<std::uint8_t> bytes{};  ///< Of in, dropped and out.
  std::string text{};                 ///< Of gone and full.

  bool operator==(const ByteRecord&) const = default;
};

/// Returns the lines of a record, each with its line break. Many bytes take several lines with the same time.
[[nodiscard]] std::string to_lines(const ByteRecord& record);

/// Reads a whole log.
/// @errors  invalid_argument with the number of the line and what is wrong there.
/// @thread  pure function; any.
[[nodiscard]] Result<std::vector<ByteRecord>> read_byte_log(std::string_view text);

}  // namespace orca::hw::link
