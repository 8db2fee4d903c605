// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"

namespace orca::apps {

/// A program that this process has started. It is asked to end when this object goes, and when this process dies.
///
/// Thread contract: one thread, which lives as long as the process.
class ChildProgram {
 public:
  /// Which of the streams that it prints on is for output(); the others are those of this process.
  enum class Reads { nothing, standard_output, everything };

  /// Starts a program. It reads nothing, and a Ctrl-C in the terminal is not for it.
  /// @param words   its name and arguments; the program is looked for as a shell does, but first beside this one.
  /// @param folder  in which it runs.
  /// @errors  unavailable if it cannot be started. A program that is not there ends at once with status 127.
  [[nodiscard]] static Result<ChildProgram> start(const std::vector<std::string>& words, Reads reads,
                                                  const std::string& folder = ".");
  ChildProgram(ChildProgram&& other) noexcept
      : process_(std::exchange(other.process_, 0)),
        status_(other.status_),
        output_(std::move(other.output_)) {}
  ChildProgram& operator=(ChildProgram&&) = delete;
  ~ChildProgram() { (void)end(); }

  /// The end of a pipe from which what it prints can be read. It may be given away.
  [[nodiscard]] Descriptor& output() { return output_; }
  /// Waits for the first line that it prints; "" if it ends without one, or takes more than 10 s.
  [[nodiscard]] std::string first_line() const;

  /// Looks whether it has ended.
  /// @return its exit status, or 128 and the signal that has ended it; nothing while it runs.
  [[nodiscard]] std::optional<int> ended();
  /// Waits until it has ended, which one that has closed its output does soon.
  /// @return as ended().
  int wait();
  /// Asks it to end unless it has, and waits for that; after 5 s it is killed.
  /// @return as ended().
  int end();

 private:
  ChildProgram(pid_t process, Descriptor output) : process_(process), output_(std::move(output)) {}

  pid_t process_ = 0;  // 0: moved from, or ended
  std::optional<int> status_{};
  Descriptor output_;
};

/// Returns how a program has ended, for people: "exit status 1" or "signal 9".
/// @param status  as ChildProgram::ended() gives it.
[[nodiscard]] std::string ending_text(int status);

}  // namespace orca::apps
