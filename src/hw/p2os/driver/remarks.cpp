// SPDX-License-Identifier: LGPL-3.0-or-later
#include "remarks.hpp"

#include <cstdio>
#include <utility>

namespace orca::hw::p2os {
namespace {

constexpr double kEnoughAgain = 0.5;  // [V] above the limit
constexpr double kHighestLow =
    15.0;  // [V] a limit above it is not of a battery of 12 V, to which packets are scaled
constexpr Duration kSonarStart =
    1500ms;  // from the command until the first echoes; a ring takes 0.4 s at most

std::string number(double value) {
  char text[16];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

}  // namespace

std::vector<std::string> Remarks::take(const Config& config, const DriveLimits& limits) {
  const double low = config.low_battery_voltage;
  low_battery_ = low > 0.0 && low < kHighestLow ? low : kUsualLow;
  std::vector<std::string> all;
  if (config.watchdog == Duration{0})
    all.emplace_back(
        "its controller tells of no watchdog: if the line breaks while it drives, it may drive on");
  const auto compare = [&](double here, double there, const std::string& does, const std::string& unit) {
    if (there > 0.0 && here > there)
      all.push_back("its controller " + does + " at most " + number(there) + " " + unit +
                    ", and this graph says " + number(here) + " " + unit);
  };
  compare(limits.max_speed, config.top_speed, "drives", "m/s");
  compare(limits.max_turn_rate, config.top_turn_rate, "turns", "rad/s");
  return all;
}

void Remarks::start(TimePoint now) {
  heard_ = now;
  are_off_ = false;
}

std::vector<std::string> Remarks::take(const Sip& sip, TimePoint now) {
  std::vector<std::string> all;
  if (has_become_low(sip.battery_voltage))
    all.push_back("its battery is low, at " + number(sip.battery_voltage) + " V; charge it below " +
                  number(low_battery_) + " V");
  if (has_sonars_ && have_fallen_silent(sip, now))
    all.emplace_back(
        "its sonars are off, although they were switched on, so nothing is heard around it; are they "
        "switched off at the robot?");
  return all;
}

bool Remarks::has_become_low(double voltage) {
  const double limit = is_low_ ? low_battery_ + kEnoughAgain : low_battery_;
  return !std::exchange(is_low_, voltage < limit) && is_low_;
}

// Old firmware does not tell which groups are on: those whose echoes come are not off.
bool Remarks::have_fallen_silent(const Sip& sip, TimePoint now) {
  if (sip.sonar_groups != 0 || !sip.echoes.empty()) start(now);
  return !std::exchange(are_off_, now - heard_ > kSonarStart) && are_off_;
}

}  // namespace orca::hw::p2os
