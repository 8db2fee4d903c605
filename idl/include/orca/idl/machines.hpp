// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// The objects by which machines of a system, and systems of a team, find each other, and the names of the places where teams meet.
/// idl/orca/machines.idl gives the meaning of each field.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "orca/idl/generated/machines.h"
#include "orca/idl/generated/machines.types.hpp"
#include "orca/idl/object.hpp"

namespace orca {

/// Returns the topic of DDS on which the systems of a team say who they are.
[[nodiscard]] inline std::string team_topic(const std::string& team) { return "orca-team/" + team; }
/// Returns the topic of DDS on which what they offer by a name travels.
[[nodiscard]] inline std::string team_topic(const std::string& team, const std::string& offer) {
  return team_topic(team) + "/" + offer;
}

/// Returns whether somebody in the network may call himself so: letters, digits, '_' and '/', at most 64 of them.
[[nodiscard]] inline bool may_be_system(std::string_view name) {
  constexpr std::size_t kLongest = 64;
  constexpr auto is_good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/';
  };
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), is_good);
}

}  // namespace orca
