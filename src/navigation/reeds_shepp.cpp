// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/reeds_shepp.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/arc.hpp"

namespace orca::nav {
namespace {

constexpr double kQuarter = std::numbers::pi / 2.0;
constexpr double kRounding = 1e-9;

/// The pose to reach, in turning radii, as the formulas see it: the start is the origin.
struct SteeredTarget {
  double x, y, yaw;
  double sine, cosine;  // of yaw

  SteeredTarget(double x_, double y_, double yaw_)
      : x(x_), y(y_), yaw(yaw_), sine(portable::sin(yaw_)), cosine(portable::cos(yaw_)) {}
  // As seen by a robot that drives the way from its end to its start.
  [[nodiscard]] SteeredTarget backwards() const {
    return {x * cosine + y * sine, x * sine - y * cosine, yaw};
  }
};

/// A vector by its length and its angle.
struct Polar {
  double length, angle;
  Polar(double x, double y) : length(portable::hypot(x, y)), angle(portable::atan2(y, x)) {}
};

/// A way: letters L, S and R, and the angle or length of each in turning radii, negative backwards.
struct TurnWord {
  std::string_view turns;
  std::array<double, 5> lengths{};

  [[nodiscard]] double length() const {
    double sum = 0.0;
    for (const double part : lengths) sum += std::fabs(part);
    return sum;
  }
};
using MaybeWord = std::optional<TurnWord>;

bool positive(double length) { return length >= -kRounding; }
bool negative(double length) { return length <= kRounding; }

// Formula 8.1: L+ S+ L+.
MaybeWord left_straight_left(const SteeredTarget& to) {
  const Polar p(to.x - to.sine, to.y - 1.0 + to.cosine);
  const double last = wrapped(to.yaw - p.angle);
  if (!positive(p.angle) || !positive(last)) return std::nullopt;
  return TurnWord{"LSL", {p.angle, p.length, last}};
}

// Formula 8.2: L+ S+ R+.
MaybeWord left_straight_right(const SteeredTarget& to) {
  const Polar p(to.x + to.sine, to.y - 1.0 - to.cosine);
  if (p.length < 2.0) return std::nullopt;
  const double straight = std::sqrt(p.length * p.length - 4.0);
  const double first = wrapped(p.angle + portable::atan2(2.0, straight));
  const double last = wrapped(first - to.yaw);
  if (!positive(first) || !positive(last)) return std::nullopt;
  return TurnWord{"LSR", {first, straight, last}};
}

// Formulas 8.3 and 8.4: L+ R- L.
MaybeWord left_right_left(const SteeredTarget& to) {
  const Polar p(to.x - to.sine, to.y - 1.0 + to.cosine);
  if (p.length > 4.0) return std::nullopt;
  const double middle = -2.0 * portable::asin(0.25 * p.length);
  const double first = wrapped(p.angle + 0.5 * middle + std::numbers::pi);
  if (!positive(first)) return std::nullopt;
  return TurnWord{"LRL", {first, middle, wrapped(to.yaw - first + middle)}};
}

// The outer arcs of the ways with four arcs, given the inner ones.
struct Outer {
  double first, last;
};
Outer outer_arcs(double u, double v, double x, double y, double yaw) {
  const double delta = wrapped(u - v);
  const double a = portable::sin(u) - portable::sin(delta);
  const double b = portable::cos(u) - portable::cos(delta) - 1.0;
  const double angle = portable::atan2(y * a - x * b, x * a + y * b);
  const double side = 2.0 * (portable::cos(delta) - portable::cos(v) - portable::cos(u)) + 3.0;
  const double first = side < 0.0 ? wrapped(angle + std::numbers::pi) : angle;
  return {first, wrapped(first - u + v - yaw)};
}

// Formula 8.7: L+ R+ L- R-, the inner arcs alike.
MaybeWord four_arcs(const SteeredTarget& to) {
  const double x = to.x + to.sine;
  const double y = to.y - 1.0 - to.cosine;
  const double rho = 0.25 * (2.0 + portable::hypot(x, y));
  if (rho > 1.0) return std::nullopt;
  const double u = portable::acos(rho);
  const Outer outer = outer_arcs(u, -u, x, y, to.yaw);
  if (!positive(outer.first) || !negative(outer.last)) return std::nullopt;
  return TurnWord{"LRLR", {outer.first, u, -u, outer.last}};
}

// Formula 8.8: L+ R- L- R+, the inner arcs alike.
MaybeWord four_arcs_between_cusps(const SteeredTarget& to) {
  const double x = to.x + to.sine;
  const double y = to.y - 1.0 - to.cosine;
  const double rho = (20.0 - x * x - y * y) / 16.0;
  if (rho < 0.0 || rho > 1.0) return std::nullopt;
  const double u = -portable::acos(rho);
  const Outer outer = outer_arcs(u, u, x, y, to.yaw);
  if (!positive(outer.first) || !positive(outer.last)) return std::nullopt;
  return TurnWord{"LRLR", {outer.first, u, u, outer.last}};
}

// Formula 8.9: L+ R-(quarter) S- L-.
MaybeWord quarter_then_left(const SteeredTarget& to) {
  const Polar p(to.x - to.sine, to.y - 1.0 + to.cosine);
  if (p.length < 2.0) return std::nullopt;
  const double root = std::sqrt(p.length * p.length - 4.0);
  const double first = wrapped(p.angle + portable::atan2(root, -2.0));
  const double last = wrapped(to.yaw - kQuarter - first);
  if (!positive(first) || !negative(2.0 - root) || !negative(last)) return std::nullopt;
  return TurnWord{"LRSL", {first, -kQuarter, 2.0 - root, last}};
}

// Formula 8.10: L+ R-(quarter) S- R-.
MaybeWord quarter_then_right(const SteeredTarget& to) {
  const Polar p(-(to.y - 1.0 - to.cosine), to.x + to.sine);
  if (p.length < 2.0) return std::nullopt;
  const double last = wrapped(p.angle + kQuarter - to.yaw);
  if (!positive(p.angle) || !negative(last)) return std::nullopt;
  return TurnWord{"LRSR", {p.angle, -kQuarter, 2.0 - p.length, last}};
}

// Formula 8.11: L+ R-(quarter) S- L-(quarter) R+.
MaybeWord two_quarters(const SteeredTarget& to) {
  const double x = to.x + to.sine;
  const double y = to.y - 1.0 - to.cosine;
  const double rho = portable::hypot(x, y);
  if (rho < 2.0) return std::nullopt;
  const double straight = 4.0 - std::sqrt(rho * rho - 4.0);
  if (!negative(straight)) return std::nullopt;
  const double first =
      wrapped(portable::atan2((4.0 - straight) * x - 2.0 * y, -2.0 * x + (straight - 4.0) * y));
  const double last = wrapped(first - to.yaw);
  if (!positive(first) || !positive(last)) return std::nullopt;
  return TurnWord{"LRSLR", {first, -kQuarter, straight, -kQuarter, last}};
}

using Formula = MaybeWord (*)(const SteeredTarget&);
constexpr std::array<Formula, 8> kFormulas{
    left_straight_left,      left_straight_right, left_right_left,    four_arcs,
    four_arcs_between_cusps, quarter_then_left,   quarter_then_right, two_quarters};
// Those whose reverse is another way.
constexpr std::array<Formula, 3> kOneWay{left_right_left, quarter_then_left, quarter_then_right};

// Returns a way driven from its end to its start, with both its directions of driving exchanged.
TurnWord reversed(const TurnWord& word) {
  TurnWord result{word.turns == "LRSL" ? "LSRL" : word.turns == "LRSR" ? "RSRL" : "LRL"};
  for (std::size_t i = 0; i < word.turns.size(); ++i)
    result.lengths[i] = word.lengths[word.turns.size() - 1 - i];
  return result;
}

std::vector<WayPiece> pieces_of(const TurnWord& word, double flip, double mirror, double radius) {
  std::vector<WayPiece> pieces;
  for (std::size_t i = 0; i < word.turns.size(); ++i) {
    if (std::fabs(word.lengths[i]) < kRounding) continue;
    const double left = word.turns[i] == 'L' ? 1.0 : word.turns[i] == 'R' ? -1.0 : 0.0;
    pieces.push_back({flip * word.lengths[i] * radius, mirror * left / radius});
  }
  return pieces;
}

}  // namespace

Pose2 driven(const Pose2& from, const WayPiece& piece, double length) {
  return along_arc(from, {length, 0.0, length * piece.curvature});
}

double length_of(std::span<const WayPiece> way) {
  double sum = 0.0;
  for (const WayPiece& piece : way) sum += std::fabs(piece.length);
  return sum;
}

std::vector<WayPiece> shortest_way(const Pose2& from, const Pose2& to, double radius) {
  const Pose2 goal = seen_from(from, to);
  MaybeWord best;
  double least = 0.0, best_flip = 1.0, best_mirror = 1.0;
  for (const double flip : {1.0, -1.0})
    for (const double mirror : {1.0, -1.0}) {
      const auto take = [&](const MaybeWord& found) {
        if (!found || (best && found->length() >= least)) return;
        best = found;
        least = found->length();
        best_flip = flip;
        best_mirror = mirror;
      };
      const SteeredTarget target(flip * goal.x / radius, mirror * goal.y / radius,
                                 wrapped(flip * mirror * goal.yaw));
      for (const Formula formula : kFormulas) take(formula(target));
      const SteeredTarget back = target.backwards();
      for (const Formula formula : kOneWay)
        if (const MaybeWord found = formula(back)) take(reversed(*found));
    }
  return best ? pieces_of(*best, best_flip, best_mirror, radius) : std::vector<WayPiece>{};
}

}  // namespace orca::nav
