// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/base/system/pace.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/part_access.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// A supervisor that lets people and programs watch and command a run in this process, in virtual time, through the system's
/// socket. It does so on threads of its own, and conducts nothing: to look on changes nothing in the run, an order does.
///
/// It passes what a listener hears on to the run's own listener.
///
/// Thread contract: the main thread, which runs the system; the listener's part as RunListener.
class Attendance final : public host::RunListener, public host::RunVisitors {
 public:
  /// What is attended. A plain value.
  struct Attended {
    graph::Graph graph;  ///< All of it runs in this process, whatever it says of processes and machines.
    SystemFacts facts;
    std::string log_name;
  };

  /// Takes the system's socket.
  /// @param pace      of the run; outlives the object, as `listener` does.
  /// @param listener  of the run.
  /// @errors  as ControlSocket::open(); unavailable if the system gives no more memory or descriptors.
  [[nodiscard]] static Result<std::unique_ptr<Attendance>> open(Attended run, Pace& pace,
                                                                host::RunListener& listener);
  ~Attendance() override;

  [[nodiscard]] Pace& pace() override;
  void enter(host::PartAccess& run) override;
  void came_up() override;
  void component_changed(const std::string& component, const host::ComponentReport& report) override;
  void leave() override;

  void started(TimePoint now) override;
  void robots(const host::RobotNames& robots) override;
  void built(const host::RunView& view) override;
  void arrived(const idl::Arrived& arrived) override;
  void goal_failed(const idl::GoalFailed& failed) override;
  void contact(const idl::Contact& contact) override;
  void alarm(const idl::Alarm& alarm) override;
  void mission_step(const std::string& port, const ObjectRef& object) override;
  void logged(log::Level level, std::string_view who, std::string_view text) override;
  void ended(const host::RunResult& result) override;
  [[noreturn]] void abandon(const host::RunResult& result) override;

 private:
  class Inside;
  explicit Attendance(std::unique_ptr<Inside> inside);
  const std::unique_ptr<Inside> inside_;
};

}  // namespace orca::supervisor
