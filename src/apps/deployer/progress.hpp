// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "orca/base/time.hpp"
#include "orca/host/run_view.hpp"

namespace orca::deployer {

/// Returns what the line of progress says: time and factor to real time, who is not well, the distance to the goals,
/// the last alarm. Printable, of any width.
/// @param wall  time since the start on the wall clock [s].
[[nodiscard]] std::string progress_text(const host::RunGlance& glance, Duration wall);

/// Returns whether stderr is a terminal that can erase a line.
[[nodiscard]] bool stderr_can_live();

/// The line on stderr that shows how a run is going, drawn anew five times a second of the wall clock until this
/// object is destroyed. Nothing of it is left over then.
///
/// Thread contract: one thread. The line is drawn on a thread of its own.
class Progress {
 public:
  /// @param view  outlives this object.
  explicit Progress(const host::RunView& view);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  void draw_again_and_again();
  void draw() const;

  const host::RunView& view_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ending_ = false;
  std::thread drawer_;
};

}  // namespace orca::deployer
