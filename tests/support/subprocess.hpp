// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace orca::test {

using Seconds = std::chrono::duration<double>;

/// How a program ended.
struct Ending {
  int exit_code = -1;  ///< -1 if a signal ended it.
  int signal = 0;      ///< 0 if it ended by itself.
  Seconds wall{0};     ///< From its start to its end.
  Seconds cpu{0};      ///< User and system time, its reaped children's included.
};

/// A program under test: in a process group of its own, stdout and stderr captured apart. What is left of the
/// group is killed on destruction, also when this process dies.
///
/// Not synchronised: one thread, and it has to live as long as the program.
class Subprocess {
 public:
  struct Options {
    std::string input{};           ///< Fed to stdin.
    bool keep_input_open = false;  ///< Else stdin ends after `input`.
    std::string folder{};          ///< To start in; empty: this process's.
  };

  /// @param command  the program's path and its arguments.
  explicit Subprocess(const std::vector<std::string>& command) : Subprocess(command, Options{}) {}
  Subprocess(const std::vector<std::string>& command, const Options& options);
  ~Subprocess();
  Subprocess(const Subprocess&) = delete;
  Subprocess& operator=(const Subprocess&) = delete;

  /// Waits until the program has ended, at most `limit`; nothing if it runs on.
  std::optional<Ending> wait(Seconds limit);

  /// Waits until its stdout or stderr contains `text`; false if `limit` passes or it ends before.
  bool wait_for_output(const std::string& text, Seconds limit);

  /// To the program alone; as from a terminal, send_to_group().
  void send(int signal) const;
  void send_to_group(int signal) const;

  /// More for stdin.
  /// @pre  keep_input_open, and the program still reads.
  void write_input(const std::string& text) const;
  void close_input();

  /// What it has written so far.
  [[nodiscard]] std::string out() const { return captured(out_fd_); }
  [[nodiscard]] std::string err() const { return captured(err_fd_); }

  /// Whether any process of its group is there still, the program or what it has started.
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
