// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace orca::test {

using Seconds = std::chrono::duration<double>;

/// The way in which a program ended.
struct Ending {
  int exit_code = -1;  ///< -1 if a signal ended it.
  int signal = 0;      ///< 0 if it ended by itself.
  Seconds wall{0};     ///< From its start to its end.
  Seconds cpu{0};      ///< User and system time, including its reaped children.
  double peak = 0.0;   ///< [MB] The most memory that it, or one of its reaped children, had.
};

/// A program under test, in a process group of its own. Its stdout and stderr are captured separately. The
/// destructor kills the processes of the group that are left. If this process dies, the program is killed
/// too.
///
/// Thread contract: not synchronised; one thread, which must live as long as the program.
class Subprocess {
 public:
  struct Options {
    std::string input{};           ///< Fed to stdin.
    bool keep_input_open = false;  ///< False: stdin ends after `input`.
    std::string folder{};          ///< Working folder; empty: that of this process.
  };

  /// @param command  the program's path and its arguments.
  explicit Subprocess(const std::vector<std::string>& command) : Subprocess(command, Options{}) {}
  Subprocess(const std::vector<std::string>& command, const Options& options);
  ~Subprocess();
  Subprocess(const Subprocess&) = delete;
  Subprocess& operator=(const Subprocess&) = delete;

  /// Waits until the program has ended, for at most `limit`; nothing if it still runs.
  std::optional<Ending> wait(Seconds limit);

  /// Waits until its stdout or stderr contains `text`; false if `limit` passes or the program ends before.
  bool wait_for_output(const std::string& text, Seconds limit);

  /// Returns its process id, for a look at its children.
  [[nodiscard]] pid_t pid() const { return pid_; }

  /// Sends a signal to the program alone. A terminal signals the whole group, as send_to_group() does.
  void send(int signal) const;
  void send_to_group(int signal) const;

  /// Writes more text to its stdin.
  /// @pre  keep_input_open, and the program still reads.
  void write_input(const std::string& text) const;
  void close_input();

  /// Return what it has written so far.
  [[nodiscard]] std::string out() const { return captured(out_fd_); }
  [[nodiscard]] std::string err() const { return captured(err_fd_); }

  /// Returns whether any process of its group still exists: the program, or one that it has started.
  [[nodiscard]] bool group_lives() const;

 private:
  [[noreturn]] void become(const std::vector<std::string>& command, const std::string& folder, int input);
  static std::string captured(int fd);

  pid_t pid_ = -1;
  int exit_fd_ = -1;  // becomes readable when the program has ended
  int input_fd_ = -1;
  int out_fd_ = -1;
  int err_fd_ = -1;
  std::chrono::steady_clock::time_point start_;
  std::optional<Ending> ending_;
};

}  // namespace orca::test
