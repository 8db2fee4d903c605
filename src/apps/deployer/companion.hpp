// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <sys/types.h>

#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::deployer {

/// A program beside a running system, such as orcaview: a client like those that people start. If it dies, nothing else
/// notices; it ends with this object, and if this process is killed.
///
/// Thread contract: the main thread, which lives as long as the process.
class Companion {
 public:
  /// Starts a program of Orca, and waits for the first line that it prints: it is ready then.
  /// @param name   of the program, which stands beside this one.
  /// @errors  unavailable if it does not start, or ends without a line; what it says goes to stderr.
  [[nodiscard]] static Result<Companion> start(const std::string& name,
                                               const std::vector<std::string>& words);

  Companion(Companion&& other) noexcept
      : process_(std::exchange(other.process_, 0)), first_line_(std::move(other.first_line_)) {}
  Companion& operator=(Companion&&) = delete;
  /// Asks it to end, and waits for that.
  ~Companion();

  [[nodiscard]] const std::string& first_line() const { return first_line_; }

 private:
  Companion(pid_t process, std::string first_line) : process_(process), first_line_(std::move(first_line)) {}

  pid_t process_ = 0;  // 0: moved from
  std::string first_line_;
};

}  // namespace orca::deployer
