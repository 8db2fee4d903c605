// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/geometry/objects/own_beams.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::laser {

/// The beams of a scan that are to be left out: those of sectors, and those that end in boxes or within the robot's own outline.
/// They become NaN, which means that they say nothing.
///
/// Thread contract: constant after construction.
class Ignored {
 public:
  /// Reads "sector FROM TO", in degrees of the scan's angles, from right to left, "box X1 Y1 X2 Y2", in metres of the robot's
  /// frame, and "outline".
  /// @errors  invalid_argument, with what was found and what was expected.
  static Result<Ignored> parse(const std::vector<std::string>& texts);

  [[nodiscard]] bool empty() const { return parts_.empty(); }
  /// Leaves beams out.
  /// @return how many were left out.
  std::size_t leave_out(idl::LaserRangeReadings& scan, const RobotOutline& robot) const;

 private:
  struct Part {
    enum class Kind { sector, box, outline };
    Kind kind = Kind::outline;
    double numbers[4] = {};  // [rad] or [m]
  };

  static Result<Part> parse_part(std::string_view text);
  static bool holds(const Part& part, const idl::LaserRangeReadings& scan, std::size_t beam,
                    const RobotOutline& robot);

  std::vector<Part> parts_;
};

}  // namespace orca::laser
