// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/idl/system.hpp"

namespace orca::host {

/// An alarm that nobody has acknowledged yet. A plain value.
struct KeptAlarm {
  std::uint64_t number = 0;  ///< Names it for people; never given twice.
  std::string process;       ///< Process of its source; empty: not one alone, or there is only one.
  idl::Alarm alarm;          ///< As it was raised, or cleared, last.
  std::uint64_t times = 1;   ///< How often it was raised.
};

/// The alarms that were raised and that nobody has acknowledged yet. Kind, source and process together identify an
/// alarm: raised again, it keeps its number and is counted. It stays when its source is gone, and when it is cleared; only
/// acknowledge() takes it out. If it is raised after that, it is a new one.
///
/// Beyond kMost the one with the lowest number is given up, so that a flood of alarms does not take all memory.
///
/// Thread contract: not synchronised.
class AlarmStore {
 public:
  static constexpr std::size_t kMost = 1000;

  /// Keeps an alarm that was raised, or notes that one was cleared. One that is cleared without having been raised is
  /// ignored.
  /// @return its number; 0: it is not kept.
  std::uint64_t take(const idl::Alarm& alarm, const std::string& process = {});

  /// Takes an alarm out.
  /// @errors  not_found if there is none with this number.
  Status acknowledge(std::uint64_t number);

  /// Returns what is kept, by number.
  [[nodiscard]] const std::vector<KeptAlarm>& kept() const { return kept_; }
  /// Returns how many were given up because there were too many.
  [[nodiscard]] std::uint64_t given_up() const { return given_up_; }

 private:
  std::vector<KeptAlarm> kept_;  // by number
  std::uint64_t last_number_ = 0;
  std::uint64_t given_up_ = 0;
};

}  // namespace orca::host
