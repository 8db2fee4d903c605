// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "orca/base/portable_math.hpp"

namespace orca::fuse {
namespace {

// Unit vectors whose weighted sum is shorter than this share of the weights cancel out: the remainder is
// rounding, not a direction.
constexpr double kCancelled = 1e-9;

struct Sums {
  double weight = 0.0;
  double speed = 0.0;
  double rate = 0.0;
  double forward = 0.0;
  double left = 0.0;
};

double as_direction(const Wish& wish, double steer_gain) {
  if (wish.kind == Wish::Kind::direction) return wish.value;
  return std::clamp(wish.value / steer_gain, -std::numbers::pi, std::numbers::pi);
}

Sums sums_of(std::span<const Wish> wishes, double steer_gain) {
  Sums sums;
  for (const Wish& wish : wishes) {
    const double direction = as_direction(wish, steer_gain);
    sums.weight += wish.weight;
    sums.speed += wish.weight * wish.speed;
    sums.rate += wish.weight * as_rate(wish, steer_gain);
    const auto [cosine, sine] = portable::cos_sin(direction);
    sums.forward += wish.weight * cosine;
    sums.left += wish.weight * sine;
  }
  return sums;
}

std::vector<double> shares_of(std::span<const Wish> wishes, double weight) {
  std::vector<double> shares;
  for (const Wish& wish : wishes) shares.push_back(wish.weight / weight);
  return shares;
}

// Returns a wish in the direction of the sum, at this speed; standing if the vectors cancel out.
Wish along(const Sums& sums, double speed) {
  if (portable::hypot(sums.forward, sums.left) < kCancelled * sums.weight)
    return {Wish::Kind::direction, 0.0, 0.0, sums.weight};
  return {Wish::Kind::direction, portable::atan2(sums.left, sums.forward), speed, sums.weight};
}

}  // namespace

double as_rate(const Wish& wish, double steer_gain) {
  return wish.kind == Wish::Kind::direction ? steer_gain * wish.value : wish.value;
}

Fused fuse_weighted(std::span<const Wish> wishes, double steer_gain) {
  const auto turns = [](const Wish& wish) { return wish.kind == Wish::Kind::turn_rate; };
  const Sums sums = sums_of(wishes, steer_gain);
  const double speed = sums.speed / sums.weight;
  const bool by_rate = std::any_of(wishes.begin(), wishes.end(), turns);
  return {
      by_rate ? Wish{Wish::Kind::turn_rate, sums.rate / sums.weight, speed, sums.weight} : along(sums, speed),
      shares_of(wishes, sums.weight)};
}

Fused sum_vectors(std::span<const Wish> wishes, double steer_gain) {
  const Sums sums = sums_of(wishes, steer_gain);
  const double agreement = std::min(1.0, portable::hypot(sums.forward, sums.left) / sums.weight);
  return {along(sums, agreement * sums.speed / sums.weight), shares_of(wishes, sums.weight), agreement};
}

namespace {

constexpr int kSide = 20;  // candidates on either side of straight on
constexpr int kRates = 2 * kSide + 1;
constexpr int kSpeeds = 21;
constexpr double kEqual = 1e-9;  // share of all votes; less than this is rounding

double bell(double off, double spread) { return portable::exp(-0.5 * (off / spread) * (off / spread)); }

double rate_of(const Wish& wish, const Ballot& ballot) {
  return std::clamp(as_rate(wish, ballot.steer_gain), -ballot.max_turn_rate, ballot.max_turn_rate);
}

double candidate(int i, const Ballot& ballot) { return ballot.max_turn_rate * (i - kSide) / kSide; }

using Votes = std::array<double, kRates>;

Votes count(std::span<const Wish> wishes, const Ballot& ballot, double all) {
  Votes votes{};
  for (const Wish& wish : wishes)
    for (int i = 0; i < kRates; ++i)
      votes[static_cast<std::size_t>(i)] +=
          wish.weight / all * bell(candidate(i, ballot) - rate_of(wish, ballot), ballot.rate_spread);
  return votes;
}

double at(const Votes& votes, int i) {
  return i < 0 || i >= kRates ? 0.0 : votes[static_cast<std::size_t>(i)];
}

// Returns the highest peak.
int winner(const Votes& votes, const Ballot& ballot, double last_rate) {
  int best = -1;
  double most = 0.0;
  for (int i = kRates - 1; i >= 0; --i) {  // from the left
    if (at(votes, i) < at(votes, i - 1) || at(votes, i) < at(votes, i + 1)) continue;
    const double kept = ballot.inertia * bell(candidate(i, ballot) - last_rate, ballot.rate_spread);
    if (best >= 0 && at(votes, i) + kept <= most + kEqual) continue;
    best = i;
    most = at(votes, i) + kept;
  }
  return best;
}

// Returns where the peak lies between the candidates: exact for a single bell.
double peak(const Votes& votes, int best, const Ballot& ballot) {
  if (best == 0 || best == kRates - 1) return candidate(best, ballot);
  const double before = portable::log(at(votes, best - 1));
  const double after = portable::log(at(votes, best + 1));
  const double curvature = before - 2.0 * portable::log(at(votes, best)) + after;
  if (!(curvature < 0.0)) return candidate(best, ballot);
  const double aside = std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
  return candidate(best, ballot) + aside * ballot.max_turn_rate / kSide;
}

// Returns the speed with most votes; if there are several, the slowest.
double speed_of(std::span<const Wish> wishes, const std::vector<double>& shares, const Ballot& ballot) {
  const auto slower = [](const Wish& a, const Wish& b) { return a.speed < b.speed; };
  const auto [slowest, fastest] = std::minmax_element(wishes.begin(), wishes.end(), slower);
  double best = slowest->speed;
  double most = -1.0;
  for (int i = 0; i < kSpeeds; ++i) {
    const double speed = std::lerp(slowest->speed, fastest->speed, static_cast<double>(i) / (kSpeeds - 1));
    double votes = 0.0;
    for (std::size_t j = 0; j < wishes.size(); ++j)
      votes += shares[j] * bell(speed - wishes[j].speed, ballot.speed_spread);
    if (votes <= most + kEqual) continue;
    most = votes;
    best = speed;
  }
  return best;
}

}  // namespace

Fused vote(std::span<const Wish> wishes, const Ballot& ballot, double last_rate) {
  const auto heavier = [](double sum, const Wish& wish) { return sum + wish.weight; };
  const double all = std::accumulate(wishes.begin(), wishes.end(), 0.0, heavier);
  const Votes votes = count(wishes, ballot, all);
  const double rate = peak(votes, winner(votes, ballot, last_rate), ballot);
  std::vector<double> shares;
  for (const Wish& wish : wishes)
    shares.push_back(wish.weight / all * bell(rate - rate_of(wish, ballot), ballot.rate_spread));
  const double given = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= given;
  return {{Wish::Kind::turn_rate, rate, speed_of(wishes, shares, ballot), all}, std::move(shares)};
}

}  // namespace orca::fuse
