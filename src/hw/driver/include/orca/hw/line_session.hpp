// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/line_counts.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw {

/// The conversation with the device at the other end of a line: what is said until it is known who is there, and how messages pass
/// after that. How they are read and sent is the session's own.
///
/// Thread contract: not synchronised; the container's strand.
class LineSession {
 public:
  LineSession() = default;
  LineSession(const LineSession&) = delete;
  LineSession& operator=(const LineSession&) = delete;

  /// Begins anew. @pre  the line has just been opened.
  virtual Status begin(TimePoint now) = 0;
  /// Goes on to find out who is there.
  /// @return whether that is known, and the device is ready.
  /// @errors  not_found if nothing answers, with what to do; what else the device says that makes it useless; those of the link.
  virtual Result<bool> advance(TimePoint now) = 0;
  /// Returns when advance() has something to do, even if nothing comes. @pre  begin() was called.
  [[nodiscard]] virtual TimePoint next() const = 0;
  /// Returns what was read since begin().
  [[nodiscard]] virtual LineCounts counts() const = 0;

 protected:
  ~LineSession() = default;
};

/// Returns the rates [baud] at which a device can be looked for: of a line that has none, as a connection, only the first.
[[nodiscard]] std::vector<std::uint32_t> rates_of(const link::ByteLink& link,
                                                  std::vector<std::uint32_t> rates);
/// Returns a line and the rates at which a device was looked for, for people: "/dev/ttyUSB0 at 38400, 9600 baud".
[[nodiscard]] std::string where(const link::ByteLink& link, const std::vector<std::uint32_t>& rates);

/// The rates of a line at which a device is called, each three times, one after the other.
///
/// Thread contract: not synchronised; the container's strand.
class RateSearch {
 public:
  /// @param link   outlives the object. @param rates  [baud] in the order of the calls.
  RateSearch(link::ByteLink& link, std::vector<std::uint32_t> rates)
      : link_(link), rates_(rates_of(link, std::move(rates))) {}

  /// Sets the line for the first call.
  /// @errors  those of ByteLink::set_line(), as next().
  Status begin();
  /// Sets the line for the next call.
  /// @return false if there is none: the device was called at all rates.
  Result<bool> next();

  /// Returns the rate of the line [baud].
  [[nodiscard]] std::uint32_t rate() const { return rates_[rate_]; }
  [[nodiscard]] bool is_first_call() const { return calls_ == 0; }
  [[nodiscard]] std::string where() const { return hw::where(link_, rates_); }

 private:
  static constexpr int kCalls = 3;  // at each rate

  link::ByteLink& link_;
  const std::vector<std::uint32_t> rates_;
  std::size_t rate_ = 0;
  int calls_ = 0;  // at this rate, before the present one
};

}  // namespace orca::hw
