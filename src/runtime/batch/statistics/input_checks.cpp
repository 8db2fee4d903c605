// SPDX-License-Identifier: LGPL-3.0-or-later
#include "input_checks.hpp"

#include <cmath>
#include <string>

namespace orca::batch {
namespace {

constexpr double kLargestValue = 1e300;

Error different_numbers(const char* things, std::size_t first, std::size_t second) {
  return fail(Code::invalid_argument, std::string("the numbers of ") + things +
                                          " differ: " + std::to_string(first) + " and " +
                                          std::to_string(second) + "; pairs need as many of both");
}

}  // namespace

Status check_values(std::span<const double> values) {
  if (values.empty()) return fail(Code::invalid_argument, "there are no values; at least one is needed");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(std::fabs(values[i]) <= kLargestValue))
      return fail(Code::invalid_argument, "value " + std::to_string(i + 1) + " of " +
                                              std::to_string(values.size()) +
                                              " is not finite, or beyond 1e300");
  return ok();
}

Status check_worlds(ValuesByWorld worlds) {
  if (worlds.empty()) return fail(Code::invalid_argument, "there are no worlds; at least one is needed");
  for (std::size_t i = 0; i < worlds.size(); ++i)
    if (const Status status = check_values(worlds[i]); !status)
      return fail(status.error().code, status.error().message,
                  "world " + std::to_string(i + 1) + " of " + std::to_string(worlds.size()));
  return ok();
}

Status check_same_worlds(ValuesByWorld first, ValuesByWorld second) {
  if (first.size() != second.size()) return different_numbers("worlds", first.size(), second.size());
  if (const Status status = check_worlds(first); !status) return status;
  return check_worlds(second);
}

Result<std::vector<double>> differences_of(std::span<const double> first, std::span<const double> second) {
  if (first.size() != second.size()) return different_numbers("values", first.size(), second.size());
  std::vector<double> differences(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) differences[i] = first[i] - second[i];
  return differences;
}

}  // namespace orca::batch
