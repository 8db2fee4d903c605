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

bool is_flag(std::string_view value) { return value.empty(); }

// Reads an option about the outputs. Returns whether it is one.
bool read_output(std::string_view name, std::string_view value, host::RunOutputs& outputs) {
  if (name == "trace") return outputs.trace_file = value, true;
  if (name == "values") return outputs.trace_values = true, is_flag(value);
  if (name == "looks_on") return outputs.looks_on = true, is_flag(value);
  if (name == "picture") return outputs.picture.file = value, true;
  if (name == "record") return outputs.recordings.push_back({std::string(value), {}}), true;
  if (name == "port" && !outputs.recordings.empty())
    return outputs.recordings.back().ports.emplace_back(value), true;
  const auto view = name == "view" ? host::view_from(value) : std::nullopt;
  if (view) return outputs.picture.view = *view, true;
  const auto layer = name == "hide" ? host::layer_from(value) : std::nullopt;
  if (layer) outputs.picture.hidden.insert(*layer);
  return layer.has_value();
}

// Reads an option that is a number. Returns whether it is one.
bool read_number(std::string_view name, std::string_view value, RunWishes& wishes) {
  const auto seed = number<std::uint64_t>(value);
  if (name == "seed" && seed) return wishes.seed = *seed, true;
  const auto count = number<std::int64_t>(value);
  if (!count) return false;
  if (name == "epoch") return wishes.epoch = Duration(*count), true;
  if (name == "start") return wishes.start = TimePoint(Duration(*count)), true;
  if (name == "log" && *count >= 0 && *count <= static_cast<int>(log::Level::off))
    return wishes.log_level = static_cast<log::Level>(*count), true;
  if (name == "executor" && *count >= 0 && *count <= static_cast<int>(Backend::baton))
    return wishes.executor = static_cast<Backend>(*count), true;
  return false;
}

// Reads one option into the wishes. Returns whether it is one.
bool read(std::string_view name, std::string_view value, RunWishes& wishes) {
  if (name == "fail") {
    const auto failure = read_failure(value);
    if (failure) wishes.failures.push_back(*failure);
    return failure.has_value();
  }
  if (name == "run") return wishes.run = value, true;
  return read_number(name, value, wishes) || read_output(name, value, wishes.outputs);
}

void add_picture(const host::PictureOptions& picture, Pairs& pairs) {
  if (picture.file.empty()) return;
  pairs.emplace_back("picture", picture.file);
  pairs.emplace_back("view", host::view_names().at(static_cast<std::size_t>(picture.view)));
  for (const host::Layer layer : picture.hidden)
    pairs.emplace_back("hide", host::layer_names().at(static_cast<std::size_t>(layer)));
}

void add_outputs(const host::RunOutputs& outputs, Pairs& pairs) {
  if (!outputs.trace_file.empty()) pairs.emplace_back("trace", outputs.trace_file);
  if (outputs.trace_values) pairs.emplace_back("values", "");
  if (outputs.looks_on) pairs.emplace_back("looks_on", "");
  for (const host::RecordingOptions& recording : outputs.recordings) {
    pairs.emplace_back("record", recording.file);
    for (const std::string& port : recording.ports) pairs.emplace_back("port", port);
  }
  add_picture(outputs.picture, pairs);
}

}  // namespace

Pairs to_pairs(const RunWishes& wishes) {
  Pairs pairs{{"seed", std::to_string(wishes.seed)},
              {"log", std::to_string(static_cast<int>(wishes.log_level))},
              {"epoch", std::to_string(wishes.epoch.count())},
              {"start", std::to_string(wishes.start.time_since_epoch().count())},
              {"run", wishes.run}};
  if (wishes.executor) pairs.emplace_back("executor", std::to_string(static_cast<int>(*wishes.executor)));
  for (const host::PlannedFailure& failure : wishes.failures) pairs.emplace_back("fail", to_text(failure));
  add_outputs(wishes.outputs, pairs);
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
