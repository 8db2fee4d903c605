// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/update_rate.hpp"

#include <algorithm>

namespace orca {

UpdateGrant grant_rate(const UpdateRate& asked, Duration base_period) {
  UpdateGrant grant{base_period, std::max(asked.multiple, 1U), asked.interval};
  if (base_period <= Duration{0}) return grant;
  const Duration forgiven = base_period / 1000;
  const Duration::rep needed = (asked.interval - forgiven + base_period - Duration{1}) / base_period;
  constexpr Duration::rep kMost = 1'000'000'000;
  grant.multiple =
      std::max(grant.multiple, static_cast<std::uint32_t>(std::clamp<Duration::rep>(needed, 1, kMost)));
  grant.interval = base_period * grant.multiple;
  return grant;
}

}  // namespace orca
