// SPDX-License-Identifier: LGPL-3.0-or-later
#include "surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::gate {
namespace {

constexpr double kBehind = 0.02;     // [m] A place that much behind a reading is hidden by it.
constexpr double kPast = 0.1;        // [m] A laser that sees that far behind a place sees past it.
constexpr double kSamePlace = 0.15;  // [m] Echoes of sonars nearer to each other are of one thing.
constexpr double kAround = 0.15;     // [m] around people
constexpr double kSameThing = 0.35;  // [m] An echo of a sonar so near to one of a laser is that.
constexpr double kAside = 0.3;       // [m] by which the middle of a sonar's echo may be beside the thing
constexpr double kSpacing = 0.04;    // [m] of the posts on the arc of a sonar's cone
constexpr std::size_t kMost = 2000;  // echoes of a laser, or two scans if they are more

// The sight that a scan has of a place.
enum class Sight {
  beside,  // It does not look there, or has read nothing there.
  hidden,  // Something else is in front of it.
  clear    // Its beams reach it.
};

struct Look {
  Sight sight = Sight::beside;
  double away = 0.0;   // [m] of the place from the sensor
  double least = 0.0;  // [m] reading of the beams beside it
};

Look look(const Sweep& sweep, Vec2 place) {
  const Vec2 seen = seen_from(sweep.X_OS, place);
  Look look{.away = norm(seen)};
  if (sweep.ranges.empty() || look.away >= sweep.max_range) return look;
  const auto last = static_cast<double>(sweep.ranges.size() - 1);
  const double width = sweep.angle_increment * last;
  const double middle = sweep.angle_start + 0.5 * width;
  const double off = wrapped(portable::atan2(seen.y, seen.x) - middle) + 0.5 * width;
  const double beam = sweep.angle_increment == 0.0 ? 0.0 : off / sweep.angle_increment;
  if (beam < -0.5 || beam > last + 0.5) return look;
  const auto nearest = static_cast<long>(std::clamp(std::round(beam), 0.0, last));
  if (std::isnan(sweep.ranges[static_cast<std::size_t>(nearest)])) return look;
  look.least = std::numeric_limits<double>::infinity();
  for (long i = std::max(0L, nearest - 1); i <= std::min(static_cast<long>(last), nearest + 1); ++i)
    look.least = std::fmin(look.least, sweep.ranges[static_cast<std::size_t>(i)]);
  look.sight = look.least + kBehind < look.away ? Sight::hidden : Sight::clear;
  return look;
}

// Returns whether a laser sees what is behind a place.
bool sees_past(const Sweep& sweep, Vec2 place) {
  const Look seen = look(sweep, place);
  return seen.sight == Sight::clear && seen.least > seen.away + kPast;
}

}  // namespace

void Surroundings::age(double time, bool drives) {
  for (Source& source : sources_) {
    if (source.is_laser && !drives) continue;
    const double most = source.is_laser ? kKept : kHeard;
    for (Echo& echo : source.echoes) echo.age += time;
    std::erase_if(source.echoes, [&](const Echo& echo) { return echo.age > most; });
  }
}

Surroundings::Source& Surroundings::source(const std::string& name, bool is_laser) {
  const auto known = std::ranges::find(sources_, name, &Source::name);
  if (known != sources_.end()) return *known;
  return sources_.emplace_back(Source{name, is_laser, {}, {}});
}

void Surroundings::see(const std::string& name, Sweep sweep) {
  Source& laser = source(name, true);
  std::erase_if(laser.echoes,
                [&](const Echo& echo) { return look(sweep, echo.place).sight == Sight::clear; });
  const double farthest = std::min(sweep.max_range, kRange);
  const Vec2 ahead = direction(sweep.X_OS.yaw);
  for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
    if (!(sweep.ranges[i] < farthest)) continue;
    const double angle = sweep.angle_start + sweep.angle_increment * static_cast<double>(i);
    laser.echoes.push_back({sweep.X_OS.position() + rotated(sweep.ranges[i] * direction(angle), ahead)});
  }
  const std::size_t most = std::max(kMost, 2 * sweep.ranges.size());
  if (laser.echoes.size() > most)
    laser.echoes.erase(laser.echoes.begin(), laser.echoes.end() - static_cast<std::ptrdiff_t>(most));
  laser.sweep = std::move(sweep);
}

void Surroundings::hear(const std::string& name, const Cone& cone) {
  Source& ring = source(name, false);
  const Vec2 middle = cone.X_OS * Vec2{cone.range, 0.0};
  const auto is_same = [&](const Echo& echo) {
    return !echo.is_carried && norm(echo.place - middle) < kSamePlace;
  };
  const bool is_sure = std::ranges::any_of(ring.echoes, is_same);
  std::erase_if(ring.echoes, [&](const Echo& echo) {
    return echo.sonar == cone.sonar && (!echo.is_sure || echo.is_carried || is_same(echo));
  });
  if (!(cone.range < cone.farthest) || cone.range > kRange) return;
  if (cone.range <= 0.0) return ring.echoes.push_back({cone.place, 0.0, cone.sonar, false, true});
  const auto steps = static_cast<int>(std::ceil(2.0 * cone.half_angle * cone.range / kSpacing));
  for (int i = 0; i <= steps; ++i) {
    const double angle = steps == 0 ? 0.0 : cone.half_angle * (2.0 * i / steps - 1.0);
    const bool stays = is_sure && i == steps / 2;
    ring.echoes.push_back({cone.X_OS * (cone.range * direction(angle)), 0.0, cone.sonar, stays, false});
  }
}

void Surroundings::forget(std::span<const Passer> people, const Pose2& X_OR) {
  for (const Passer& passer : people) {
    if (passer.unseen > 0.0 || norm(passer.velocity) < Passer::kStands) continue;
    const Vec2 place = X_OR * passer.place;
    const double room = passer.radius + kAround;
    for (Source& source : sources_)
      std::erase_if(source.echoes, [&](const Echo& echo) {
        return !echo.is_carried && norm(echo.place - place) < room + (source.is_laser ? 0.0 : kAside);
      });
  }
}

// Lasers explain what they show, and what would be there where they look at all of the cone.
void Surroundings::hear_flank(const std::string& ring, const Firing& firing, double half_lobe) {
  const auto end = [&](double angle) { return firing.X_OS * (firing.range * direction(angle)); };
  flanks_.hear(
      ring, firing,
      is_seen(end(0.0), kSameThing) || (is_looked_at(end(half_lobe)) && is_looked_at(end(-half_lobe))));
}

bool Surroundings::is_looked_at(Vec2 place) const {
  return std::ranges::any_of(sources_, [&](const Source& source) {
    return source.is_laser && look(source.sweep, place).sight != Sight::beside;
  });
}

bool Surroundings::is_seen(Vec2 place, double room) const {
  return std::ranges::any_of(sources_, [&](const Source& source) {
    return source.is_laser && std::ranges::any_of(source.echoes, [&](const Echo& echo) {
             return norm(echo.place - place) < room;
           });
  });
}

collision::Post Surroundings::post_of(const Source& source, Vec2 place) const {
  collision::Post post{place};
  if (!source.is_laser) return post;
  for (const Source& other : sources_) {
    if (!other.is_laser || other.sweep.height == source.sweep.height || !sees_past(other.sweep, place))
      continue;
    if (other.sweep.height > source.sweep.height) post.top = std::min(post.top, other.sweep.height);
    if (other.sweep.height < source.sweep.height) post.bottom = std::max(post.bottom, other.sweep.height);
  }
  return post;
}

std::span<const collision::Post> Surroundings::posts(const Pose2& X_OR, const std::optional<Disc>& spared) {
  posts_.clear();
  owners_.clear();
  const Vec2 back = direction(-X_OR.yaw);  // once for the hundreds of echoes
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    for (const Echo& echo : sources_[i].echoes) {
      collision::Post post = post_of(sources_[i], echo.place);
      if (!echo.is_carried) post.place = rotated(post.place - X_OR.position(), back);
      if (norm(post.place) > kRange) continue;
      if (spared && norm(post.place - spared->middle) <= spared->radius) continue;
      posts_.push_back(post);
      owners_.push_back(i);
    }
  }
  return posts_;
}

const std::string& Surroundings::source_of(std::size_t post) const { return sources_[owners_[post]].name; }

std::string text_of(const collision::Post& post, const collision::SweptBody& body,
                    const std::string& source) {
  char text[160];
  std::snprintf(text, sizeof text, " sees something %.2f m from the body, %.2f m %s and %.2f m to the %s",
                std::max(0.0, body.distance(post)), std::fabs(post.place.x),
                post.place.x >= 0.0 ? "ahead" : "behind", std::fabs(post.place.y),
                post.place.y >= 0.0 ? "left" : "right");
  return source + text;
}

}  // namespace orca::gate
