// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <set>
#include <string>

#include "orca/base/result.hpp"
#include "orca/recording/objects/object_reader.hpp"

namespace orca::orcactl {

/// Prints the laser scans and the odometry of a recording as a log of CARMEN, which many programs that make maps read: a line ODOM for
/// each odometry, FLASER for each scan of 180 degrees, ROBOTLASER1 for each other scan.
/// @param ports  of which one has odometry and one or more have scans; others are passed over.
/// @errors  not_found if there are no scans, or no odometry comes before the first one; as ObjectReader::objects().
Status print_carmen_log(const recording::ObjectReader& reader, const std::set<std::string>& ports);

}  // namespace orca::orcactl
