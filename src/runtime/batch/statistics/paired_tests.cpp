// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/paired_tests.hpp"

#include <cmath>
#include <vector>

#include "input_checks.hpp"
#include "moments.hpp"
#include "orca/base/random.hpp"
#include "student.hpp"

namespace orca::batch {
namespace {

constexpr std::size_t kMostTried = 20;
constexpr double kRounding = 1e-10;  // of the sum of all sizes

// Returns the sums of all choices of signs.
std::vector<double> all_sums(std::span<const double> sizes) {
  std::vector<double> sums{0.0};
  for (const double size : sizes) {
    const std::size_t count = sums.size();
    for (std::size_t i = 0; i < count; ++i) sums.push_back(sums[i] + size);
    for (std::size_t i = 0; i < count; ++i) sums[i] -= size;
  }
  return sums;
}

// Adds the sums of the two halves in all ways, so that no rounding adds up over a million steps.
double tried_p(std::span<const double> sizes, double least) {
  const std::size_t half = sizes.size() / 2;
  const std::vector<double> some = all_sums(sizes.first(half));
  const std::vector<double> others = all_sums(sizes.subspan(half));
  std::size_t as_far = 0;
  for (const double one : some)
    for (const double other : others) as_far += std::fabs(one + other) >= least ? 1 : 0;
  return static_cast<double>(as_far) / static_cast<double>(some.size() * others.size());
}

double drawn_sum(std::span<const double> sizes, RandomStream& random) {
  double sum = 0.0;
  std::uint64_t signs = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    signs = i % 64 == 0 ? random() : signs >> 1;
    sum += (signs & 1U) != 0 ? sizes[i] : -sizes[i];
  }
  return sum;
}

double drawn_p(std::span<const double> sizes, double least, const SignFlipOptions& options) {
  RandomStream random(options.seed, "batch", "sign flips");
  std::size_t as_far = 1;
  for (std::size_t i = 0; i < options.draws; ++i)
    as_far += std::fabs(drawn_sum(sizes, random)) >= least ? 1 : 0;
  return static_cast<double>(as_far) / (1.0 + static_cast<double>(options.draws));
}

}  // namespace

Result<SignFlips> sign_flips(std::span<const double> differences, const SignFlipOptions& options) {
  if (options.draws == 0) return fail(Code::invalid_argument, "drawn signs need at least one draw");
  if (const Status status = check_values(differences); !status) return status.error();
  std::vector<double> sizes;
  double sum = 0.0;
  double all = 0.0;
  for (const double difference : differences) {
    sum += difference;
    all += std::fabs(difference);
    if (difference != 0.0) sizes.push_back(std::fabs(difference));
  }
  SignFlips result{.used = sizes.size(), .exact = sizes.size() <= kMostTried};
  if (sizes.empty()) return result;
  const double least = std::fabs(sum) - kRounding * all;
  result.p = result.exact ? tried_p(sizes, least) : drawn_p(sizes, least, options);
  return result;
}

Result<double> student_p(std::span<const double> differences) {
  if (const Status status = check_values(differences); !status) return status.error();
  if (differences.size() == 1) return 1.0;
  const double error = standard_error_of(differences);
  if (error > 0.0) return two_sided_student_tail(mean_of(differences) / error, differences.size() - 1);
  const Result<SignFlips> flips = sign_flips(differences);
  return flips ? Result<double>(flips->p) : flips.error();
}

}  // namespace orca::batch
