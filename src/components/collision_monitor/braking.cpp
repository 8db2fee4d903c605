// SPDX-License-Identifier: LGPL-3.0-or-later
#include "braking.hpp"

#include <algorithm>
#include <cmath>

namespace orca::gate {
namespace {

// [m/s] A command that was slowed down so far that nothing of the body moves faster is a stop.
constexpr double kCreep = 0.02;
// [m/s] A robot that was stopped drives on when so much may pass: it must not creep to the margin in a hundred steps. It passes
// narrow places at that speed, too.
constexpr double kAgain = 0.08;
constexpr double kSwift = 0.2;  // [m/s] from which the whole margin is kept; below it a share of it,
constexpr double kLeastMargin = 1.0 / 3.0;  // at least this one
constexpr double kLastMargin = 0.5;         // of the margin is left when an emergency stop has ended

double swiftness(const Twist2& twist, double reach) {
  return std::max(speed_of(twist), reach * std::fabs(twist.turn_rate));
}

double margin_at(double speed, const Rules& rules) {
  return rules.margin * std::clamp(speed / kSwift, kLeastMargin, 1.0);
}

struct Pass {
  double share = 1.0;
  std::optional<std::size_t> post;
};

// Returns how much of a motion may pass, with the margin of its own speed.
Pass pass(const collision::SweptBody& body, std::span<const collision::Post> posts, const Twist2& motion,
          const Rules& rules) {
  const double length = rules.reaction + braking_time(motion, rules.gentle);
  const collision::Approach ahead =
      body.along(motion * length, posts, margin_at(swiftness(motion, body.reach()), rules));
  if (!ahead.post) return {};
  return {share_to_stop(motion, ahead.share * length, rules.reaction, rules.gentle), ahead.post};
}

}  // namespace

double braking_time(const Twist2& twist, const Brakes& brakes) {
  return std::max(0.5 * speed_of(twist) / brakes.deceleration,
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

bool creeps(const Twist2& twist, double reach) {
  constexpr double kTouches = 0.06;  // [m/s]
  return speed_of(twist) <= kTouches && reach * std::fabs(twist.turn_rate) <= 2.0 * kTouches;
}

Verdict judge(const collision::SweptBody& body, std::span<const collision::Post> posts, const Intent& intent,
              const Rules& rules) {
  const double stopping = rules.reaction + braking_time(intent.present, rules.hard);
  const double moving = swiftness(intent.present, body.reach());
  const collision::Approach now =
      body.along(intent.present * stopping, posts, kLastMargin * margin_at(moving, rules));
  if (now.post && moving > kCreep) return {0.0, true, now.post};
  const Pass next = pass(body, posts, intent.wanted, rules);
  if (!next.post) return {};
  const double wish = swiftness(intent.wanted, body.reach());
  const double least = std::min(intent.held ? kAgain : kCreep, wish);
  if (next.share * wish >= kAgain) return {next.share, false, next.post};
  const double slow = std::min(1.0, kAgain / wish);
  const bool squeezes = slow < 1.0 && !pass(body, posts, slow * intent.wanted, rules).post;
  if (squeezes) return {slow, false, next.post};
  return {next.share * wish < least ? 0.0 : next.share, false, next.post};
}

}  // namespace orca::gate
