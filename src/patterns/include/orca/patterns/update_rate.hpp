// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/base/time.hpp"

namespace orca {

/// The rate at which a subscriber asks to be updated (thesis 7.3). If both members are set, the slower one
/// counts.
struct UpdateRate {
  Duration interval{0};        ///< At most one object per interval [s]; 0: any number.
  std::uint32_t multiple = 1;  ///< Only every n-th object.
  friend bool operator==(const UpdateRate&, const UpdateRate&) = default;
};

/// The rate at which the server agrees to update a subscriber.
struct UpdateGrant {
  Duration base_period{0};     ///< The server's [s]; 0: it pushes irregularly.
  std::uint32_t multiple = 1;  ///< The subscriber gets every n-th object.
  Duration interval{0};  ///< Time between two objects [s]: `multiple` base periods; for an irregular server
                         ///< the interval asked for, which is then measured.
  friend bool operator==(const UpdateGrant&, const UpdateGrant&) = default;
};

/// Returns the rate that a server with that base period grants: the interval rounded up to a multiple of the
/// base period, so that nobody gets more than requested. A thousandth of a period is tolerated, because
/// periods such as a third of a second are no whole number of nanoseconds.
[[nodiscard]] UpdateGrant grant_rate(const UpdateRate& asked, Duration base_period);

}  // namespace orca
