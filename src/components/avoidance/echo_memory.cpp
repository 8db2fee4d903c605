// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/echo_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "orca/base/portable_math.hpp"

namespace orca::avoid {
namespace {

constexpr std::size_t kMostEchoes = 256;  // of a sensor
constexpr std::size_t kSensors = 4;
constexpr double kFarOff = std::numeric_limits<double>::infinity();

double squared_distance(Vec2 one, Vec2 other) { return dot(one - other, one - other); }

}  // namespace

std::optional<Vec2> echo_of(double range, double min_range, double max_range, const Pose2& X_RS) {
  if (!(range < max_range)) return std::nullopt;
  const double way = range > min_range ? range : 0.0;
  const Vec2 echo = X_RS.position() + way * direction(X_RS.yaw);
  return std::isfinite(echo.x) && std::isfinite(echo.y) ? std::optional(echo) : std::nullopt;
}

EchoMemory::EchoMemory() {
  echoes_.reserve(kSensors * kMostEchoes);
  traces_.reserve(kSensors * kMostEchoes);
}

void EchoMemory::advance(const Pose2& X_RN, double time, const Limits& limits) {
  for (std::size_t i = echoes_.size(); i-- > 0;) {
    echoes_[i] = seen_from(X_RN, echoes_[i]);
    traces_[i].age += time;
    if (traces_[i].age > kept_for(traces_[i], limits)) erase(i);
  }
}

void EchoMemory::hear(Vec2 echo, const Limits& limits) {
  std::size_t nearest = echoes_.size();
  double least = kFarOff;
  for (std::size_t i = 0; i < echoes_.size(); ++i) {
    if (traces_[i].sensor != limits.sensor) continue;
    if (const double here = squared_distance(echo, echoes_[i]); here < least) {
      nearest = i;
      least = here;
    }
  }
  const double off = std::sqrt(least);
  const bool near = portable::hypot(echo.x, echo.y) < limits.range;
  const Trace trace{0.0, near && off < limits.same_place, limits.sensor};
  if (trace.confirmed) traces_[nearest].confirmed = true;
  if (off < limits.no_news) {
    echoes_[nearest] = echo;
    traces_[nearest] = trace;
    return;
  }
  make_room(limits.sensor);
  echoes_.push_back(echo);
  traces_.push_back(trace);
}

double EchoMemory::certainty(std::size_t i, const Limits& limits) const {
  const Trace& trace = traces_[i];
  return trace.age > 0.0 ? std::max(0.0, 1.0 - trace.age / kept_for(trace, limits)) : 1.0;
}

double EchoMemory::kept_for(const Trace& trace, const Limits& limits) {
  return trace.confirmed ? limits.confirmed_time : limits.single_time;
}

void EchoMemory::clear() {
  echoes_.clear();
  traces_.clear();
}

// A sensor with as many echoes as there may be loses its oldest one.
void EchoMemory::make_room(std::uint32_t sensor) {
  const auto is_its = [sensor](const Trace& trace) { return trace.sensor == sensor; };
  if (static_cast<std::size_t>(std::ranges::count_if(traces_, is_its)) < kMostEchoes) return;
  erase(static_cast<std::size_t>(std::ranges::find_if(traces_, is_its) - traces_.begin()));
}

void EchoMemory::erase(std::size_t i) {
  echoes_.erase(echoes_.begin() + static_cast<std::ptrdiff_t>(i));
  traces_.erase(traces_.begin() + static_cast<std::ptrdiff_t>(i));
}

}  // namespace orca::avoid
