// SPDX-License-Identifier: LGPL-3.0-or-later
#include "run_wishes.hpp"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace orca::supervisor {
namespace {

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// A failure travels as "KIND NANOSECONDS COMPONENT".
std::string to_text(const host::PlannedFailure& failure) {
  return host::failure_names()[static_cast<std::size_t>(failure.failure)] + " " +
         std::to_string(failure.at.count()) + " " + failure.component;
}

std::optional<host::PlannedFailure> read_failure(std::string_view text) {
  const std::size_t first = text.find(' ');
  const std::size_t second = text.find(' ', first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos) return std::nullopt;
  const auto kind = host::failure_from(text.substr(0, first));
  const auto at = number<Duration::rep>(text.substr(first + 1, second - first - 1));
  if (!kind || !at) return std::nullopt;
  return host::PlannedFailure{std::string(text.substr(second + 1)), *kind, Duration(*at)};
}

// Reads one option into the wishes. Returns whether it is one.
bool read(std::string_view name, std::string_view value, RunWishes& wishes) {
  if (name == "fail") {
    const auto failure = read_failure(value);
    if (failure) wishes.failures.push_back(*failure);
    return failure.has_value();
  }
  const auto count = number<std::int64_t>(value);
  if (name == "epoch" && count) return wishes.epoch = Duration(*count), true;
  if (name == "log" && count && *count >= 0 && *count <= static_cast<int>(log::Level::off))
    return wishes.log_level = static_cast<log::Level>(*count), true;
  const auto seed = number<std::uint64_t>(value);
  if (name == "seed" && seed) return wishes.seed = *seed, true;
  return false;
}

}  // namespace

Pairs to_pairs(const RunWishes& wishes) {
  Pairs pairs{{"seed", std::to_string(wishes.seed)},
              {"log", std::to_string(static_cast<int>(wishes.log_level))},
              {"epoch", std::to_string(wishes.epoch.count())}};
  for (const host::PlannedFailure& failure : wishes.failures) pairs.emplace_back("fail", to_text(failure));
  return pairs;
}

Result<RunWishes> read_wishes(const Pairs& pairs) {
  RunWishes wishes;
  for (const auto& [name, value] : pairs)
    if (!read(name, value, wishes))
      return fail(Code::data_loss, "the option \"" + name + "\" of the run cannot be \"" + value + "\"");
  return wishes;
}

}  // namespace orca::supervisor
