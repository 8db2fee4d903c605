// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

namespace orca {

/// A stream of random numbers whose values depend on its key alone: (run seed, component, stream name).
/// Adding a component or a stream leaves every other stream unchanged.
///
/// xoshiro256++ seeded by SplitMix64; the distributions are Orca's own, because the standard library's differ
/// between implementations and runs must be bit-identical.
///
/// Thread contract: not synchronised; one strand.
/// @source  Blackman and Vigna, "Scrambled linear pseudorandom number generators", ACM TOMS 47(4), 2021.
class RandomStream {
 public:
  using result_type = std::uint64_t;

  RandomStream(std::uint64_t run_seed, std::string_view component, std::string_view name);

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }
  result_type operator()();

  /// Uniform in [low, high); 53 random bits.
  [[nodiscard]] double uniform(double low, double high);

  /// Normal with the given mean and standard deviation, by Marsaglia's polar method.
  [[nodiscard]] double normal(double mean, double sigma);

  /// True with the given probability in [0, 1].
  [[nodiscard]] bool chance(double probability);

 private:
  std::uint64_t state_[4];
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace orca
