// SPDX-License-Identifier: LGPL-3.0-or-later
#include "slip_process.hpp"

#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::sim::detail {

// The state of both filters as after a long way: each has half its variance from what the other one holds.
void SlipProcess::begin(RandomStream& random) {
  noise_ = random.normal(0.0, 1.0);
  ratio_ = 0.5 * (noise_ + random.normal(0.0, 1.0));
  has_begun_ = true;
}

// The sum of a filter's steps has (1 + kept) / (1 - kept) times the variance of as many independent ones. Dividing by that
// makes the growth the same in steps of any length.
double SlipProcess::over(double way, RandomStream& random) {
  const double rolled = std::fabs(way);
  if (growth_ == 0.0 || rolled == 0.0) return 0.0;
  if (!has_begun_) begin(random);
  const double kept = length_ > 0.0 ? portable::exp(-2.0 * rolled / length_) : 0.0;
  noise_ = kept * noise_ + random.normal(0.0, std::sqrt(1.0 - kept * kept));
  ratio_ = kept * ratio_ + (1.0 - kept) * noise_;
  return std::copysign(growth_ * std::sqrt(rolled * (1.0 - kept) / (1.0 + kept)), way) * ratio_;
}

}  // namespace orca::sim::detail
