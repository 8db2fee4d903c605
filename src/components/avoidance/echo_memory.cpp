// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/echo_memory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orca::avoid {
namespace {

constexpr std::size_t kMostEchoes = 256;
constexpr double kNoNews = 0.04;  // [m] An echo this near to a known one moves it instead of adding another.

double distance(const Echo& one, const Echo& other) { return std::hypot(one.x - other.x, one.y - other.y); }

}  // namespace

std::optional<Echo> echo_of(double range, double min_range, double max_range, const Motion& mount) {
  if (!(range < max_range)) return std::nullopt;
  const double way = range > min_range ? range : 0.0;
  return Echo{mount.x + way * std::cos(mount.yaw), mount.y + way * std::sin(mount.yaw)};
}

Echo seen_after(const Echo& echo, const Motion& motion) {
  const double dx = echo.x - motion.x;
  const double dy = echo.y - motion.y;
  const double c = std::cos(motion.yaw);
  const double s = std::sin(motion.yaw);
  return {c * dx + s * dy, c * dy - s * dx};
}

Motion between(const Motion& from, const Motion& to) {
  const Echo place = seen_after({to.x, to.y}, from);
  return {place.x, place.y, std::remainder(to.yaw - from.yaw, 2.0 * std::numbers::pi)};
}

Motion arc(double speed, double turn_rate, double time) {
  const double yaw = turn_rate * time;
  const double way = speed * time;
  // The chord of the arc points half of the turn aside.
  const double chord = std::abs(yaw) < 1e-6 ? way : way * std::sin(0.5 * yaw) / (0.5 * yaw);
  return {chord * std::cos(0.5 * yaw), chord * std::sin(0.5 * yaw), yaw};
}

EchoMemory::EchoMemory() {
  echoes_.reserve(kMostEchoes);
  traces_.reserve(kMostEchoes);
}

void EchoMemory::advance(const Motion& motion, double time, const Limits& limits) {
  for (std::size_t i = echoes_.size(); i-- > 0;) {
    echoes_[i] = seen_after(echoes_[i], motion);
    traces_[i].age += time;
    if (traces_[i].age > (traces_[i].confirmed ? limits.confirmed_time : limits.single_time)) erase(i);
  }
}

void EchoMemory::hear(const Echo& echo, const Limits& limits) {
  std::size_t nearest = echoes_.size();
  for (std::size_t i = 0; i < echoes_.size(); ++i)
    if (nearest == echoes_.size() || distance(echo, echoes_[i]) < distance(echo, echoes_[nearest]))
      nearest = i;
  const double off = nearest < echoes_.size() ? distance(echo, echoes_[nearest]) : limits.same_place;
  const bool near = std::hypot(echo.x, echo.y) < limits.range;
  const Trace trace{0.0, near && off < limits.same_place};
  if (trace.confirmed) traces_[nearest].confirmed = true;
  if (off < kNoNews) {
    echoes_[nearest] = echo;
    traces_[nearest] = trace;
    return;
  }
  if (echoes_.size() == kMostEchoes) erase(0);
  echoes_.push_back(echo);
  traces_.push_back(trace);
}

void EchoMemory::clear() {
  echoes_.clear();
  traces_.clear();
}

void EchoMemory::erase(std::size_t i) {
  echoes_.erase(echoes_.begin() + static_cast<std::ptrdiff_t>(i));
  traces_.erase(traces_.begin() + static_cast<std::ptrdiff_t>(i));
}

}  // namespace orca::avoid
