// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/ros/range_ring.hpp"

#include <utility>

#include "convert.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace orca::ros {
namespace {

constexpr Duration kSilent = 2s;
constexpr std::size_t kMostSensors = 256;

template <class Ring>
ObjectRef joined(const std::map<std::string, ObjectRef>& latest, const ObjectPtr<Ring>& newest) {
  Loan<Ring> ring = make_object<Ring>(*newest);
  ring->ranges().clear();
  ring->poses().clear();
  ring->stamps().clear();
  for (const auto& [frame, object] : latest) {
    const auto one = object_cast<Ring>(object);
    if (!one) continue;
    ring->ranges().push_back(one->ranges().front());
    ring->poses().push_back(one->poses().front());
    ring->stamps().push_back(one->stamps().front());
  }
  return std::move(ring).seal().ref();
}

}  // namespace

ObjectRef RangeRing::take(const ObjectRef& reading) {
  const auto sonar = object_cast<idl::SonarRangeReadings>(reading);
  const auto infrared = object_cast<idl::InfraredRangeReadings>(reading);
  if (!sonar && !infrared) return reading;
  std::erase_if(latest_, [&](const auto& entry) { return entry.second.stamp() + kSilent < reading.stamp(); });
  const std::string& frame = reading.header().origin();
  if (latest_.contains(frame) || (frame.size() <= kLongestFrame && latest_.size() < kMostSensors))
    latest_[frame] = reading;
  return sonar ? joined(latest_, sonar) : joined(latest_, infrared);
}

}  // namespace orca::ros
