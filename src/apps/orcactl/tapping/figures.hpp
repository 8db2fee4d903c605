// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/supervisor/control.hpp"
#include "orca/supervisor/record.hpp"

namespace orca::orcactl {

/// What is known about the objects that have passed a port within a span of time: how often, and how old they were.
///
/// Thread contract: not synchronised.
class PassedFigures {
 public:
  void add(const supervisor::Tapped& passed);

  /// Returns how often objects came within a span [s]: their number, objects per second, and the times between two of
  /// them [ms]. Begins anew; the time from the last object to the next one counts there.
  [[nodiscard]] supervisor::Record take_rate(double span);
  /// Returns how old they were [ms]. Begins anew.
  [[nodiscard]] supervisor::Record take_ages();

 private:
  std::optional<std::uint64_t> last_;  // when the last one passed [ns]
  std::vector<double> gaps_;           // [ms]
  std::vector<double> ages_;           // [ms]
  std::uint64_t lost_ = 0;             // from the beginning
  std::uint64_t lost_before_ = 0;      // until the last record
};

}  // namespace orca::orcactl
