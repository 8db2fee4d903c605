// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/host/run_listener.hpp"
#include "progress.hpp"

namespace orca::deployer {

/// A listener that writes one line per event of a run to standard output, each at once: `arrived NAME x y t`,
/// `failed NAME reason`, `contact NAME t`, and last, in virtual time, `trace-hash <16 hex digits>`. If there are
/// several robots, all but the last end with the name of the robot. Lengths are in metres, times in seconds since
/// the start of the run. On request, progress and what the connections carried go to standard error.
///
/// Thread contract: as RunListener.
class Console final : public host::RunListener {
 public:
  /// @param stats     whether to write what the connections carried.
  /// @param progress  whether to write a summary at the end, and, to a terminal, a line that lives until then.
  Console(bool stats, bool progress) : stats_(stats), progress_(progress) {}

  /// Something that the command line plans for a time of the run.
  struct Planned {
    std::string what;  ///< "the failure of avoid".
    Duration at{0};    ///< [s after the start]
  };
  /// Has the log say at the end which of these did not come, because the run ended before.
  void expect(std::vector<Planned> planned) { planned_ = std::move(planned); }

  void started(TimePoint now) override { start_ = now; }
  void robots(const host::RobotNames& robots) override { robots_ = robots; }
  void built(const host::RunView& view) override;
  void arrived(const idl::Arrived& arrived) override;
  void goal_failed(const idl::GoalFailed& failed) override;
  void contact(const idl::Contact& contact) override;
  void ended(const host::RunResult& result) override;
  [[noreturn]] void abandon(const host::RunResult& result) override;

 private:
  [[nodiscard]] double seconds(const idl::TimeValue& stamp) const;
  [[nodiscard]] std::string ending(const std::string& robot) const;

  [[nodiscard]] std::string closing_text(const host::RunResult& result) const;

  void name_what_did_not_come(const host::RunResult& result) const;

  const bool stats_;
  const bool progress_;
  std::vector<Planned> planned_;
  const std::chrono::steady_clock::time_point wall_start_ = std::chrono::steady_clock::now();
  std::optional<Progress> progress_line_;
  TimePoint start_;
  host::RobotNames robots_;
};

}  // namespace orca::deployer
