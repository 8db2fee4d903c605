// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/output_file.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/host/run_outputs.hpp"
#include "recorder.hpp"
#include "trace.hpp"

namespace orca::host {

/// The files that a run writes: trace, recordings and picture.
///
/// Thread contract: trace and recorder have their own; close_at_once() may be called from any thread, the rest from the
/// run's own.
class RunFiles {
 public:
  explicit RunFiles(const Executive& executive) : trace_(executive), recorder_(executive) {}

  /// Opens all files that are wanted, so that a wrong name is known before anything moves. To be called once.
  /// @param ports  all ports of the graph.
  /// @errors  as OutputFile::open().
  Status open(const RunOutputs& wanted, const std::vector<graph::ListedPort>& ports, const BagOrigin& run);

  /// Writes the rest of all files and closes them. @return what could not be written.
  [[nodiscard]] std::vector<Error> close();

  /// Writes what a run leaves behind that ends in the middle, in whatever state it is.
  void close_at_once();

  [[nodiscard]] Trace& trace() { return trace_; }
  [[nodiscard]] const Trace& trace() const { return trace_; }
  [[nodiscard]] Recorder& recorder() { return recorder_; }
  [[nodiscard]] OutputFile& picture() { return picture_; }

 private:
  Trace trace_;
  Recorder recorder_;
  OutputFile picture_{"the picture"};
};

}  // namespace orca::host
