// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/base/system/processor_wait.hpp"
#include "orca/base/time.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/exit_reason.hpp"
#include "orca/supervisor/host_start.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

class LineSplitter;

/// How long a host process may take to end.
struct EndLimits {
  Duration when_asked = 1500ms;      ///< From the order to end until SIGTERM.
  Duration when_terminated = 500ms;  ///< From SIGTERM until SIGKILL.
};

/// A host process that another supervisor has started, and what is needed to supervise it.
struct AdoptedProcess {
  std::string name;
  pid_t pid = -1;
  Descriptor pidfd;
  Descriptor output;   ///< The reading end of its stdout and stderr; reading never waits.
  Descriptor channel;  ///< A new control channel.
};

/// A host process that the supervisor has started or adopted, and its control channel. The destructor kills it if it still
/// runs.
///
/// The process has only these descriptors: stdin is /dev/null or that of the supervisor, stdout and stderr are one pipe that never makes it wait (what
/// finds no room is lost), and the control channel is taken by take_channel() (orca/supervisor/own_process.hpp). Signals
/// have their default effect, except that it ignores what a terminal sends to a whole process group to end it (SIGINT,
/// SIGQUIT, SIGHUP): the supervisor decides how the system ends. It does not die with the supervisor by itself; it sees
/// the end of the channel, and stops the robot first.
///
/// Thread contract: one thread. No function waits, except the destructor for a process that it has killed.
class HostProcess {
 public:
  /// Starts a process.
  /// @errors  not_found if the program cannot be executed. Throws std::system_error if the system gives no more
  ///          processes, memory or descriptors (orca/base/exhaustion.hpp).
  [[nodiscard]] static Result<std::unique_ptr<HostProcess>> start(const HostStart& start);
  /// Takes over a process that runs already. It is no child of this one, so the way in which it ends is a guess.
  [[nodiscard]] static std::unique_ptr<HostProcess> adopt(AdoptedProcess process);
  /// Returns this process itself, for a supervisor of what runs in it. It prints by itself, and cannot be ended.
  /// @param channel  to the desk that takes its orders.
  [[nodiscard]] static std::unique_ptr<HostProcess> here(std::string name, Descriptor channel);
  ~HostProcess();
  HostProcess(const HostProcess&) = delete;
  HostProcess& operator=(const HostProcess&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] Channel& channel() { return channel_; }
  /// Returns what the system has refused of the wishes in HostStart, for people; empty: nothing.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  /// Return descriptors for poll(): POLLIN when the process has ended, and when take_output() has something.
  [[nodiscard]] int end_descriptor() const { return pidfd_.number(); }
  [[nodiscard]] int output_descriptor() const { return output_.number(); }

  /// Returns what the process has written to stdout and stderr: whole lines, printable, without their ends. The rest of a
  /// long line is left out. One call reads a limited amount. When the process has closed both, output_descriptor() is -1.
  [[nodiscard]] std::vector<std::string> take_output();

  /// Returns what it has written of a line that has no end yet, such as a question to the user, and takes it out.
  [[nodiscard]] std::string take_unfinished_line();

  /// Returns another descriptor of its output, for whoever supervises it later; empty if the process has closed its end.
  [[nodiscard]] Descriptor share_output() const;

  /// Notes that the process has said that it ends.
  void note_leaving() {
    is_leaving_ = true;
    if (exit_ && exit_->is_guess) exit_->status = 0;  // its end was seen first
  }

  /// Orders the process to end (TakeDown), and begins to count its time. If it is already being ended, the limits can only
  /// shorten its time.
  /// @param request  of the order.
  void end(Moment now, const EndLimits& limits, std::uint64_t request = 0, bool keeps_states = false);
  /// Ends the process by force: SIGTERM, so that it can stop the motors, then SIGKILL.
  /// @param grace  [s] time for the motors.
  void end_by_force(Force reason, Moment now, Duration grace = 100ms);
  /// Sends the signals that are due. Called when due() has come, or more often.
  void look(Moment now);
  /// Returns when look() has something to do; nothing if never.
  [[nodiscard]] std::optional<Moment> due() const;

  /// Returns why the process has ended; nothing while it runs.
  [[nodiscard]] const std::optional<ExitReason>& exit();

  /// Returns whether a signal has ended it already, although it still exists: it writes its core, or a busy machine lets its threads
  /// wait. It does nothing any more, and no signal makes it end earlier.
  [[nodiscard]] bool is_dying() const;
  /// Returns its private memory in use [bytes]; nothing if it has ended.
  [[nodiscard]] std::optional<std::uint64_t> memory() const;
  /// Returns for how long [s] its thread that takes orders has waited for a processor.
  [[nodiscard]] Duration waited_for_processor();

 private:
  struct Parts;
  explicit HostProcess(Parts parts);
  void send(int signal) const;
  [[nodiscard]] std::optional<ExitReason> look_for_end() const;
  [[nodiscard]] std::optional<ExitReason> guess_end() const;

  const std::string name_;
  const pid_t pid_;
  const Descriptor pidfd_;
  Descriptor output_;
  Channel channel_;
  std::vector<std::string> warnings_;
  std::unique_ptr<LineSplitter> lines_;
  const std::uint64_t oom_kills_before_;

  std::optional<Moment> term_at_;  // when SIGTERM is due
  std::optional<Moment> kill_at_;  // when SIGKILL is due
  Force force_ = Force::none;
  bool is_leaving_ = false;
  std::optional<ExitReason> exit_;
  std::optional<ProcessorWait> wait_;  // nothing: nobody has asked yet
};

}  // namespace orca::supervisor
