// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/geometry/error_guess.hpp"
#include "orca/idl/sensing.hpp"

namespace orca {

/// Sets the uncertainty of each range by a guess of the sensor's errors; without a guess they are not known. The one of a
/// range at or above max_range, where nothing was heard, means nothing.
/// @thread  pure function; any thread.
inline void set_uncertainty(idl::RangeReadings& readings, const RangeErrorGuess& guess) {
  readings.ranges_uncertainty().clear();
  if (!guess.is_known()) return;
  for (const double range : readings.ranges())
    readings.ranges_uncertainty().push_back(guess.deviation(range));
}

}  // namespace orca
