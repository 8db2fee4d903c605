// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/log.hpp"
#include "orca/host/hosted_part.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The listener of a part that tells the supervisor everything. It never waits: while the supervisor does not read,
/// lines of the log are lost, and with them, beyond the channel's bound, everything else.
///
/// Thread contract: as RunListener; send() from any thread.
class ReportSender final : public host::PartListener {
 public:
  ReportSender(Channel& channel, log::Level level);

  /// Sends a report.
  /// @param request  of an answer, the number of its order.
  void send(Report report, std::uint64_t request = 0);

  void component_changed(const std::string& component, const host::ComponentReport& report) override;
  void rest_changed(bool at_rest) override;
  void arrived(const idl::Arrived& arrived) override;
  void goal_failed(const idl::GoalFailed& failed) override;
  void contact(const idl::Contact& contact) override;
  void alarm(const idl::Alarm& alarm) override;
  void mission_step(const std::string& port, const ObjectRef& object) override;
  void counted(const host::RunCounters& counters, const std::vector<host::RunResult::Way>& ways) override;
  void output_failed(const Error& error) override;
  /// Sends what the part is like, if that has changed since it was sent last.
  /// @thread  one at a time.
  void show(const host::RunGlance& glance);
  [[noreturn]] void abandon(const host::RunResult& result) override;

 private:
  Channel& channel_;
  std::vector<std::byte> shown_;  // the last Glance
  const log::Listener log_;
};

}  // namespace orca::supervisor
