// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "bag_file.hpp"
#include "orca/base/executive.hpp"
#include "orca/base/log.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/host/run_outputs.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/system.hpp"

namespace orca::host {

/// A writer of the objects that pass through chosen ports, into CSV and MCAP files: what a PushServer pushes, what a SendProxy
/// sends, and what arrives at any other port. An MCAP file also has the log and the alarms.
///
/// In virtual time it writes at once, so that a file depends on the run alone. In real time a thread of its own
/// writes, and no component waits for it: while kMostWaiting objects wait to be written, further ones are left
/// out and counted.
///
/// Thread contract: open() before the strands run; the rest from any thread.
class Recorder {
 public:
  static constexpr std::size_t kMostWaiting = 4096;

  explicit Recorder(const Executive& executive);
  /// Closes the files.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Opens the files. To be called once.
  /// @param ports  all ports of the graph; those that are recorded are among them.
  /// @errors  as OutputFile::open(), and as recording::open_file().
  Status open(const std::vector<RecordingOptions>& files, const std::vector<graph::ListedPort>& ports,
              const BagOrigin& run = {});

  /// Returns whether what leaves through a port of a PushServer is recorded.
  [[nodiscard]] bool records_pushes(std::string_view component, std::string_view port) const;
  /// Take an object that leaves through, or arrives at, a port. They ignore ports that are not recorded.
  void pushed(std::string_view component, std::string_view port, const ObjectRef& object);
  void requested(std::string_view component, std::string_view port, const ObjectRef& object);
  void delivered(std::string_view component, std::string_view port, const ObjectRef& object);

  /// Takes an alarm that was raised or cleared.
  void alarmed(const idl::Alarm& alarm);
  /// Sets what is known of the run in the end: "trace-hash".
  void conclude(std::map<std::string, std::string> facts);

  /// Writes what is left and closes the files. It does not wait for a pipe whose reader is stuck; the rest is
  /// lost then.
  /// @return what could not be written: for each file the first failure, or the number of objects left out.
  [[nodiscard]] std::vector<Error> close();

 private:
  class Desk;

  // Shared with the thread that writes, which may be stuck when this recorder goes.
  const std::shared_ptr<Desk> desk_;
  std::optional<log::Listener> log_;  // if a file has the log
};

}  // namespace orca::host
