// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "orca/sim/world_model.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::sim::detail {

// Reads one world of a CSV file, plain or compressed by gzip, with the columns world,x,y [m]. The BARN worlds
// come in this form (docs/world-files.md). Each row is a cylinder with a radius of 75 mm; the places "start"
// and "goal" are BARN's.
//
// @param number  which world; without one the error lists the worlds of the file.
// Errors: W011 unreadable, W012 a cylinder over a place, W014 too many, W016 a row is wrong, W017 no such
// world.
[[nodiscard]] std::optional<WorldModel> read_cylinder_world(const std::string& path,
                                                            std::optional<std::uint64_t> number,
                                                            xml::Diagnostics& diagnostics);

}  // namespace orca::sim::detail
