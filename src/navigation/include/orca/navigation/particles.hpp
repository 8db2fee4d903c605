// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/navigation/pose_graph.hpp"

namespace orca::nav {

/// A mean pose and how far poses lie from it.
struct PoseSpread {
  Pose2 mean;
  std::array<double, 9> covariance{};  ///< [m2, m rad, rad2] of x, y and direction, row by row; map frame.
};

/// Fuses what two sources say of a pose whose errors are independent, to first order.
/// @pre  the covariances are positive definite.
/// @thread  pure function; any thread.
[[nodiscard]] PoseSpread fused(const PoseSpread& a, const PoseSpread& b);

/// Returns the spread, about the mean of `likely`, of a pose that is with a probability `share` [1] as `other` says, and else as `likely` does.
/// @thread  pure function; any thread.
[[nodiscard]] PoseSpread mixed(const PoseSpread& likely, const PoseSpread& other, double share);

/// Returns the pose of a robot after a step, whose standard deviations ahead, to the left [m] and of the turn [rad] are given.
/// @param step  seen from where the robot was.
/// @thread  pure function; any thread.
/// @source  Smith, Self and Cheeseman 1990: compounding.
[[nodiscard]] PoseSpread after(const PoseSpread& before, const Pose2& step,
                               const std::array<double, 3>& deviations);

/// Returns the squared distance of a pose from a mean, in units of the covariance (Mahalanobis).
/// @pre  the covariance is positive definite.
[[nodiscard]] double squared_distance(const PoseSpread& spread, const Pose2& pose);

/// Returns how far the place itself may be off [m].
/// @thread  pure function; any thread.
[[nodiscard]] double deviation_of(const PoseSpread& spread);

/// Where odometry has a robot at an instant, and how well it knows that since its start.
struct Reckoned {
  double time = 0.0;  ///< [s] from any beginning.
  Pose2 X_OR;
  std::array<double, 9> covariance{};  ///< [m2, m rad, rad2]
};

/// Returns how wrong a way between two poses of odometry may be: standard deviations ahead, to the left [m] and of the turn [rad], by how the
/// covariance has grown. Never less than a floor, since odometry knows nothing of a bump or a slip, and never more than a fifth of the way: what
/// grows with the way since the start, as the error of a wheel's radius does, is no error of this step.
/// @thread  pure function; any thread.
[[nodiscard]] std::array<double, 3> deviations_of(const Reckoned& before, const Reckoned& now);

/// Returns how much is known of a pose of that covariance, in its own frame.
/// @pre  the covariance is positive definite.
/// @thread  pure function; any thread.
[[nodiscard]] PoseInformation information_of(const PoseSpread& spread);

/// How many particles are kept.
struct ParticleOptions {
  std::size_t least = 100;
  std::size_t most = 5000;
  /// At the end, with a probability of 99 %, the distance (Kullback and Leibler) between the particles and what they stand for is at most this.
  double error = 0.05;
  double bin = 0.2;        ///< [m] of a bin in which particles count as one and the same pose.
  double bin_turn = 0.17;  ///< [rad]
};

/// Where a robot may be, as a set of poses with weights.
///
/// Thread contract: one thread at a time.
/// @source  Thrun, Burgard and Fox, "Probabilistic Robotics", 2005, ch. 8.3; the number: Fox, "Adapting the sample size in particle filters
///          through KLD-sampling", IJRR 22(12), 2003.
class Particles {
 public:
  struct Particle {
    Pose2 X_MR;
    double weight = 0.0;
  };

  explicit Particles(const ParticleOptions& options = {}) : options_(options) {}

  /// Replaces all by `count` around a mean, drawn from a normal distribution.
  void scatter(const PoseSpread& around, std::size_t count, RandomStream& random);
  /// Replaces all by these, with equal weights.
  void put(std::span<const Pose2> poses);
  /// Moves each by the step of a robot, seen from where it was before, and by an error of its own.
  /// @param deviations [m, m, rad]  standard deviations of the step, ahead, to the left and of the turn.
  void move(const Pose2& step, const std::array<double, 3>& deviations, RandomStream& random);
  /// Multiplies each weight by `likelihood(pose)` and scales them to a sum of 1. They stay as they are if that sum is 0 or no number.
  /// @return their sum before: the mean likelihood.
  template <typename Likelihood>
  double weigh(Likelihood likelihood) {
    std::vector<double> weights;
    weights.reserve(particles_.size());
    double sum = 0.0;
    for (const Particle& particle : particles_)
      sum += weights.emplace_back(particle.weight * likelihood(particle.X_MR));
    if (!std::isfinite(sum) || sum <= 0.0) return sum;
    for (std::size_t i = 0; i < weights.size(); ++i) particles_[i].weight = weights[i] / sum;
    return sum;
  }
  /// Draws them again, as many as are needed, each as often as its weight says, where the weights have become unequal: low-variance sampling.
  void resample(RandomStream& random);
  /// Moves all so that their mean and covariance become these; their shape stays as far as it can. Where they are nearly all alike in
  /// something, they have no shape that could be kept, and are scattered again.
  void shape(const PoseSpread& wanted, RandomStream& random);

  [[nodiscard]] PoseSpread spread() const;
  [[nodiscard]] std::span<const Particle> all() const { return particles_; }

 private:
  [[nodiscard]] std::size_t needed(RandomStream& random) const;

  ParticleOptions options_;
  std::vector<Particle> particles_;
};

}  // namespace orca::nav
