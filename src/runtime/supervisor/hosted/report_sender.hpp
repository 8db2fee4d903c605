// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "agreed/run_wishes.hpp"
#include "backlog.hpp"
#include "orca/base/log.hpp"
#include "orca/base/mutex.hpp"
#include "orca/host/hosted_part.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/vocabulary.hpp"
#include "recollection.hpp"

namespace orca::supervisor {

/// The listener of a part that tells the supervisor everything. It never waits: while the supervisor does not read,
/// lines of the log are lost, and with them, beyond the channel's bound, everything else. While there is no supervisor, it
/// keeps for the next one what a Backlog keeps.
///
/// Thread contract: as RunListener; the rest from any thread, but show().
class ReportSender final : public host::PartListener {
 public:
  /// @param channel  to the supervisor.
  /// @param process  name of this one.
  ReportSender(std::shared_ptr<Channel> channel, const std::string& process, const RunWishes& wishes);

  /// Sends a report.
  void send(Report report);
  /// Sends the last report of this process, and waits for a moment until it is sent.
  void send_last(Report report);

  /// Notes that there is no supervisor any more.
  void lose_supervisor();
  /// Tells a new supervisor how things are and what was kept for it. From now on it is told everything.
  void greet(std::shared_ptr<Channel> channel);
  /// Notes what a supervisor has told this process, and the next one must know.
  void remember(const std::function<void(Recollection&)>& note);

  void component_changed(const std::string& component, const host::ComponentReport& report) override;
  void rest_changed(bool at_rest) override;
  void arrived(const idl::Arrived& arrived) override;
  void goal_failed(const idl::GoalFailed& failed) override;
  void contact(const idl::Contact& contact) override;
  void alarm(const idl::Alarm& alarm) override;
  void mission_step(const std::string& port, const ObjectRef& object) override;
  void counted(const host::RunCounters& counters, const std::vector<host::RunResult::Way>& ways) override;
  void state_kept(const std::string& component, const host::KeptState& state) override;
  void peer_called(const host::PeerCall& call) override;
  void edge_damaged(const std::string& edge) override;
  void output_failed(const Error& error) override;
  /// Sends what the part is like, if that has changed since it was sent last.
  /// @thread  one at a time.
  void show(const host::RunGlance& glance);
  [[noreturn]] void abandon(const host::RunResult& result) override;

 private:
  void tell(Report report) ORCA_REQUIRES(mutex_);

  const TimePoint start_;  // of the run
  Mutex mutex_;
  std::shared_ptr<Channel> channel_ ORCA_GUARDED_BY(mutex_);  // null: there is no supervisor
  Recollection recollection_ ORCA_GUARDED_BY(mutex_);
  Backlog backlog_;
  std::vector<std::byte> shown_ ORCA_GUARDED_BY(mutex_);  // the last Glance

  const log::Listener log_;  // the last member: it uses the others
};

}  // namespace orca::supervisor
