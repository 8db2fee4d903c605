// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/pacing.hpp"

#include <optional>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/xml/quantity.hpp"
#include "orca/xml/values.hpp"

namespace orca::supervisor {
namespace {

Record record_of(const Pace::State& state) {
  constexpr int kNanoseconds = 9;  // digits, so that a step can be seen to be exact
  Cell pace{"pace", state.factor == Pace::kFast ? 0.0 : state.factor, 2};
  if (state.factor == Pace::kFast) pace.value.clear();  // none: as fast as it can
  return {{"time", to_seconds(state.time), kNanoseconds}, std::move(pace), {"paused", state.factor == 0.0}};
}

Error in_real_time() {
  return fail(
      Code::failed_precondition,
      "this run is in real time, which has no pace; start a simulation with --clock virtual --pace 1");
}

Result<double> read_factor(const std::string& word) {
  if (word == "fast") return Pace::kFast;
  constexpr xml::ValueRule kFactor{.form = xml::ValueRule::Form::number, .min = 0.0, .max = Pace::kFastest};
  xml::ValueFault fault;
  const std::optional<double> factor = xml::read_number(word, kFactor, fault);
  if (!factor) return fail(Code::invalid_argument, "pace: " + fault.message + "; or write \"fast\"");
  return *factor;
}

}  // namespace

void set_pace(const std::vector<std::string>& words, Pace* pace, Reply& reply) {
  if (pace == nullptr) return reply.refuse(in_real_time());
  if (!words.empty()) {
    const Result<double> factor = read_factor(words[0]);
    const Status set = factor ? pace->set(*factor) : Status(factor.error());
    if (!set.ok()) return reply.refuse(set.error());
  }
  reply.add(record_of(pace->look()));
}

void pause(Pace* pace, Reply& reply) { set_pace({"0"}, pace, reply); }

void step(const std::vector<std::string>& words, Pace* pace, Conductor& conductor, Reply& reply) {
  if (pace == nullptr) return reply.refuse(in_real_time());
  const Result<Duration> span = xml::parse_duration(joined(words, " "));
  const Status begun = span ? pace->step(*span) : Status(span.error());
  if (!begun.ok()) return reply.refuse(begun.error());
  conductor.wait([pace] { return !pace->look().steps; });
  reply.add(record_of(pace->look()));
}

}  // namespace orca::supervisor
