// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/time.hpp"

namespace orca::host {

/// The words of localizers on where their robots are: of each at most ten a second, as many as true poses are kept. A plain value.
struct LocalizationLog {
  bool keeps = false;                       ///< Otherwise nothing is added.
  std::vector<idl::Localization> all{};     ///< In the order in which they were heard.
  std::map<std::string, TimePoint> last{};  ///< The last stamps, by component.
};

inline void add_to(LocalizationLog& log, const idl::Localization& belief) {
  constexpr Duration kBetween = std::chrono::milliseconds(100);
  if (!log.keeps) return;
  const TimePoint stamp = to_time_point(belief.stamp());
  const auto [last, is_first] = log.last.try_emplace(belief.origin(), stamp);
  if (!is_first && stamp - last->second < kBetween) return;
  last->second = stamp;
  log.all.push_back(belief);
}

}  // namespace orca::host
