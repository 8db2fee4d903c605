// SPDX-License-Identifier: LGPL-3.0-or-later
#include "crossing.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <vector>

#include "orca/geometry/arc.hpp"

namespace orca::gate {
namespace {

constexpr double kAhead = 3.0;      // [s] that it looks ahead
constexpr double kStep = 0.1;       // [s]
constexpr double kRoom = 0.1;       // [m] to keep from people, besides the margin
constexpr double kDoubt = 0.5;      // standard deviations of where they will be that count
constexpr double kMostDoubt = 0.3;  // [m]
constexpr double kJustSeen = 0.15;  // [s]
constexpr double kNoNearer = 1e-3;  // [m]
constexpr double kCare = 1.5;       // [s] A touch that is farther ahead may be avoided in other ways.
constexpr double kBuys = 0.5;       // [s] that a motion must win to be better than standing
constexpr double kPeriod = 0.2;     // [s] until the next decision is in force
constexpr std::array kShares{1.0, 0.75, 0.5, 0.25};
constexpr double kNever = std::numeric_limits<double>::infinity();

double towards(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

// The motion of the body when it obeys a command, and people who go on.
class Foresight {
 public:
  Foresight(const collision::SweptBody& body, std::span<const Passer> people, const Rules& rules)
      : body_(body), rules_(rules) {
    for (std::size_t i = 0; i < people.size(); ++i)
      if (norm(people[i].velocity) >= Passer::kStands || people[i].unseen >= kJustSeen)
        people_.push_back({people[i], i, body.plan_distance(people[i].place)});
  }

  struct Touch {
    double time = kNever;  // [s]
    std::optional<std::size_t> who{};
  };

  // Returns the first touch when the body goes on for the reaction time, takes up `wanted`, and stops after `drives` [s] of that.
  [[nodiscard]] Touch touch(const Twist2& present, const Twist2& wanted, double drives) const {
    Pose2 pose;
    Twist2 twist = present;
    for (double time = 0.0; time < kAhead; time += kStep) {
      if (const auto who = touched(pose, time)) return {time, who};
      const bool stops = time >= rules_.reaction + drives;
      const Brakes& brakes = stops ? rules_.hard : rules_.gentle;
      const Twist2 aim = stops ? Twist2{} : wanted;
      if (time >= rules_.reaction) {
        const Vec2 change{aim.forward - twist.forward, aim.left - twist.left};
        const double share = std::min(1.0, brakes.deceleration * kStep / std::max(norm(change), 1e-9));
        twist.forward += share * change.x;
        twist.left += share * change.y;
        twist.turn_rate = towards(twist.turn_rate, aim.turn_rate, brakes.turn_deceleration * kStep);
      }
      pose = pose * moved(twist, kStep);
    }
    return {};
  }

 private:
  // Somebody who counts.
  struct Somebody {
    Passer passer;
    std::size_t index;  // among all
    double distance;    // [m] from the body now
  };

  [[nodiscard]] std::optional<std::size_t> touched(const Pose2& pose, double time) const {
    for (const auto& [passer, index, distance] : people_) {
      const Vec2 there = passer.place + time * passer.velocity;
      const double room = passer.radius + rules_.margin + kRoom + doubt(passer, time);
      if (body_.plan_distance(seen_from(pose, there)) < std::min(room, distance - kNoNearer)) return index;
    }
    return std::nullopt;
  }

  // Returns how far [m] somebody may be off.
  [[nodiscard]] static double doubt(const Passer& passer, double time) {
    return std::min(kMostDoubt, kDoubt * (passer.place_error + time * passer.velocity_error));
  }

  const collision::SweptBody& body_;
  std::vector<Somebody> people_;
  const Rules& rules_;
};

}  // namespace

void add_passers(const idl::MovingThings& moving, double age, const Pose2& X_OR,
                 std::vector<Passer>& people) {
  for (const idl::MovingThing& thing : moving.things()) {
    const Vec2 velocity{thing.velocity_x(), thing.velocity_y()};
    const Vec2 place = Vec2{thing.x(), thing.y()} + age * velocity;
    people.push_back({seen_from(X_OR, place), rotated(velocity, -X_OR.yaw), thing.radius(),
                      thing.place_error(), thing.velocity_error(), thing.unseen()});
  }
}

std::string text_of(const Passer& passer) {
  char text[100];
  std::snprintf(text, sizeof text, "somebody passes %.1f m away at %.1f m/s", norm(passer.place),
                norm(passer.velocity));
  return text;
}

Crossing cross(const collision::SweptBody& body, std::span<const Passer> people, const Intent& intent,
               const Rules& rules) {
  if (people.empty()) return {};
  const Foresight foresight(body, people, rules);
  const double halt = rules.reaction + 2.0 * braking_time(intent.present, rules.hard) + kPeriod;
  std::array<Foresight::Touch, kShares.size()> touches;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    const Twist2 wanted = kShares[i] * intent.wanted;
    touches[i] = foresight.touch(intent.present, wanted, kNever);
    if (!touches[i].who) return {kShares[i], false, {}};
    const Foresight::Touch stops = foresight.touch(intent.present, wanted, kPeriod);
    if (!stops.who) return {kShares[i], false, {}};
    if (stops.time > touches[i].time) touches[i] = stops;
  }
  for (std::size_t i = 0; i < kShares.size(); ++i)
    if (touches[i].time > kCare) return {kShares[i], false, touches[i].who};
  const auto latest = std::ranges::max_element(touches, {}, &Foresight::Touch::time);
  const double standing = foresight.touch(intent.present, {}, 0.0).time;
  if (latest->time > halt && latest->time > standing + kBuys)
    return {kShares[static_cast<std::size_t>(latest - touches.begin())], false, latest->who};
  return {0.0, touches.front().time <= halt, touches.front().who};
}

}  // namespace orca::gate
