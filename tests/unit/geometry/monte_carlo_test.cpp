// SPDX-License-Identifier: GPL-3.0-or-later
// Propagated covariances against the spread of many drawn samples. The errors are small enough that the terms
// beyond first order (about sigma^2 = 1e-4 of the covariance per radian squared) are far below the random
// error of the sample.
#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/odometry.hpp"
#include "poses.hpp"

using namespace orca;
using namespace orca::test;

namespace {

constexpr int kSamples = 20'000;

// Five standard errors. Among the 360 entries compared here, chance exceeds it in 1 of 5000 choices of seeds.
constexpr double kErrors = 5.0;

// Returns how far `sample`'s covariance is from `expected` in the worst entry, in standard errors of that
// entry: var(S_ij) = (C_ii C_jj + C_ij^2) / (n - 1) for n normal samples.
template <int N>
double worst_error(const Matrix<N>& sample, const Matrix<N>& expected) {
  double worst = 0.0;
  for (int i = 0; i < N; ++i)
    for (int j = i; j < N; ++j) {
      const double variance = expected(i, i) * expected(j, j) + expected(i, j) * expected(i, j);
      worst = std::max(worst, std::abs(sample(i, j) - expected(i, j)) / std::sqrt(variance / (kSamples - 1)));
    }
  return worst;
}

// Returns the covariance of kSamples values that `draw` gives, around `mean`.
template <int N, class Draw>
Matrix<N> sample_covariance(const Vector<N>& mean, Draw&& draw) {
  Vector<N> sum = Vector<N>::Zero();
  Matrix<N> squares = Matrix<N>::Zero();
  for (int i = 0; i < kSamples; ++i) {
    const Vector<N> d = difference<N>(mean, draw());
    sum += d;
    squares += d * d.transpose();
  }
  return (squares - sum * sum.transpose() / kSamples) / (kSamples - 1);
}

template <int N>
Matrix<N> root_of(const Matrix<N>& covariance) {
  return Eigen::LLT<Matrix<N>>(covariance).matrixL();
}

}  // namespace

TEST_CASE("the covariance of composed poses in the plane is that of a sample", "[geometry][monte_carlo]") {
  RandomStream random(GENERATE(31, 32, 33, 34, 35, 36), "test", "plane");
  const idl::Pose2D a = random_pose2(random, 0.01);
  const idl::Pose2D b = random_pose2(random, 0.01);
  const Matrix<3> root_a = root_of<3>(covariance_of(a));
  const Matrix<3> root_b = root_of<3>(covariance_of(b));
  const idl::Pose2D expected = compose(a, b);
  const Matrix<3> sample = sample_covariance<3>(vector_of(expected), [&] {
    const Vector<3> drawn_a = vector_of(a) + root_a * normal<3>(random, 1.0);
    const Vector<3> drawn_b = vector_of(b) + root_b * normal<3>(random, 1.0);
    return vector_of(compose(pose_of(drawn_a), pose_of(drawn_b)));
  });
  CHECK(worst_error<3>(sample, covariance_of(expected)) < kErrors);

  const idl::Pose2D back = inverse(a);
  const Matrix<3> sample_back = sample_covariance<3>(vector_of(back), [&] {
    return vector_of(inverse(pose_of(Vector<3>(vector_of(a) + root_a * normal<3>(random, 1.0)))));
  });
  CHECK(worst_error<3>(sample_back, covariance_of(back)) < kErrors);
}

TEST_CASE("the covariance of composed poses in space is that of a sample", "[geometry][monte_carlo]") {
  RandomStream random(GENERATE(41, 42, 43, 44, 45, 46), "test", "space");
  idl::Pose3D a;
  idl::Pose3D b;
  do {  // Near straight up first order does not hold.
    a = random_pose3(random, 0.003);
    b = random_pose3(random, 0.003);
  } while (std::cos(compose(a, b)->rotation().pitch()) < 0.5 ||
           std::cos(inverse(a)->rotation().pitch()) < 0.5);
  const Matrix<6> root_a = root_of<6>(covariance_of(a));
  const Matrix<6> root_b = root_of<6>(covariance_of(b));
  const idl::Pose3D expected = compose(a, b).value();
  const Matrix<6> sample = sample_covariance<6>(vector_of(expected), [&] {
    const Vector<6> drawn_a = vector_of(a) + root_a * normal<6>(random, 1.0);
    const Vector<6> drawn_b = vector_of(b) + root_b * normal<6>(random, 1.0);
    return vector_of(compose(pose_of(drawn_a), pose_of(drawn_b)).value());
  });
  CHECK(worst_error<6>(sample, covariance_of(expected)) < kErrors);

  const idl::Pose3D back = inverse(a).value();
  const Matrix<6> sample_back = sample_covariance<6>(vector_of(back), [&] {
    return vector_of(inverse(pose_of(Vector<6>(vector_of(a) + root_a * normal<6>(random, 1.0)))).value());
  });
  CHECK(worst_error<6>(sample_back, covariance_of(back)) < kErrors);
}

TEST_CASE("the covariance of odometry is that of a sample of drives", "[geometry][monte_carlo]") {
  RandomStream random(GENERATE(51, 52, 53, 54, 55, 56), "test", "odometry");
  constexpr double kTrack = 0.35;
  const WheelErrorGuess guess{.diameter = 5e-4, .track = 1e-3, .slip = 1e-3};
  std::array<Vec2, 20> way;  // travel of the left and of the right wheel
  for (Vec2& wheels : way) wheels = {random.uniform(-0.05, 0.1), random.uniform(-0.05, 0.1)};
  const auto next = [](const Pose2& pose, double left, double right, double track) {
    return along_arc(pose, {0.5 * (left + right), 0.0, (right - left) / track});
  };
  OdometryUncertainty uncertainty(idl::DIFFERENTIAL, kTrack, guess);
  Pose2 expected;
  for (const Vec2& wheels : way) uncertainty.move_to(expected = next(expected, wheels.x, wheels.y, kTrack));
  const Vector<3> mean(expected.x, expected.y, expected.yaw);
  const Matrix<3> sample = sample_covariance<3>(mean, [&] {
    const double left = 1.0 + random.normal(0.0, guess.diameter);
    const double right = 1.0 + random.normal(0.0, guess.diameter);
    const double track = kTrack * (1.0 + random.normal(0.0, guess.track));
    const auto slipped = [&](double travel) {
      return random.normal(0.0, guess.slip * std::sqrt(std::abs(travel)));
    };
    Pose2 pose;
    for (const Vec2& wheels : way)
      pose = next(pose, wheels.x * left + slipped(wheels.x), wheels.y * right + slipped(wheels.y), track);
    return Vector<3>(pose.x, pose.y, pose.yaw);
  });
  const std::array<double, 9> entries = uncertainty.covariance();
  CHECK(worst_error<3>(sample, Eigen::Map<const Matrix<3>>(entries.data())) < kErrors);
}
