// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ledger.hpp"

#include <algorithm>
#include <utility>

#include "agreed/tallying.hpp"
#include "orca/base/log.hpp"
#include "orca/graph/placement.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/passed_on.hpp"
#include "orca/host/robot_finder.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/time.hpp"

namespace orca::supervisor {
namespace {

// Reads an object that a host process has reported.
template <class T, Kind kind>
Result<T> read(const ObjectReport<kind>& report) {
  T object;
  if (Status read = object_type<T>().deserialize(report.object, &object); !read.ok()) return read.error();
  return object;
}

// Returns an alarm of the supervisor itself.
idl::Alarm own_alarm(host::AlarmKind kind, const std::string& source, const std::string& text,
                     TimePoint now) {
  idl::Alarm alarm = host::make_alarm(kind, source, "", text);
  alarm.creation_time(to_time_value(now));
  alarm.stamp(alarm.creation_time());
  return alarm;
}

}  // namespace

Ledger::Ledger(const graph::Graph& graph, host::RunListener& listener, TimePoint start, std::string log_name,
               std::function<TimePoint()> clock)
    : graph_(graph),
      listener_(listener),
      start_(start),
      log_name_(std::move(log_name)),
      clock_(std::move(clock)) {
  for (const graph::ComponentNode& node : graph.components) components_[node.name] = {};
  go_over();
  so_far_.start = start;
  listener_.started(start);
}

void Ledger::expect(const std::string& component) {
  const MutexLock lock(mutex_);
  components_[component] = {};
}

void Ledger::go_over() {
  const MutexLock lock(mutex_);
  names_.clear();
  for (const graph::ComponentNode& node : graph_.components) names_.push_back(node.name);
}

Status Ledger::take(const Report& report, const std::string& process) {
  if (const auto* built = std::get_if<Built>(&report)) {
    for (const auto& [hardware, robot] : built->robots) robots_by_hardware_[hardware] = robot;
    return ok();
  }
  if (const auto* line = std::get_if<Logged>(&report)) {
    log::write(line->level, line->who, line->text);
    listener_.logged(line->level, line->who, line->text);
    return ok();
  }
  if (const auto* rest = std::get_if<RestChange>(&report)) {
    if (rest->at_rest)
      restless_.erase(process);
    else
      restless_.insert(process);
    return ok();
  }
  if (const auto* change = std::get_if<StateChange>(&report)) return take_change(*change);
  return take_figures(report, process);
}

Status Ledger::take_figures(const Report& report, const std::string& process) {
  if (const auto* tally = std::get_if<Tally>(&report)) {
    add(*tally, tallies_[process]);  // it may have lived before
    return ok();
  }
  if (const auto* failed = std::get_if<OutputFailed>(&report)) {
    if (!failed->outcome.ok() && !output_error_) output_error_ = failed->outcome.error();
    return ok();
  }
  if (const auto* glance = std::get_if<Glance>(&report)) {
    const MutexLock lock(mutex_);
    glances_[process] = *glance;
    return ok();
  }
  if (const auto* step = std::get_if<MissionStep>(&report)) return missions_.note(*step), ok();
  if (const auto* standing = std::get_if<Standing>(&report)) return recall(*standing);
  return take_object(report, process);
}

Status Ledger::take_change(const StateChange& change) {
  const MutexLock lock(mutex_);
  const auto known = components_.find(change.component);
  if (known == components_.end() || change.state > static_cast<std::uint64_t>(host::ComponentState::exit))
    return fail(Code::data_loss, "it reports an impossible state of \"" + change.component + "\"");
  known->second = {static_cast<host::ComponentState>(change.state), change.has_worked, change.has_failed,
                   change.ended_badly, change.failure};
  return ok();
}

Status Ledger::take_object(const Report& report, const std::string& process) {
  // Returns whether a result is new, and then keeps it.
  const auto keep_new = [this](auto results, const auto& result) {
    const MutexLock lock(mutex_);
    if (host::is_passed_on(so_far_.*results, result)) return false;
    (so_far_.*results).push_back(result);
    return true;
  };
  if (const auto* arrived = std::get_if<ArrivedReport>(&report)) {
    Result<idl::Arrived> object = read<idl::Arrived>(*arrived);
    if (!object) return object.error();
    if (!keep_new(&host::RunResult::arrivals, *object)) return ok();
    listener_.arrived(*object);
    missions_.note(*object);
  } else if (const auto* failed = std::get_if<GoalFailedReport>(&report)) {
    Result<idl::GoalFailed> object = read<idl::GoalFailed>(*failed);
    if (!object) return object.error();
    if (!keep_new(&host::RunResult::failures, *object)) return ok();
    listener_.goal_failed(*object);
    missions_.note(*object);
  } else if (const auto* contact = std::get_if<ContactReport>(&report)) {
    Result<idl::Contact> object = read<idl::Contact>(*contact);
    if (!object) return object.error();
    listener_.contact(*object);
    missions_.note(*object);
    const MutexLock lock(mutex_);
    so_far_.contacts.push_back(std::move(object).value());
  } else if (const auto* alarm = std::get_if<AlarmReport>(&report)) {
    Result<idl::Alarm> object = read<idl::Alarm>(*alarm);
    if (!object) return object.error();
    note(std::move(object).value(), process, process);
  }
  return ok();
}

void Ledger::note(idl::Alarm alarm, const std::string& process, const std::string& reporter) {
  listener_.alarm(alarm);
  alarms_.take(alarm, process);
  missions_.note(alarm);
  if (relay_) relay_->tell(alarm, process, reporter);
  const MutexLock lock(mutex_);
  so_far_.alarms.push_back(std::move(alarm));
}

void Ledger::raise(host::AlarmKind kind, const std::string& process, const std::string& text,
                   const std::string& source) {
  log::error(log_name_, "alarm " + kind_text(kind) + ": " + text);
  note(own_alarm(kind, source, text, clock_()), process, "");
}

bool Ledger::is_active(host::AlarmKind kind, const std::string& source) const {
  return std::ranges::any_of(alarms_.kept(), [&](const host::KeptAlarm& kept) {
    return kept.process.empty() && kept.alarm.kind() == kind && kept.alarm.source() == source &&
           kept.alarm.active();
  });
}

void Ledger::settle(host::AlarmKind kind, const std::string& source, const std::string& text) {
  if (!is_active(kind, source)) return;
  idl::Alarm settled = own_alarm(kind, source, text, clock_());
  settled.active(false);
  note(std::move(settled), "", "");
}

bool Ledger::settle_all(host::AlarmKind kind, const std::string& text) {
  std::set<std::string> sources;
  for (const host::KeptAlarm& kept : alarms_.kept())
    if (is_active(kind, kept.alarm.source())) sources.insert(kept.alarm.source());
  for (const std::string& source : sources) settle(kind, source, text);
  return !sources.empty();
}

Status Ledger::acknowledge(std::uint64_t number) {
  const auto known = std::ranges::find(alarms_.kept(), number, &host::KeptAlarm::number);
  if (known != alarms_.kept().end() && known->alarm.active() && known->alarm.kind() == idl::ESTOP)
    return fail(Code::failed_precondition,
                "the motors are still held; first let them go: orcactl estop --release");
  if (known != alarms_.kept().end() && relay_) relay_->tell_acknowledged(*known);
  return alarms_.acknowledge(number);
}

void Ledger::recall(const idl::Alarm& alarm, const std::string& process) {
  const auto is_same = [&](const host::KeptAlarm& kept) {
    return kept.process == process && host::are_about_the_same(kept.alarm, alarm);
  };
  if (std::ranges::none_of(alarms_.kept(), is_same)) alarms_.take(alarm, process);
}

Status Ledger::recall(const Standing& standing) {
  for (const auto& [process, object] : standing.alarms) {
    idl::Alarm alarm;
    if (Status read = object_type<idl::Alarm>().deserialize(object, &alarm); !read.ok()) return read;
    recall(alarm, process);
  }
  return ok();
}

void Ledger::lose(const std::string& process, const std::string& why) {
  restless_.erase(process);
  settle_holds_of(process, why);
  const MutexLock lock(mutex_);
  glances_.erase(process);
  for (const graph::ComponentNode& node : graph_.components) {
    if (node.process != process) continue;
    host::ComponentReport& report = components_[node.name];
    report.state = host::ComponentState::unloaded;
    report.failure = why;
  }
}

// What its devices held goes with a process; when it comes again the supervisor itself holds it.
void Ledger::settle_holds_of(const std::string& process, const std::string& why) {
  std::vector<idl::Alarm> over;
  for (const host::KeptAlarm& kept : alarms_.kept())
    if (kept.process == process && kept.alarm.active() && kept.alarm.kind() == idl::ESTOP)
      over.push_back(own_alarm(idl::ESTOP, kept.alarm.source(), why, clock_()));
  for (idl::Alarm& alarm : over) {
    alarm.active(false);
    note(std::move(alarm), process, "");
  }
}

bool Ledger::is_in_use(const std::string& process) const {
  const MutexLock lock(mutex_);
  return std::ranges::any_of(graph_.components, [&](const graph::ComponentNode& node) ORCA_REQUIRES(mutex_) {
    const host::ComponentState state = components_.at(node.name).state;
    return node.process == process && state != host::ComponentState::idle &&
           state != host::ComponentState::unloaded;
  });
}

void Ledger::introduce() {
  host::RobotNames robots = host::find_robots(graph_, robots_by_hardware_);
  if (std::exchange(are_introduced_, true) && robots == robots_) return;
  robots_ = std::move(robots);
  listener_.robots(robots_);
}

void Ledger::pardon(const std::string& component) {
  const MutexLock lock(mutex_);
  host::ComponentReport& report = components_[component];
  report.has_failed = report.ended_badly = false;
  report.failure.clear();
}

host::Reports Ledger::reports() const {
  return [this](const std::string& component) {
    const MutexLock lock(mutex_);
    return components_.at(component);
  };
}

std::optional<host::RunCounters> Ledger::counters() const {
  for (const graph::ProcessNode& node : graph::processes_of(graph_))
    if (!node.on_demand && !tallies_.contains(node.name)) return std::nullopt;
  return counters_of(graph_, tallies_);
}

host::RunGlance Ledger::look() const {
  host::RunGlance glance;
  glance.time = clock_() - start_;
  const MutexLock lock(mutex_);
  for (const std::string& name : names_) {
    const host::ComponentReport& report = components_.at(name);
    if (report.state == host::ComponentState::work) ++glance.working;
    if (report.ended_badly || host::is_unsettled(report.state))
      glance.unwell.push_back({name, host::to_string(report.state)});
  }
  for (const auto& [process, shown] : glances_) add(shown, glance);
  if (!so_far_.alarms.empty()) glance.last_alarm = host::alarm_text(so_far_.alarms.back());
  return glance;
}

void Ledger::fill(host::RunResult& result) const {
  const MutexLock lock(mutex_);
  result.start = start_;
  result.arrivals = so_far_.arrivals;
  result.failures = so_far_.failures;
  result.contacts = so_far_.contacts;
  result.alarms = so_far_.alarms;
  result.robots = robots_;
  result.counters = counters_of(graph_, tallies_);
  result.ways = ways_of(tallies_);
}

}  // namespace orca::supervisor
