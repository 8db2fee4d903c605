// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <list>
#include <thread>

#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/host/part_access.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The lines between operators' programs and ports of this process: objects that pass a port go out, objects for a server
/// come in. A thread of its own encodes and sends, as long as there are lines, so a component that is looked at does
/// nothing more than put a view of each object into a queue; where a line has a bound of its own, it measures the object
/// before. A client that does not read loses objects, and is told how
/// many; a line may have a bound of its own for what waits, as a recorder needs. One that sends rubbish is cut off.
///
/// Thread contract: open() from one thread at a time. Destroyed before the part.
class PortLines {
 public:
  static constexpr std::size_t kMost = 64;  ///< Lines at a time: a page has one for each port that it shows.

  explicit PortLines(host::PartAccess& part);
  ~PortLines();
  PortLines(const PortLines&) = delete;
  PortLines& operator=(const PortLines&) = delete;

  /// Opens a line.
  /// @errors  as HostedPart::tap(); unavailable if there are kMost.
  Status open(OpenLine order);

 private:
  class Line;
  void serve();

  host::PartAccess& part_;
  std::thread thread_;  // runs, or has ended

  Mutex mutex_;
  std::list<Line> lines_ ORCA_GUARDED_BY(mutex_);
  bool runs_ ORCA_GUARDED_BY(mutex_) = false;  // whether the thread goes on
  bool ending_ ORCA_GUARDED_BY(mutex_) = false;
};

}  // namespace orca::supervisor
