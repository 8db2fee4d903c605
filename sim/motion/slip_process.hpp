// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/random.hpp"

namespace orca::sim::detail {

// How one cause makes one wheel slip: the wheel goes `1 + ratio` times what it rolls, and the ratio changes with the way.
// White noise over the way is smoothed by two equal first-order filters, so the ratio has no jump and no kink. Its integral
// grows with the root of the way as that of the noise does, once the way is much longer than `length`. On a way that is not
// there the ratio stays. The way may be an angle instead, of the base's turn.
class SlipProcess {
 public:
  // @param growth  [m per root of the way's unit] standard deviation of the slip over a way of 1, for long ways
  // @param length  integral of the ratio's correlation over the way; 0: white noise
  SlipProcess(double growth, double length) : growth_(growth), length_(length) {}

  // Returns how much farther [m] the wheel goes on the next part of its way, negative backwards.
  double over(double way, RandomStream& random);

 private:
  void begin(RandomStream& random);

  double growth_;
  double length_;
  double noise_ = 0.0;  // Behind the first filter, of standard deviation 1.
  double ratio_ = 0.0;  // Behind the second one, in the same unit.
  bool has_begun_ = false;
};

}  // namespace orca::sim::detail
