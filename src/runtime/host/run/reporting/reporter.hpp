// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "alarm_news.hpp"
#include "line_limit.hpp"
#include "localization_log.hpp"
#include "orca/host/port_taps.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/hw/scene.hpp"
#include "orca/patterns/endpoints/link_observer.hpp"
#include "run/recording/recorder.hpp"
#include "run/recording/trace.hpp"
#include "sightings.hpp"

namespace orca::host {

/// The collector of everything in a run that is meant for people and programs outside: results of missions,
/// contacts, alarms, log lines. It passes each on to the listener and keeps it for the result. Deliveries go to the
/// trace first.
///
/// Thread contract: any strand or thread.
class Reporter final : public LinkObserver {
 public:
  /// @param log_name  name in the log for whatever concerns no single component.
  Reporter(const Executive& executive, Trace& trace, RunListener& listener, std::string log_name);

  /// Passes what is delivered on to `sightings` as well.
  /// @pre  nothing runs yet.
  void look_on(Sightings& sightings) { sightings_ = &sightings; }
  /// Passes what travels on to `recorder` as well.
  /// @pre  nothing runs yet.
  void record(Recorder& recorder) { recorder_ = &recorder; }
  /// Keeps what localizers say for the result.
  /// @pre  nothing runs yet.
  void keep_localizations() { localizations_.keeps = true; }
  /// Passes what travels on to `taps` as well.
  /// @pre  nothing runs yet.
  void tap(PortTaps& taps) { taps_ = &taps; }

  void delivered(std::string_view component, std::string_view port, const ObjectRef& object) override;
  /// Passes on the results of missions: Arrived and GoalFailed.
  void pushed(std::string_view component, std::string_view port, const ObjectRef& object) override;
  [[nodiscard]] bool is_looked_at(std::string_view component, std::string_view port) override;
  void requested(std::string_view component, std::string_view port, const ObjectRef& object) override;
  void link_changed(std::string_view client, std::string_view server, bool connected) override {
    trace_.link_changed(client, server, connected);
  }
  /// Writes a warning to the log, under the name of the component that sends, asks or receives. Of one kind
  /// of trouble of one connection there is at most one line in 10 s of the run's clock.
  void trouble(LinkTrouble kind, std::string_view from, std::string_view to, std::string_view text) override;

  /// Raises the alarm FOREIGN_THREAD, once for each component.
  void foreign_call(std::string_view component, std::string_view port, const void* code) override;

  /// Reports no more trouble of connections: the system is being taken down.
  void ignore_trouble();

  /// Reports a contact.
  /// @param origin  the hardware container that reports it.
  void report(const std::string& origin, const idl::Contact& contact);
  /// Notes where a simulated robot truly is: a warning follows an arrival that is said to be elsewhere.
  void note_truth(const std::string& robot, const Pose2& X_WR);
  /// Writes an alarm to the log and reports it.
  void raise(idl::Alarm alarm);
  /// Reports an alarm whose text is in the log already, whatever it is about.
  void note(idl::Alarm alarm);
  /// Returns the alarms of the whole system, as far as this process has heard of them.
  [[nodiscard]] AlarmNews& alarm_news() { return alarm_news_; }
  /// Sets the robots of the run and reports them, before anything moves.
  void introduce(RobotNames robots);
  /// Writes a line to the log and reports it.
  /// @param mission  mission that the line belongs to, which the line then names; 0: none.
  void log(log::Level level, const std::string& who, std::string_view text, std::uint64_t mission = 0);
  /// Writes a line about the run as a whole to the log.
  void log_info(std::string_view text) { log(log::Level::info, log_name_, text); }
  void log_warning(std::string_view text) { log(log::Level::warning, log_name_, text); }
  /// Writes an error of the run as a whole to the log.
  void log_error(std::string_view text) const { log::error(log_name_, text); }

  /// Adds arrivals and contacts to a picture.
  void draw(Scene& scene) const;
  /// Returns the last alarm for people: "avoid FAILED: work() threw 7"; empty: there was none.
  [[nodiscard]] std::string last_alarm() const;
  /// Fills in what has been reported so far, and the start of the run.
  void fill(RunResult& result) const;

 private:
  // The true poses of a simulated robot in the frame of the world.
  struct Truth {
    Pose2 start;
    Pose2 now;
  };

  void hear(const idl::Arrived& arrived);
  void hear(const idl::GoalFailed& failed);
  [[nodiscard]] std::string doubt(const idl::Arrived& arrived) const;
  void follow_mission(std::string_view component, std::string_view port, const ObjectRef& object);

  const Executive& executive_;
  Trace& trace_;
  RunListener& listener_;
  const std::string log_name_;
  const TimePoint start_;
  Sightings* sightings_ = nullptr;
  Recorder* recorder_ = nullptr;
  PortTaps* taps_ = nullptr;
  AlarmNews alarm_news_;
  mutable std::mutex mutex_;
  std::vector<idl::Arrived> arrivals_;
  std::vector<idl::GoalFailed> failures_;
  std::vector<idl::Contact> contacts_;
  std::vector<idl::Alarm> alarms_;
  LocalizationLog localizations_;
  RobotNames robots_;
  std::map<std::string, Truth, std::less<>> truths_;  // by robot
  LineLimit trouble_lines_;
  std::set<std::string, std::less<>> with_foreign_threads_;  // components
  // Mission of the last object that a port has sent, by component and port.
  std::map<std::string, std::map<std::string, std::uint64_t, std::less<>>, std::less<>> last_missions_;
  bool ignores_trouble_ = false;
};

}  // namespace orca::host
