// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/pose_graph.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::nav {
namespace {

using Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

Eigen::Matrix3d matrix_of(const PoseInformation& i) {
  Eigen::Matrix3d m;
  m << i.xx, i.xy, i.xt, i.xy, i.yy, i.yt, i.xt, i.yt, i.tt;
  return m;
}

Eigen::Vector3d error_of(const PoseRelation& relation, std::span<const Pose2> poses) {
  const Pose2 said = seen_from(poses[relation.from], poses[relation.to]);
  const double turned = wrapped(said.yaw - relation.measured.yaw);
  return {said.x - relation.measured.x, said.y - relation.measured.y, 2.0 * portable::sin(turned / 2.0)};
}

// The share by which a doubtful relation counts, its square being that of the information.
double weight_of(double misfit, double doubted_from) {
  return std::min(1.0, 2.0 * doubted_from / (doubted_from + misfit));
}

// The first pose stays where it is, so it has no column.
Index column(std::size_t pose) { return 3 * static_cast<Index>(pose) - 3; }

/// The equations of one step: H d = -b.
class Equations {
 public:
  explicit Equations(const PoseGraph& graph)
      : size_(3 * (static_cast<Index>(graph.poses.size()) - 1)), b_(Eigen::VectorXd::Zero(size_)) {
    triplets_.reserve(graph.relations.size() * 27 + static_cast<std::size_t>(size_));
  }

  void add(const PoseRelation& relation, std::span<const Pose2> poses, double weight) {
    const Pose2& from = poses[relation.from];
    const Eigen::Vector3d e = error_of(relation, poses);
    const Pose2 said = seen_from(from, poses[relation.to]);
    const double half = portable::cos(wrapped(said.yaw - relation.measured.yaw) / 2.0);
    const Vec2 ahead = direction(from.yaw);
    Eigen::Matrix3d to;  // the derivative of e by the pose `to`
    to << ahead.x, ahead.y, 0, -ahead.y, ahead.x, 0, 0, 0, half;
    Eigen::Matrix3d by_from = -to;
    by_from(0, 2) = said.y;
    by_from(1, 2) = -said.x;
    const Eigen::Matrix3d information = weight * matrix_of(relation.information);
    put(relation.from, relation.from, by_from.transpose() * information * by_from);
    put(relation.to, relation.to, to.transpose() * information * to);
    // Only the lower half is read.
    if (relation.from > relation.to)
      put(relation.from, relation.to, by_from.transpose() * information * to);
    else
      put(relation.to, relation.from, to.transpose() * information * by_from);
    if (relation.from > 0) b_.segment<3>(column(relation.from)) += by_from.transpose() * information * e;
    if (relation.to > 0) b_.segment<3>(column(relation.to)) += to.transpose() * information * e;
  }

  [[nodiscard]] Sparse matrix() const {
    Sparse matrix(size_, size_);
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    return matrix;
  }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }

 private:
  void put(std::size_t row, std::size_t col, const Eigen::Matrix3d& block) {
    if (row == 0 || col == 0) return;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (row != col || i >= j) triplets_.emplace_back(column(row) + i, column(col) + j, block(i, j));
  }

  Index size_;
  Triplets triplets_;
  Eigen::VectorXd b_;
};

double misfit_of_all(const PoseGraph& graph, const PoseGraphOptions& options, std::vector<double>& weights) {
  double sum = 0.0;
  weights.clear();
  for (const PoseRelation& relation : graph.relations) {
    const double missed = misfit(relation, graph.poses);
    const double share = relation.doubtful ? weight_of(missed, options.doubted_from) : 1.0;
    weights.push_back(share * share);
    // Dynamic covariance scaling minimises this of s: s^2 e + (1 - s)^2 Phi.
    sum += share * share * missed + (1.0 - share) * (1.0 - share) * options.doubted_from;
  }
  return sum;
}

std::vector<Pose2> moved(std::span<const Pose2> poses, const Eigen::VectorXd& step) {
  std::vector<Pose2> result(poses.begin(), poses.end());
  for (std::size_t i = 1; i < result.size(); ++i) {
    const Index at = column(i);
    result[i] = {poses[i].x + step[at], poses[i].y + step[at + 1], wrapped(poses[i].yaw + step[at + 2])};
  }
  return result;
}

// Adds to normal equations in pairs of numbers, complex ones: |w_to z_to - w_from z_from - value|^2 weight.
class PairEquations {
 public:
  explicit PairEquations(std::size_t poses)
      : size_(2 * (static_cast<Index>(poses) - 1)), right_(Eigen::VectorXd::Zero(size_)) {}

  // Adds |z_to - m z_from - d|^2; the value of the first pose is known.
  void add(std::size_t from, std::size_t to, Vec2 m, Vec2 d, Vec2 first, double weight) {
    Eigen::Matrix2d turn;
    turn << m.x, -m.y, m.y, m.x;
    const Eigen::Vector2d known(d.x, d.y);
    const Eigen::Vector2d z0(first.x, first.y);
    const Eigen::Matrix2d eye = Eigen::Matrix2d::Identity();
    const Eigen::Vector2d rest = known + (from == 0 ? Eigen::Vector2d(turn * z0) : Eigen::Vector2d::Zero()) -
                                 (to == 0 ? z0 : Eigen::Vector2d::Zero());
    put(to, to, weight * eye);
    put(from, from, weight * turn.transpose() * turn);
    if (to > from)
      put(to, from, -weight * turn);
    else
      put(from, to, -weight * turn.transpose());
    if (to > 0) right_.segment<2>(2 * static_cast<Index>(to) - 2) += weight * rest;
    if (from > 0) right_.segment<2>(2 * static_cast<Index>(from) - 2) -= weight * turn.transpose() * rest;
  }

  // Returns the values of all poses but the first, or nothing if not all are tied to it.
  [[nodiscard]] Eigen::VectorXd solution() const {
    Sparse matrix(size_, size_);
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    const Eigen::SimplicialLDLT<Sparse> solver(matrix);
    if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() <= 0.0) return {};
    return solver.solve(right_);
  }

 private:
  void put(std::size_t row, std::size_t col, const Eigen::Matrix2d& block) {
    if (row == 0 || col == 0) return;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        if (row != col || i >= j)
          triplets_.emplace_back(2 * static_cast<Index>(row) - 2 + i, 2 * static_cast<Index>(col) - 2 + j,
                                 block(i, j));
  }

  Index size_;
  Triplets triplets_;
  Eigen::VectorXd right_;
};

double weight_of_place(const PoseInformation& information) { return (information.xx + information.yy) / 2.0; }

}  // namespace

std::array<double, 9> covariance_of(const PoseInformation& information, double yaw) {
  const Vec2 ahead = direction(yaw);
  Eigen::Matrix3d turn;
  turn << ahead.x, -ahead.y, 0, ahead.y, ahead.x, 0, 0, 0, 1;
  const Eigen::Matrix3d c = turn * matrix_of(information).inverse() * turn.transpose();
  return {c(0, 0), c(1, 0), c(2, 0), c(1, 0), c(1, 1), c(2, 1), c(2, 0), c(2, 1), c(2, 2)};
}

PoseInformation after(const PoseInformation& known, const Pose2& step, const PoseInformation& travel) {
  const Vec2 ahead = direction(step.yaw);
  Eigen::Matrix3d back;  // into the frame at the end of the step
  back << ahead.x, ahead.y, 0, -ahead.y, ahead.x, 0, 0, 0, 1;
  Eigen::Matrix3d moved = Eigen::Matrix3d::Identity();
  moved(0, 2) = -step.y;
  moved(1, 2) = step.x;
  const Eigen::Matrix3d covariance =
      back * (moved * matrix_of(known).inverse() * moved.transpose() + matrix_of(travel).inverse()) *
      back.transpose();
  const Eigen::Matrix3d i = covariance.inverse();
  return {i(0, 0), i(0, 1), i(1, 1), i(0, 2), i(1, 2), i(2, 2)};
}

double misfit(const PoseRelation& relation, std::span<const Pose2> poses) {
  const Eigen::Vector3d e = error_of(relation, poses);
  return e.dot(matrix_of(relation.information) * e);
}

bool begin_anew(PoseGraph& graph) {
  if (graph.poses.size() < 2) return true;
  PairEquations directions(graph.poses.size());
  for (const PoseRelation& r : graph.relations)
    if (!r.doubtful)
      directions.add(r.from, r.to, direction(r.measured.yaw), {}, direction(graph.poses[0].yaw),
                     r.information.tt);
  const Eigen::VectorXd u = directions.solution();
  if (u.size() == 0) return false;
  std::vector<Pose2> poses = graph.poses;
  for (std::size_t i = 1; i < poses.size(); ++i)
    poses[i].yaw = portable::atan2(u[2 * static_cast<Index>(i) - 1], u[2 * static_cast<Index>(i) - 2]);
  PairEquations places(poses.size());
  for (const PoseRelation& r : graph.relations)
    if (!r.doubtful)
      places.add(r.from, r.to, {1.0, 0.0}, rotated(r.measured.position(), poses[r.from].yaw),
                 poses[0].position(), weight_of_place(r.information));
  const Eigen::VectorXd t = places.solution();
  if (t.size() == 0 || !t.allFinite()) return false;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i].x = t[2 * static_cast<Index>(i) - 2];
    poses[i].y = t[2 * static_cast<Index>(i) - 1];
  }
  graph.poses = std::move(poses);
  return true;
}

PoseGraphFit fit(PoseGraph& graph, const PoseGraphOptions& options) {
  PoseGraphFit result;
  std::vector<double> weights;
  result.misfit = misfit_of_all(graph, options, weights);
  result.solved = std::isfinite(result.misfit);
  if (!result.solved) return result;
  const std::vector<Pose2> first = graph.poses;
  if (graph.poses.size() < 2) return result;
  Eigen::SimplicialLDLT<Sparse> solver;
  double damping = 0.0;
  bool analysed = false;
  while (result.iterations < options.iterations) {
    ++result.iterations;
    Equations equations(graph);
    for (std::size_t i = 0; i < graph.relations.size(); ++i)
      equations.add(graph.relations[i], graph.poses, weights[i]);
    Sparse matrix = equations.matrix();
    if (damping > 0.0) matrix.diagonal() *= 1.0 + damping;
    if (!analysed) solver.analyzePattern(matrix);
    analysed = true;
    solver.factorize(matrix);
    if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() <= 0.0) {
      graph.poses = first;
      result.solved = false;
      return result;
    }
    const Eigen::VectorXd step = solver.solve(-equations.b());
    std::vector<Pose2> before = std::exchange(graph.poses, moved(graph.poses, step));
    const double now = misfit_of_all(graph, options, weights);
    if (!(now <= result.misfit)) {
      graph.poses = std::move(before);
      (void)misfit_of_all(graph, options, weights);
      damping = damping > 0.0 ? damping * 10.0 : 1e-4;
      if (damping > 1e6) break;
      continue;
    }
    const double gain = result.misfit - now;
    result.misfit = now;
    damping = damping > 1e-6 ? damping / 10.0 : 0.0;
    if (gain <= options.gain * now) break;
  }
  return result;
}

}  // namespace orca::nav
