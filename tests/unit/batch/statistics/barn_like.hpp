// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "orca/base/random.hpp"

namespace orca::batch {

/// A synthetic algorithm that drives BARN-like worlds.
struct Driver {
  double success = 0.0;   ///< Added to the probability of success in every world.
  double slowness = 1.0;  ///< Factor of its time.
};

/// Scores of two drivers by world and seed.
struct Scores {
  std::vector<std::vector<double>> first;
  std::vector<std::vector<double>> second;
};

/// A world, for all its runs. As in BARN's worlds, most are passed nearly always, and some are too hard for every algorithm.
struct Difficulty {
  double success;  ///< Probability of success: 0.99 in 85 % of the worlds, and anything below in the others.
  double time;     ///< Time over the optimal one: 4 to 5. 4 is a drive at a quarter of the optimal speed.
};

inline Difficulty drawn_difficulty(RandomStream& random) {
  const double u = random.uniform(0.0, 1.0);
  return {0.99 * std::min(1.0, (1.0 - u) / 0.15), 4.0 + u * u};
}

/// Luck of a run: of the place where the robot starts and of its noise. Runs with the same seed share some of it.
struct Luck {
  double success;  ///< Uniform in [0, 1).
  double time;     ///< Standard normal.
};

inline Luck drawn_luck(RandomStream& random) { return {random.uniform(0.0, 1.0), random.normal(0.0, 1.0)}; }

/// Returns BARN's score: success times OT / clip(AT, 2 OT, 8 OT). At the speeds of drawn_difficulty() few are above 0.25.
inline double barn_score(const Driver& driver, const Difficulty& world, const Luck& luck) {
  if (luck.success >= world.success + driver.success) return 0.0;
  const double time = driver.slowness * world.time * (1.0 + 0.05 * luck.time);
  return 1.0 / std::clamp(time, 2.0, 8.0);
}

/// Draws paired runs. With the probability `shared` the luck of a pair is the same for both drivers, otherwise each has its own.
inline Scores drawn_scores(const Driver& first, const Driver& second, std::size_t worlds, std::size_t seeds,
                           double shared, RandomStream& random) {
  Scores scores{std::vector<std::vector<double>>(worlds), std::vector<std::vector<double>>(worlds)};
  for (std::size_t w = 0; w < worlds; ++w) {
    const Difficulty world = drawn_difficulty(random);
    for (std::size_t s = 0; s < seeds; ++s) {
      const Luck luck = drawn_luck(random);
      const Luck own = drawn_luck(random);
      scores.first[w].push_back(barn_score(first, world, luck));
      scores.second[w].push_back(barn_score(second, world, random.chance(shared) ? luck : own));
    }
  }
  return scores;
}

}  // namespace orca::batch
