// SPDX-License-Identifier: LGPL-3.0-or-later
#include "failure_injector.hpp"

#include <map>
#include <stdexcept>

namespace orca::host {
namespace {

constexpr Duration kPeriodOfNone = std::chrono::milliseconds(100);
constexpr int kPeriodsLate = 9;

const std::map<std::string_view, Failure> kFailures{{"silent", Failure::silent},
                                                    {"throw", Failure::throws},
                                                    {"hang", Failure::hang},
                                                    {"slow", Failure::slow}};

}  // namespace

std::optional<Failure> failure_from(std::string_view name) {
  const auto found = kFailures.find(name);
  return found == kFailures.end() ? std::nullopt : std::optional(found->second);
}

const std::vector<std::string>& failure_names() {
  static const std::vector<std::string> names{"silent", "throw", "hang", "slow"};
  return names;
}

void FailureInjector::begin() {
  const std::optional<PlannedFailure>& planned = settings_.failure;
  if (planned) begins_ = saturating_add(run_.executive.now(), planned->at);
}

// Tells people that the failure is no real one when it begins.
bool FailureInjector::has_begun(Failure failure) {
  const std::optional<PlannedFailure>& planned = settings_.failure;
  if (!planned || planned->failure != failure || run_.executive.now() < begins_.load()) return false;
  if (!told_)
    run_.reporter.log(log::Level::warning, settings_.name, "fails from now on, because --fail asks for it");
  told_ = true;
  return true;
}

bool FailureInjector::is_silent() { return has_begun(Failure::silent); }

void FailureInjector::act() {
  if (has_begun(Failure::throws)) throw std::runtime_error("it threw because --fail asks for it");
  const bool hangs = has_begun(Failure::hang);
  if (!hangs && !has_begun(Failure::slow)) return;
  const Duration period = laps_.period() > Duration{0} ? laps_.period() : kPeriodOfNone;
  strand_.note_activity();  // so that the wait is not taken for one that can be begun again
  strand_.wait_for(hangs ? kForever : saturating_add(run_.executive.now(), kPeriodsLate * period),
                   [] { return false; });
}

}  // namespace orca::host
