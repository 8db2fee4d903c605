// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "orca/geometry/error_guess.hpp"

namespace orca::robot_file {

/// The level of the simulated devices' errors. Every comparison of results names the level it used.
enum class Realism {
  ideal,    ///< Exact sensors, wheels and odometry, a drive without lag and dead time.
  nominal,  ///< Errors of well calibrated devices on a hard, even floor.
  harsh,    ///< Errors about twice as large.
  recorded  ///< Wheels as wrong as those of the robots whose logs docs/realism.md compares; else as nominal.
};

[[nodiscard]] std::string_view to_string(Realism realism);
/// Returns the level "ideal", "nominal", "harsh" or "recorded"; nothing for any other word.
[[nodiscard]] std::optional<Realism> realism_from(std::string_view word);

/// The guesses of a robot's file about a device's errors: for the device in general, and for levels of realism at which it
/// is worse or better. Without any guess they are not known.
/// @tparam Guess  a WheelErrorGuess or a RangeErrorGuess.
template <class Guess>
class Guesses {
 public:
  /// Sets the guess for a level; without a level the one for all levels that have none of their own.
  /// @return false if it has been set before.
  bool set(std::optional<Realism> level, const Guess& guess) {
    std::optional<Guess>& place = level ? by_level_[static_cast<std::size_t>(*level)] : general_;
    if (place) return false;
    place = guess;
    return true;
  }

  /// Returns whether there is any guess.
  [[nodiscard]] bool is_known() const {
    return general_ || std::ranges::any_of(by_level_, [](const auto& guess) { return guess.has_value(); });
  }
  /// Returns the guess that is for no level in particular.
  [[nodiscard]] Guess general() const { return general_.value_or(Guess{}); }
  [[nodiscard]] Guess at(Realism level) const {
    return by_level_[static_cast<std::size_t>(level)].value_or(general_.value_or(Guess{}));
  }

 private:
  std::optional<Guess> general_;
  std::array<std::optional<Guess>, 4> by_level_;
};

}  // namespace orca::robot_file
