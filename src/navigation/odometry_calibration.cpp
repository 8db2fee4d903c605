// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/odometry_calibration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/navigation/pose_history.hpp"

namespace orca::nav {
namespace {

constexpr std::size_t kLeastPieces = 240;
constexpr double kLeastDriven = 10.0;                    // [m]
constexpr double kLeastTurned = 4.0 * std::numbers::pi;  // [rad]
// Pieces. In shorter stretches the times of scans and odometry, which are late by more or less, make more of them short than long.
constexpr std::array<std::size_t, 4> kStretches{8, 16, 32, 64};
constexpr std::size_t kOverlap = 4;  // stretches that share a piece: it matters little where they begin
constexpr std::size_t kLeastStretches = 8 * kOverlap;  // of fewer it is not known how far they scatter
constexpr int kFitRounds = 30;
constexpr int kSquareRounds = 20;
constexpr double kPull =
    2.385;  // of Cauchy's weights, in deviations: 95 % as good as least squares where errors are normal

// Sums over some pieces that follow each other.
struct Stretch {
  double way = 0.0, turn = 0.0;            // counted
  double true_way = 0.0, true_turn = 0.0;  // measured
  double rolled = 0.0, turned = 0.0;       // what slip grows with: the ways of both wheels, and the angle
};

std::vector<Stretch> stretches_of(std::span<const DrivenPiece> pieces, std::size_t count, double track) {
  std::vector<Stretch> all;
  for (std::size_t i = 0; i + count <= pieces.size(); i += count / kOverlap) {
    Stretch& sum = all.emplace_back();
    for (const DrivenPiece& piece : pieces.subspan(i, count)) {
      const Travel2 truly = arc_between({}, piece.X_AB);
      sum.way += piece.way;
      sum.turn += piece.turn;
      sum.true_way += truly.forward;
      sum.true_turn += truly.turn;
      sum.rolled += 2.0 * std::max(piece.covered, 0.5 * track * piece.turned);
      sum.turned += piece.turned;
    }
  }
  return all;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A quantity as a sum of two others, or of one: the factors of each, and how sure these are.
struct Fit {
  std::array<Measured, 2> factors{};
  double deviation = 0.0;  // of one residual
};

// @param rows  the two, and the sum; the second is 0 in all rows if there is one.
std::optional<Fit> fit_factors(const std::vector<std::array<double, 3>>& rows) {
  if (rows.size() < kLeastStretches) return std::nullopt;
  const bool is_one = std::ranges::all_of(rows, [](const auto& row) { return row[1] == 0.0; });
  std::vector<double> weights(rows.size(), 1.0);
  Eigen::Vector2d factors = Eigen::Vector2d::Zero();
  Eigen::Matrix2d normal;
  Fit result;
  for (int round = 0; round < kFitRounds; ++round) {
    normal.setZero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Eigen::Vector2d a(rows[i][0], rows[i][1]);
      normal += weights[i] * a * a.transpose();
      right += weights[i] * rows[i][2] * a;
    }
    if (is_one) normal(1, 1) = normal(0, 0);
    if (normal.determinant() < 1e-9 * normal.trace() * normal.trace()) return std::nullopt;
    factors = normal.inverse() * right;
    std::vector<double> off;
    for (const auto& row : rows) off.push_back(std::fabs(row[2] - factors[0] * row[0] - factors[1] * row[1]));
    result.deviation = std::max(1.4826 * median(off), 1e-9);  // of normal errors with that median
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double pull = off[i] / (kPull * result.deviation);
      weights[i] = 1.0 / (1.0 + pull * pull);
    }
  }
  const Eigen::Matrix2d covariance =
      static_cast<double>(kOverlap) * result.deviation * result.deviation * normal.inverse();
  for (int k = 0; k < 2; ++k)
    result.factors[static_cast<std::size_t>(k)] = {factors[k], std::sqrt(covariance(k, k))};
  return result;
}

// Takes the more certain one of each.
void keep_better(Measured& best, const Measured& other) {
  if (best.deviation == 0.0 || other.deviation < best.deviation) best = other;
}

// Finds slip: how the squares of what turns are off grow with the ways of the wheels and with the angle, besides what each measurement is off.
void find_slip(std::span<const DrivenPiece> pieces, double track, OdometryCalibration& found) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::size_t count : kStretches) {
    const std::vector<Stretch> stretches = stretches_of(pieces, count, track);
    if (stretches.size() < kLeastStretches) break;
    std::vector<double> squares;
    for (const Stretch& s : stretches) {
      const double off = s.true_turn - found.turn_scale.value * s.turn - found.turn_per_metre.value * s.way;
      squares.push_back(off * off);
    }
    const double usual = std::max(median(squares) / 0.455, 1e-12);  // of chi square with that median
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const Eigen::Vector3d a(1.0, stretches[i].rolled / (track * track),
                              2.0 * stretches[i].turned / (track * track));
      normal += a * a.transpose() / (usual * usual);
      right += std::min(squares[i], 9.0 * usual) * a / (usual * usual);
    }
  }
  // None of them is negative: that which would be is left out.
  std::array<bool, 3> out{};
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();
  for (int round = 0; round < 3; ++round) {
    Eigen::Matrix3d m = normal;
    Eigen::Vector3d r = right;
    for (int k = 0; k < 3; ++k) {
      if (!out[static_cast<std::size_t>(k)]) continue;
      m.row(k).setZero();
      m.col(k).setZero();
      m(k, k) = 1.0;
      r[k] = 0.0;
    }
    variances = m.ldlt().solve(r);
    Eigen::Index worst = 0;
    if (variances.minCoeff(&worst) >= 0.0) break;
    out[static_cast<std::size_t>(worst)] = true;
  }
  found.left.slip = std::sqrt(std::max(0.0, variances[1]));
  found.left.turn_slip = std::sqrt(std::max(0.0, variances[2]));
}

// Returns where a square ends that bends on each leg, and turns too little at each corner.
Vec2 end_of_square(double side, bool clockwise, double alpha, double beta) {
  const double corner = 0.5 * std::numbers::pi - alpha;
  Pose2 X_SB;
  for (int leg = 0; leg < 4; ++leg)
    X_SB = along_arc(along_arc(X_SB, {side, 0.0, beta}), {0.0, 0.0, clockwise ? -corner : corner});
  return X_SB.position();
}

Status check_drive(std::span<const DrivenPiece> pieces) {
  double way = 0.0;
  double turned = 0.0;
  for (const DrivenPiece& piece : pieces) {
    way += piece.covered;
    turned += piece.turned;
  }
  if (pieces.size() >= kLeastPieces && way >= kLeastDriven && turned >= kLeastTurned) return ok();
  const auto whole = [](double value) { return std::to_string(static_cast<long>(value)); };
  return fail(Code::failed_precondition,
              "the drive shows too little: " + std::to_string(pieces.size()) + " pieces, " + whole(way) +
                  " m and " + whole(turned / (2.0 * std::numbers::pi)) +
                  " full turns; drive 50 m at least, better 200, and turn left and right");
}

}  // namespace

void CountHistory::add(TimePoint stamp, const Pose2& X_OB) {
  if (!stamps_.empty() && stamp <= stamps_.back()) return;
  Counted next = counted_.empty() ? Counted{} : counted_.back();
  const Travel2 step = counted_.empty() ? Travel2{} : arc_between(next.X_OB, X_OB);
  next.X_OB = X_OB;
  next.way += step.forward;
  next.turn += step.turn;
  next.covered += std::fabs(step.forward);
  next.turned += std::fabs(step.turn);
  stamps_.push_back(stamp);
  counted_.push_back(next);
}

std::optional<Counted> CountHistory::at(TimePoint stamp) const {
  const auto after = std::lower_bound(stamps_.begin(), stamps_.end(), stamp);
  if (after == stamps_.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - stamps_.begin());
  if (*after == stamp) return counted_[i];
  if (i == 0) return std::nullopt;
  const Counted& a = counted_[i - 1];
  const Counted& b = counted_[i];
  const double share = to_seconds(stamp - stamps_[i - 1]) / to_seconds(*after - stamps_[i - 1]);
  const auto part = [share](double from, double to) { return from + share * (to - from); };
  return Counted{between(a.X_OB, b.X_OB, share), part(a.way, b.way), part(a.turn, b.turn),
                 part(a.covered, b.covered), part(a.turned, b.turned)};
}

DrivenPiece piece_between(const Counted& begin, const Counted& end, const Pose2& X_AB) {
  return {end.way - begin.way, end.turn - begin.turn, end.covered - begin.covered, end.turned - begin.turned,
          X_AB};
}

double OdometryCalibration::wheel_ratio(double track) const {
  const double half = 0.5 * turn_per_metre.value * track / turn_scale.value;
  return (1.0 + half) / (1.0 - half);
}

Result<OdometryCalibration> calibrate(std::span<const DrivenPiece> pieces, double track) {
  if (Status enough = check_drive(pieces); !enough.ok()) return enough.error();
  OdometryCalibration found;
  found.pieces = pieces.size();
  for (const std::size_t count : kStretches) {
    std::vector<std::array<double, 3>> turns;
    for (const Stretch& s : stretches_of(pieces, count, track)) turns.push_back({s.turn, s.way, s.true_turn});
    const auto turn = fit_factors(turns);
    if (!turn) continue;
    keep_better(found.turn_scale, turn->factors[0]);
    keep_better(found.turn_per_metre, turn->factors[1]);
  }
  if (found.turn_scale.deviation == 0.0)
    return fail(Code::failed_precondition,
                "the drive does not tell way from turn; drive straight, too, and turn left and right");
  // Unlike wheels also drive on while they turn on the spot.
  const double way_per_turn = 0.25 * found.turn_per_metre.value * track * track / found.turn_scale.value;
  for (const std::size_t count : kStretches) {
    std::vector<std::array<double, 3>> ways;
    for (const Stretch& s : stretches_of(pieces, count, track))
      ways.push_back({s.way, 0.0, s.true_way - way_per_turn * s.turn});
    if (const auto way = fit_factors(ways)) keep_better(found.distance_scale, way->factors[0]);
  }
  // The mean of two wheels is off by their deviation over root 2, their difference by root 2 times it.
  found.left.diameter = std::max(std::numbers::sqrt2 * found.distance_scale.deviation,
                                 track * found.turn_per_metre.deviation / std::numbers::sqrt2);
  found.left.track = found.turn_scale.deviation;
  find_slip(pieces, track, found);
  return found;
}

std::optional<SquareResult> evaluate_squares(std::span<const SquareEnd> squares, double side, double track) {
  SquareResult result;
  std::array<int, 2> count{};
  for (const SquareEnd& square : squares) {
    Vec2& sum = square.clockwise ? result.clockwise : result.counterclockwise;
    sum = sum + square.off;
    ++count[square.clockwise ? 1 : 0];
  }
  if (count[0] == 0 || count[1] == 0) return std::nullopt;
  result.clockwise = (1.0 / count[1]) * result.clockwise;
  result.counterclockwise = (1.0 / count[0]) * result.counterclockwise;
  result.error = std::max(norm(result.clockwise), norm(result.counterclockwise));
  double alpha = 0.0;  // [rad] by which less is counted of each turn
  double beta = 0.0;   // [rad] by which each leg bends to the left, as it is counted
  for (int round = 0; round < kSquareRounds; ++round) {
    const double cw = -result.clockwise.x - end_of_square(side, true, alpha, beta).x;
    const double ccw = -result.counterclockwise.x - end_of_square(side, false, alpha, beta).x;
    alpha += (cw + ccw) / (-4.0 * side);
    beta += (cw - ccw) / (-4.0 * side);
  }
  const double quarter = 0.5 * std::numbers::pi;
  result.track_ratio = (quarter - alpha) / quarter;
  const double half = -0.5 * track * beta / side;
  result.wheel_ratio = (1.0 + half) / (1.0 - half);
  return result;
}

}  // namespace orca::nav
