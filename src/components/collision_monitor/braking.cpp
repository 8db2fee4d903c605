// SPDX-License-Identifier: LGPL-3.0-or-later
#include "braking.hpp"

#include <algorithm>
#include <cmath>

namespace orca::gate {
namespace {

// [m/s] A command that was slowed down so far that nothing of the body moves faster is a stop.
constexpr double kCreep = 0.02;
// [m/s] A robot that was stopped drives on when so much may pass: it must not creep to the margin in a hundred steps.
constexpr double kAgain = 0.08;
constexpr double kLastMargin = 0.5;  // of the margin is left when an emergency stop has ended

double swiftness(const Twist2& twist, double reach) {
  return std::max(std::fabs(twist.forward), reach * std::fabs(twist.turn_rate));
}

}  // namespace

double braking_time(const Twist2& twist, const Brakes& brakes) {
  return std::max(0.5 * std::fabs(twist.forward) / brakes.deceleration,
                  0.5 * std::fabs(twist.turn_rate) / brakes.turn_deceleration);
}

// At a share s it goes s (reaction + s braking) far, in the time that the whole motion takes for that.
double share_to_stop(const Twist2& twist, double free, double reaction, const Brakes& brakes) {
  const double braking = braking_time(twist, brakes);
  if (reaction + braking <= free) return 1.0;
  if (braking <= 0.0) return std::clamp(free / reaction, 0.0, 1.0);
  const double root = std::sqrt(reaction * reaction + 4.0 * braking * std::max(0.0, free));
  return std::clamp(0.5 * (root - reaction) / braking, 0.0, 1.0);
}

Verdict judge(const collision::SweptBody& body, std::span<const collision::Post> posts, const Intent& intent,
              const Rules& rules) {
  const double stopping = rules.reaction + braking_time(intent.present, rules.hard);
  const collision::Approach now = body.along(intent.present * stopping, posts, kLastMargin * rules.margin);
  if (now.post && swiftness(intent.present, body.reach()) > kCreep) return {0.0, true, now.post};
  const double length = rules.reaction + braking_time(intent.wanted, rules.gentle);
  const collision::Approach next = body.along(intent.wanted * length, posts, rules.margin);
  if (!next.post) return {};
  const double share = share_to_stop(intent.wanted, next.share * length, rules.reaction, rules.gentle);
  const double least = std::min(intent.held ? kAgain : kCreep, swiftness(intent.wanted, body.reach()));
  return {share * swiftness(intent.wanted, body.reach()) < least ? 0.0 : share, false, next.post};
}

}  // namespace orca::gate
