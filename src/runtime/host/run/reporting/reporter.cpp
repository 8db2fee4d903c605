// SPDX-License-Identifier: LGPL-3.0-or-later
#include "reporter.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/passed_on.hpp"
#include "orca/idl/time.hpp"
#include "orca/plugin/loaded_plugins.hpp"

namespace orca::host {
namespace {

constexpr Duration kTroubleInterval = 10s;
constexpr double kFarOff = 0.2;  // [m] what a robot drives meanwhile is less

// Returns the component of "component.port".
std::string component_of(std::string_view path) { return std::string(path.substr(0, path.rfind('.'))); }

std::string mention(std::uint64_t mission) {
  return mission == 0 ? "" : " (mission " + std::to_string(mission) + ")";
}

}  // namespace

Reporter::Reporter(const Executive& executive, Trace& trace, RunListener& listener, std::string log_name)
    : executive_(executive),
      trace_(trace),
      listener_(listener),
      log_name_(std::move(log_name)),
      start_(executive.now()),
      trouble_lines_(kTroubleInterval) {
  listener_.started(start_);
}

void Reporter::delivered(std::string_view component, std::string_view port, const ObjectRef& object) {
  trace_.delivered(component, port, object);
  if (taps_ != nullptr) taps_->pass(Flow::delivered, component, port, object);
  if (recorder_ != nullptr) recorder_->delivered(component, port, object);
  if (sightings_ != nullptr) sightings_->delivered(component, object);
}

void Reporter::pushed(std::string_view component, std::string_view port, const ObjectRef& object) {
  if (taps_ != nullptr) taps_->pass(Flow::pushed, component, port, object);
  if (recorder_ != nullptr) recorder_->pushed(component, port, object);
  if (&object.type() == &object_type<idl::Arrived>()) hear(*static_cast<const idl::Arrived*>(object.get()));
  if (&object.type() == &object_type<idl::GoalFailed>())
    hear(*static_cast<const idl::GoalFailed*>(object.get()));
  if (&object.type() != &object_type<idl::Localization>()) return;
  const std::lock_guard lock(mutex_);
  add_to(localizations_, *static_cast<const idl::Localization*>(object.get()));
}

bool Reporter::is_looked_at(std::string_view component, std::string_view port) {
  return (taps_ != nullptr && taps_->are_at(Flow::pushed, component, port)) ||
         (recorder_ != nullptr && recorder_->records_pushes(component, port));
}

void Reporter::requested(std::string_view component, std::string_view port, const ObjectRef& object) {
  if (taps_ != nullptr) taps_->pass(Flow::requested, component, port, object);
  if (recorder_ != nullptr) recorder_->requested(component, port, object);
  if (object.header().mission() != 0) follow_mission(component, port, object);
}

// Most objects of a port belong to one mission, so as a rule this is a look at two maps.
void Reporter::follow_mission(std::string_view component, std::string_view port, const ObjectRef& object) {
  const std::lock_guard lock(mutex_);
  auto of_component = last_missions_.find(component);
  if (of_component == last_missions_.end())
    of_component = last_missions_.emplace(std::string(component), decltype(of_component->second){}).first;
  auto last = of_component->second.find(port);
  if (last == of_component->second.end()) last = of_component->second.emplace(std::string(port), 0).first;
  if (std::exchange(last->second, object.header().mission()) == object.header().mission()) return;
  listener_.mission_step(std::string(component) + "." + std::string(port), object);
}

void Reporter::hear(const idl::Arrived& arrived) {
  std::string doubt;
  {
    const std::lock_guard lock(mutex_);
    if (is_passed_on(arrivals_, arrived)) return;
    arrivals_.push_back(arrived);
    listener_.arrived(arrived);
    doubt = this->doubt(arrived);
  }
  if (!doubt.empty()) log(log::Level::warning, arrived.origin(), doubt, arrived.mission());
}

// Returns what is wrong with the place at which a robot says that it has arrived; empty: nothing, or it is not simulated. Goals may be
// in the frame of the world or, without a localizer, in that of the odometry, which begins where the robot started.
std::string Reporter::doubt(const idl::Arrived& arrived) const {
  const std::string robot = robots_.of(arrived.origin());
  const auto truth = robot.empty() && truths_.size() == 1 ? truths_.begin() : truths_.find(robot);
  if (truth == truths_.end()) return {};
  const auto& [X_WS, X_WR] = truth->second;
  const Vec2 said{arrived.x(), arrived.y()};
  const double off = std::min(norm(X_WR.position() - said), norm((inverse(X_WS) * X_WR).position() - said));
  if (off <= kFarOff) return {};
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", off);
  return "says that it has arrived at " + in_quotes(arrived.name()) + ", and truly the robot is " + text +
         " from where it says it is";
}

void Reporter::note_truth(const std::string& robot, const Pose2& X_WR) {
  const std::lock_guard lock(mutex_);
  truths_.try_emplace(robot, Truth{X_WR, X_WR}).first->second.now = X_WR;
}

void Reporter::hear(const idl::GoalFailed& failed) {
  const std::lock_guard lock(mutex_);
  if (is_passed_on(failures_, failed)) return;
  failures_.push_back(failed);
  listener_.goal_failed(failed);
}

void Reporter::trouble(LinkTrouble kind, std::string_view from, std::string_view to, std::string_view text) {
  const std::string ends = std::string(from) + " to " + std::string(to);
  std::optional<std::uint64_t> left_out;
  {
    const std::lock_guard lock(mutex_);
    if (ignores_trouble_) return;
    left_out = trouble_lines_.admit(std::to_string(static_cast<int>(kind)) + ends, executive_.now());
  }
  if (!left_out) return;
  log(log::Level::warning, component_of(kind == LinkTrouble::refused ? from : to),
      ends + ": " + std::string(text) + mention_left_out(*left_out));
}

void Reporter::foreign_call(std::string_view component, std::string_view port, const void* code) {
  {
    const std::lock_guard lock(mutex_);
    if (!with_foreign_threads_.emplace(component).second) return;
  }
  const char* const plugin = plugin::plugin_at(code);
  raise(make_alarm(
      idl::FOREIGN_THREAD, std::string(component), "",
      std::string(component) + "." + std::string(port) +
          " was called by a thread that runs no component, and refuses; only the component's own hooks, "
          "laps and handlers may call its ports" +
          (plugin != nullptr ? std::string("; the plugin is ") + plugin : "")));
}

void Reporter::ignore_trouble() {
  const std::lock_guard lock(mutex_);
  ignores_trouble_ = true;
}

void Reporter::report(const std::string& origin, const idl::Contact& contact) {
  const std::lock_guard lock(mutex_);
  idl::Contact& reported = contacts_.emplace_back(contact);
  reported.creation_time(to_time_value(executive_.now()));
  reported.origin() = origin;
  reported.seq(contacts_.size());
  listener_.contact(reported);
}

void Reporter::raise(idl::Alarm alarm) {
  log_alarm(alarm, log_name_);
  note(std::move(alarm));
}

void Reporter::note(idl::Alarm alarm) {
  alarm.creation_time(to_time_value(executive_.now()));
  alarm.stamp(alarm.creation_time());
  const std::lock_guard lock(mutex_);
  alarm.seq(alarms_.size() + 1);
  alarms_.push_back(std::move(alarm));
  alarm_news_.add(alarms_.back(), "");
  if (recorder_ != nullptr) recorder_->alarmed(alarms_.back());
  listener_.alarm(alarms_.back());
}

void Reporter::introduce(RobotNames robots) {
  const std::lock_guard lock(mutex_);
  robots_ = std::move(robots);
  listener_.robots(robots_);
}

void Reporter::log(log::Level level, const std::string& who, std::string_view text, std::uint64_t mission) {
  const std::string line = std::string(text) + mention(mission);
  log::write(level, who, line);
  const std::lock_guard lock(mutex_);
  listener_.logged(level, who, line);
}

void Reporter::draw(Scene& scene) const {
  const std::lock_guard lock(mutex_);
  for (const idl::Arrived& arrived : arrivals_)
    scene.arrivals.push_back({arrived.name(),
                              {arrived.x(), arrived.y()},
                              to_time_point(arrived.stamp()),
                              robots_.of(arrived.origin())});
  for (const idl::Contact& contact : contacts_)
    scene.contacts.push_back(
        {contact.robot(), {contact.x(), contact.y()}, to_time_point(contact.stamp()), contact.robot()});
}

std::string Reporter::last_alarm() const {
  const std::lock_guard lock(mutex_);
  return alarms_.empty() ? std::string() : alarm_text(alarms_.back());
}

void Reporter::fill(RunResult& result) const {
  const std::lock_guard lock(mutex_);
  result.start = start_;
  result.arrivals = arrivals_;
  result.failures = failures_;
  result.contacts = contacts_;
  result.alarms = alarms_;
  result.localizations = localizations_.all;
  result.robots = robots_;
}

}  // namespace orca::host
