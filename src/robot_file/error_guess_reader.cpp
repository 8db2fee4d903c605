// SPDX-License-Identifier: LGPL-3.0-or-later
#include "part_readers.hpp"

namespace orca::robot_file {
namespace {

std::optional<WheelErrorGuess> wheel_guess(const xml::Attributes& e) {
  const auto diameter = e.number("wheel_diameter");
  const auto track = e.number("track");
  const auto slip = e.number("slip");
  const auto turn_slip = e.has("turn_slip") ? e.number("turn_slip") : 0.0;
  if (!diameter || !track || !slip || !turn_slip) return std::nullopt;
  return WheelErrorGuess{*diameter, *track, *slip, *turn_slip};
}

std::optional<RangeErrorGuess> range_guess(const xml::Attributes& e, double max_range) {
  const auto fixed = e.number("fixed");
  const auto share = e.number("share");
  if (!fixed || !share) return std::nullopt;
  if (max_range > 0.0 && *fixed >= max_range)
    return e.refuse_at("fixed", codes::kContradiction,
                       "a sensor with an error as large as its max_range measures nothing");
  return RangeErrorGuess{*fixed, *share};
}

// Adds a guess for the level that the element names, or for all others.
template <class Guess>
void add(const xml::Attributes& e, const std::optional<Guess>& guess, Guesses<Guess>& guesses) {
  const auto level = e.has("realism") ? e.choice("realism") : std::nullopt;
  if (!guess || (e.has("realism") && !level)) return;  // Reported already.
  if (!guess->is_known())
    return e.error(codes::kContradiction,
                   "zeros mean that the errors are not known; leave the element out then");
  if (!guesses.set(level ? realism_from(*level) : std::nullopt, *guess))
    e.error(codes::kDuplicate, level ? "there is a guess for realism \"" + *level + "\" already"
                                     : std::string("there is a guess without realism already"));
}

}  // namespace

std::string_view to_string(Realism realism) {
  switch (realism) {
    case Realism::ideal: return "ideal";
    case Realism::nominal: return "nominal";
    case Realism::harsh: return "harsh";
    case Realism::recorded: return "recorded";
  }
  return "unknown";
}

std::optional<Realism> realism_from(std::string_view word) {
  for (const Realism r : {Realism::ideal, Realism::nominal, Realism::harsh, Realism::recorded})
    if (word == to_string(r)) return r;
  return std::nullopt;
}

Guesses<WheelErrorGuess> read_wheel_errors(const xml::Attributes& odometry) {
  Guesses<WheelErrorGuess> guesses;
  for (const auto& [child, rule] : odometry.children()) {
    const xml::Attributes e = odometry.of_child(*child, *rule);
    add(e, wheel_guess(e), guesses);
  }
  return guesses;
}

Guesses<RangeErrorGuess> read_range_errors(const xml::Attributes& sensor, double max_range) {
  Guesses<RangeErrorGuess> guesses;
  for (const auto& [child, rule] : sensor.children()) {
    const xml::Attributes e = sensor.of_child(*child, *rule);
    add(e, range_guess(e, max_range), guesses);
  }
  return guesses;
}

}  // namespace orca::robot_file
