// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <pthread.h>

#include <exception>
#include <string>

namespace orca::host {

/// The beginning of the last words of a process that has died in a thread of Fast DDS: anybody who can send packets to it may have
/// caused that.
inline constexpr const char* kNetworkCode = "the network code (Fast DDS) ";

/// The last line of a process that dies of a plugin, on stderr: which component, which hook, which plugin,
/// what happened. It prevents nothing, but stops the motors as far as possible (StopSignal::on_crash()). A signal
/// or an exception that nobody may catch still ends the process in the same way, and exit() in a plugin ends it
/// with another status. If a
/// plugin calls fork(), the copy is ended, because a second robot program must not run.
///
/// No line is written after _exit(), after SIGKILL, or when the process's memory is beyond use.
///
/// Thread contract: one object per process, made first and destroyed last by the main thread.
class LastWords {
 public:
  /// @param exit_status       status of a process that a plugin tries to end by exit(), or has made unusable.
  /// @param exhausted_status  status of a process that ends because the system gives it no more memory, threads
  ///                          or descriptors, where nobody can catch that.
  LastWords(int exit_status, int exhausted_status);
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

  /// Gives the calling thread a stack to report from after an overflow of its own. Needed once per thread.
  static void prepare_thread();

  /// Returns whether a signal is ending the process. Its handler is no longer what it was, which is nobody's doing.
  /// @thread  any.
  [[nodiscard]] static bool is_dying() noexcept;

  /// Returns the handler that std::terminate() must lead to: that of the object, or without one the present one.
  /// @thread  any.
  [[nodiscard]] static std::terminate_handler terminate_handler() noexcept;

  /// Ends the object's work in a copy of the process, which has a handler of its own for std::terminate().
  /// @thread  the only one of the copy.
  static void leave_copy() noexcept;

  /// Makes sure that exit() ends the process before it destroys anything that has been made so far. Called when the
  /// components begin to work.
  /// @thread  any.
  static void catch_exit();

  /// Writes a line to the stderr of the time of construction, and ends the process with the exit status given
  /// to the constructor.
  [[noreturn]] static void say_and_end(const std::string& line);

  /// Ends the process because a thread does not end, after a line that says what that thread is doing. Needs no
  /// object.
  /// @param said  what is said of it: "has not ended in time".
  [[noreturn]] static void end_hung(pthread_t thread, const char* said, int exit_status);
};

}  // namespace orca::host
