// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/host/hosted_part.hpp"
#include "run/reporting/reporter.hpp"

namespace orca::host {

/// The edges to other processes whose memory holds what cannot be. Each is an alarm of its component here until it has new
/// memory, which the listener is to see to.
///
/// Thread contract: any thread.
class DamagedEdges {
 public:
  /// @param reporter  of the part, once it runs.
  DamagedEdges(std::function<Reporter&()> reporter, PartListener& listener)
      : reporter_(std::move(reporter)), listener_(listener) {}

  /// Notes that an edge was cut, whose memory holds what cannot be.
  /// @param component  of this process.
  void note(const std::string& edge, const std::string& component, const Error& reason);
  /// Notes that an edge has new memory, damaged or not.
  void note_renewal(const std::string& edge);

 private:
  const std::function<Reporter&()> reporter_;
  PartListener& listener_;
  Mutex mutex_;
  std::map<std::string, std::string> components_ ORCA_GUARDED_BY(mutex_);  // of this process, by edge
};

}  // namespace orca::host
