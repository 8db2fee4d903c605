// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/host/run_outputs.hpp"

namespace orca::deployer {

/// A program beside a running system, such as orcaview: a client like those that people start. If it dies, nothing else
/// notices; it is asked to end if this process is killed.
///
/// Thread contract: the main thread, which lives as long as the process.
class Companion {
 public:
  /// Starts a program of Orca.
  /// @param name   of the program, which stands beside this one.
  /// @param tells  whether first_line() is wanted; otherwise its stdout is this program's.
  /// @errors  unavailable if it cannot be started.
  [[nodiscard]] static Result<Companion> start(const std::string& name, const std::vector<std::string>& words,
                                               bool tells);

  Companion(Companion&& other) noexcept
      : process_(std::exchange(other.process_, 0)), output_(std::move(other.output_)) {}
  Companion& operator=(Companion&&) = delete;
  ~Companion() { (void)end(); }

  /// Waits for the first line that it prints; "" if it ends without one, or takes more than 10 s.
  [[nodiscard]] std::string first_line() const;

  /// Asks it to end, and waits for that; after 5 s it is killed.
  /// @return whether it has ended with exit status 0.
  bool end();

 private:
  Companion(pid_t process, Descriptor output) : process_(process), output_(std::move(output)) {}

  pid_t process_ = 0;  // 0: moved from, or ended
  Descriptor output_;  // what it prints
};

/// Starts orcaview for a system, and prints its address on stderr.
/// @return nothing if that fails, after it was said: a system runs without its page, too.
[[nodiscard]] std::optional<Companion> start_viewer(const std::string& system);

/// The processes that record a system of several processes into MCAP files: one `orcactl record` for each file, which waits for
/// the system and ends with it.
///
/// Thread contract: the main thread.
class Recorders {
 public:
  /// Starts them.
  /// @errors  already_exists if a file is there; as Companion::start().
  Status start(const std::string& system, const std::vector<host::RecordingOptions>& recordings);
  [[nodiscard]] std::size_t count() const { return running_.size(); }
  /// Waits until they have written everything.
  /// @errors  data_loss if one of them says on stderr why it could not.
  Status finish();

 private:
  std::vector<std::pair<Companion, std::string>> running_;  // with their files
};

}  // namespace orca::deployer
