// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/particles.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "orca/base/portable_math.hpp"

namespace orca::nav {
namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Matrix matrix_of(const std::array<double, 9>& covariance) {
  return Eigen::Map<const Matrix>(covariance.data());
}

std::array<double, 9> array_of(const Matrix& matrix) {
  std::array<double, 9> result{};
  Eigen::Map<Matrix>(result.data()) = 0.5 * (matrix + matrix.transpose());
  return result;
}

Eigen::Vector3d off(const Pose2& pose, const Pose2& from) {
  return {pose.x - from.x, pose.y - from.y, wrapped(pose.yaw - from.yaw)};
}

Pose2 moved(const Pose2& from, const Eigen::Vector3d& by) {
  return {from.x + by[0], from.y + by[1], wrapped(from.yaw + by[2])};
}

// Returns the lower triangle whose square the covariance is. Where it is flat, a little is added: a micrometre. A matrix that is no
// covariance counts by its diagonal, as far as that is positive.
Matrix root_of(const std::array<double, 9>& covariance) {
  Matrix matrix = matrix_of(covariance);
  matrix.diagonal().array() += 1e-12;
  const Eigen::LLT<Matrix> root(matrix);
  if (root.info() == Eigen::Success && matrix.allFinite()) return root.matrixL();
  Matrix diagonal = Matrix::Zero();
  for (Eigen::Index i = 0; i < 3; ++i)
    diagonal(i, i) = std::isfinite(matrix(i, i)) && matrix(i, i) > 1e-12 ? std::sqrt(matrix(i, i)) : 1e-6;
  return diagonal;
}

// Returns how many particles k bins need; Fox 2003, eq. 7, by the approximation of Wilson and Hilferty.
std::size_t needed_for(std::size_t bins, double error) {
  if (bins < 2) return 1;
  constexpr double kQuantile = 2.326;  // of the normal distribution at 99 %
  const double k = static_cast<double>(bins - 1);
  const double part = 2.0 / (9.0 * k);
  const double root = 1.0 - part + std::sqrt(part) * kQuantile;
  return static_cast<std::size_t>(std::ceil(k / (2.0 * error) * root * root * root));
}

}  // namespace

PoseSpread fused(const PoseSpread& a, const PoseSpread& b) {
  const Matrix A = matrix_of(a.covariance);
  const Matrix gain = A * (A + matrix_of(b.covariance)).inverse();
  return {moved(a.mean, gain * off(b.mean, a.mean)), array_of(A - gain * A)};
}

PoseSpread mixed(const PoseSpread& likely, const PoseSpread& other, double share) {
  const Eigen::Vector3d away = off(other.mean, likely.mean);
  const Matrix about_likely = matrix_of(other.covariance) + away * away.transpose();
  return {likely.mean, array_of((1.0 - share) * matrix_of(likely.covariance) + share * about_likely)};
}

PoseSpread after(const PoseSpread& before, const Pose2& step, const std::array<double, 3>& deviations) {
  const Vec2 chord = rotated(step.position(), before.mean.yaw);
  Matrix by_start = Matrix::Identity();
  by_start(0, 2) = -chord.y;
  by_start(1, 2) = chord.x;
  const Vec2 ahead = direction(before.mean.yaw);
  Matrix by_step = Matrix::Identity();
  by_step.topLeftCorner<2, 2>() << ahead.x, -ahead.y, ahead.y, ahead.x;
  const Eigen::Vector3d variance(deviations[0] * deviations[0], deviations[1] * deviations[1],
                                 deviations[2] * deviations[2]);
  return {before.mean * step, array_of(by_start * matrix_of(before.covariance) * by_start.transpose() +
                                       by_step * variance.asDiagonal() * by_step.transpose())};
}

std::array<double, 3> deviations_of(const Reckoned& before, const Reckoned& now) {
  const Pose2 step = seen_from(before.X_OR, now.X_OR);
  const double way = norm(step.position());
  const double turn = std::fabs(step.yaw);
  // The part that comes of the errors so far is taken off; the rest is its own.
  const Vec2 chord = now.X_OR.position() - before.X_OR.position();
  const auto& a = before.covariance;
  const auto& b = now.covariance;
  const double xx = b[0] - (a[0] - 2.0 * chord.y * a[2] + chord.y * chord.y * a[8]);
  const double yy = b[4] - (a[4] + 2.0 * chord.x * a[5] + chord.x * chord.x * a[8]);
  const double place = std::sqrt(std::max(0.0, 0.5 * (xx + yy)));
  const double turned = std::sqrt(std::max(0.0, b[8] - a[8]));
  const double least = 0.002 + 0.02 * way + 0.01 * turn;
  const double least_turn = 0.003 + 0.05 * turn + 0.03 * way;
  const double most = least + 0.2 * way;
  const double most_turn = least_turn + 0.2 * turn + 0.1 * way;
  const double of_place = std::clamp(place, least, most);
  return {of_place, of_place, std::clamp(turned, least_turn, most_turn)};
}

double squared_distance(const PoseSpread& spread, const Pose2& pose) {
  const Eigen::Vector3d away = off(pose, spread.mean);
  return away.dot(matrix_of(spread.covariance).ldlt().solve(away));
}

double deviation_of(const PoseSpread& spread) {
  return std::sqrt(spread.covariance[0] + spread.covariance[4]);
}

PoseInformation information_of(const PoseSpread& spread) {
  const Vec2 ahead = direction(spread.mean.yaw);
  Matrix turn = Matrix::Identity();
  turn.topLeftCorner<2, 2>() << ahead.x, -ahead.y, ahead.y, ahead.x;
  const Matrix known = turn.transpose() * matrix_of(spread.covariance).inverse() * turn;
  return {known(0, 0), known(0, 1), known(1, 1), known(0, 2), known(1, 2), known(2, 2)};
}

void Particles::scatter(const PoseSpread& around, std::size_t count, RandomStream& random) {
  const Matrix root = root_of(around.covariance);
  particles_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.normal(0.0, 1.0);
    const double y = random.normal(0.0, 1.0);
    const double yaw = random.normal(0.0, 1.0);
    particles_.push_back(
        {moved(around.mean, root * Eigen::Vector3d(x, y, yaw)), 1.0 / static_cast<double>(count)});
  }
}

void Particles::put(std::span<const Pose2> poses) {
  particles_.clear();
  for (const Pose2& pose : poses) particles_.push_back({pose, 1.0 / static_cast<double>(poses.size())});
}

void Particles::move(const Pose2& step, const std::array<double, 3>& deviations, RandomStream& random) {
  for (Particle& particle : particles_) {
    const double x = random.normal(step.x, deviations[0]);
    const double y = random.normal(step.y, deviations[1]);
    const double yaw = random.normal(step.yaw, deviations[2]);
    particle.X_MR = particle.X_MR * Pose2{x, y, yaw};
  }
}

// Draws particles until there are as many as the bins that they have hit need.
std::size_t Particles::needed(RandomStream& random) const {
  std::vector<double> until;
  double sum = 0.0;
  for (const Particle& particle : particles_) until.push_back(sum += particle.weight);
  std::set<std::array<int, 3>> bins;
  std::size_t drawn = 0;
  std::size_t enough = options_.least;
  while (drawn < std::min(enough, options_.most)) {
    const auto found = std::ranges::upper_bound(until, random.uniform(0.0, sum));
    const auto at = static_cast<std::size_t>(std::min(found, until.end() - 1) - until.begin());
    const Pose2& pose = particles_[at].X_MR;
    bins.insert({static_cast<int>(std::floor(pose.x / options_.bin)),
                 static_cast<int>(std::floor(pose.y / options_.bin)),
                 static_cast<int>(std::floor(pose.yaw / options_.bin_turn))});
    enough = std::max(options_.least, needed_for(bins.size(), options_.error));
    ++drawn;
  }
  return drawn;
}

void Particles::resample(RandomStream& random) {
  double squares = 0.0;
  for (const Particle& particle : particles_) squares += particle.weight * particle.weight;
  const auto count = static_cast<double>(particles_.size());
  // Equal enough: drawing would only lose some.
  if (particles_.empty() || 1.0 / squares > 0.5 * count) return;
  const std::size_t wanted = needed(random);
  const double each = 1.0 / static_cast<double>(wanted);
  std::vector<Particle> drawn;
  drawn.reserve(wanted);
  double at = random.uniform(0.0, each);
  double sum = 0.0;
  for (const Particle& particle : particles_) {
    sum += particle.weight;
    for (; at < sum && drawn.size() < wanted; at += each) drawn.push_back({particle.X_MR, each});
  }
  while (drawn.size() < wanted) drawn.push_back({particles_.back().X_MR, each});
  particles_ = std::move(drawn);
}

void Particles::shape(const PoseSpread& wanted, RandomStream& random) {
  constexpr double kFlat = 0.1;  // of a variance that is 1 unless root_of() had to add what is missing
  const PoseSpread now = spread();
  const Matrix whitening = root_of(now.covariance).inverse();
  const Matrix white = whitening * matrix_of(now.covariance) * whitening.transpose();
  if (white.diagonal().minCoeff() < kFlat) return scatter(wanted, particles_.size(), random);
  const Matrix change = root_of(wanted.covariance) * whitening;
  for (Particle& particle : particles_)
    particle.X_MR = moved(wanted.mean, change * off(particle.X_MR, now.mean));
}

PoseSpread Particles::spread() const {
  PoseSpread result;
  if (particles_.empty()) return result;
  Vec2 ahead;
  for (const Particle& particle : particles_) ahead = ahead + particle.weight * direction(particle.X_MR.yaw);
  // Offsets are taken from a particle, so that large coordinates cancel.
  Pose2 about = particles_.front().X_MR;
  about.yaw = portable::atan2(ahead.y, ahead.x);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Particle& particle : particles_) sum += particle.weight * off(particle.X_MR, about);
  result.mean = moved(about, sum);
  Matrix covariance = Matrix::Zero();
  for (const Particle& particle : particles_) {
    const Eigen::Vector3d away = off(particle.X_MR, result.mean);
    covariance += particle.weight * away * away.transpose();
  }
  result.covariance = array_of(covariance);
  return result;
}

}  // namespace orca::nav
