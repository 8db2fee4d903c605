// SPDX-License-Identifier: LGPL-3.0-or-later
#include "run_files.hpp"

namespace orca::host {

Status RunFiles::open(const RunOutputs& wanted, const std::vector<graph::ListedPort>& ports,
                      const BagOrigin& run) {
  if (!wanted.trace_file.empty()) {
    const auto detail = wanted.trace_values ? Trace::Detail::values : Trace::Detail::events;
    if (Status opened = trace_.open(wanted.trace_file, detail); !opened.ok()) return opened;
  }
  if (!wanted.picture.file.empty())
    if (Status opened = picture_.open(wanted.picture.file); !opened.ok()) return opened;
  return wanted.recordings.empty() ? ok() : recorder_.open(wanted.recordings, ports, run);
}

std::vector<Error> RunFiles::close() {
  std::vector<Error> errors;
  for (const Status& closed : {trace_.close(), picture_.close()})
    if (!closed.ok()) errors.push_back(closed.error());
  for (const Error& error : recorder_.close()) errors.push_back(error);
  return errors;
}

void RunFiles::close_at_once() {
  (void)trace_.close();
  (void)recorder_.close();
}

}  // namespace orca::host
