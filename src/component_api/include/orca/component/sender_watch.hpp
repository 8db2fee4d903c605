// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "orca/component/host.hpp"
#include "orca/idl/checks.hpp"

namespace orca {

/// Checks when a reading was measured.
/// @param age [s]   that it has, by the clock of the one who takes it or by the odometry's; negative: it is from later.
/// @param most [s]  that it may have, or be from later.
/// @errors  invalid_argument.
/// @thread  pure function; any thread.
[[nodiscard]] Status check_age(double age, double most);

/// The watch over those whose readings a component drives by. A reading that says nothing valid counts as none, and one line in
/// the log names its sender and says why: at most one in 10 s for each sender and object type.
///
/// Thread contract: as the component.
class SenderWatch {
 public:
  /// @param host  of the component; it must outlive this.
  explicit SenderWatch(const PluginHost& host) : host_(host) {}

  /// Returns whether the reading counts: check_reading() finds nothing wrong with it.
  template <class Reading>
  bool accepts(const Reading& reading) {
    return accepts(check_reading(reading), object_type<Reading>().name, reading.origin());
  }
  /// Does the same with another check of the reading.
  template <class Reading>
  bool accepts(const Reading& reading, const Status& checked) {
    return accepts(checked, object_type<Reading>().name, reading.origin());
  }
  /// Does the same with a check that has been made already.
  /// @param what    that was sent: "LaserRangeReadings".
  /// @param sender  name of the component.
  bool accepts(const Status& checked, std::string_view what, const std::string& sender);

 private:
  struct Complaint {
    std::string about;  // the kind of object, and its sender
    TimePoint said;
  };

  const PluginHost& host_;
  std::vector<Complaint> complaints_;
};

}  // namespace orca
