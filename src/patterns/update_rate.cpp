// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/update_rate.hpp"

#include <algorithm>

namespace orca {

UpdateGrant grant_rate(const UpdateRate& asked, Duration base_period) {
  UpdateGrant grant{base_period, std::max(asked.multiple, 1U), asked.interval};
  if (base_period <= Duration{0}) return grant;
  const Duration forgiven = base_period / 1000;
  const Duration::rep needed =
      asked.interval > forgiven ? (asked.interval - forgiven - Duration{1}) / base_period + 1 : 1;
  constexpr Duration::rep kMost = 1'000'000'000;
  grant.multiple =
      std::max(grant.multiple, static_cast<std::uint32_t>(std::clamp<Duration::rep>(needed, 1, kMost)));
  const bool fits = base_period <= Duration::max() / Duration::rep{grant.multiple};
  grant.interval = fits ? base_period * grant.multiple : Duration::max();
  return grant;
}

}  // namespace orca
