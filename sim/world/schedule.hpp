// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/sim/event.hpp"
#include "orca/sim/world.hpp"

namespace orca::sim::detail {

// Returns whether a robot has the sensors, or the one sensor, that are to fail.
[[nodiscard]] bool has(const RobotModel& model, const Outage& outage);

// The events of a running world.
class Schedule {
 public:
  // @param seed  of what is drawn.
  Schedule(const Events& events, std::uint64_t seed);

  // Does what is due, in the order of its times, and notes it in words.
  void run(World& world, std::vector<std::string>& notes);

  // Returns whether the device, of that kind of sensors, is silent at a time of the world's clock.
  [[nodiscard]] bool is_out(std::string_view robot, SensorKind sensor, std::string_view device,
                            TimePoint now) const;

  // Silences sensors from now on, or ends what silences them now; their times are not read.
  // @errors  failed_precondition: it is so already, or cannot be for this device alone.
  [[nodiscard]] Status silence(Outage which, TimePoint now);
  [[nodiscard]] Status restore(const Outage& which, TimePoint now);
  // Returns what is silent of a robot: "laser", or "laser rear" for one device of several.
  [[nodiscard]] std::vector<std::string> silent(std::string_view robot, TimePoint now) const;

 private:
  struct Step {
    Duration at;
    std::string text;
    std::function<Status(World&)> act;
    bool waits = false;
  };

  void add(const Visitor& visitor);
  void add(const Move& move);
  void add(const Kidnap& kidnap, RandomStream random);
  void add(const Outage& outage);
  void add(const Drain& drain);
  [[nodiscard]] Status with(const std::string& visitor, const std::function<Status(ObstacleId)>& act) const;
  // Returns whether it is over and done with.
  static bool take(Step& step, World& world, std::vector<std::string>& notes);

  std::vector<Step> steps_;  // Those that are not done, by time.
  std::vector<Outage> outages_;
  std::map<std::string, ObstacleId> there_;  // The visitors that have come.
};

}  // namespace orca::sim::detail
