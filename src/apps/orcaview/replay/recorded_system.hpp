// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::view {

/// A recorded system: what its supervisor and its ports would have said at some time. Only the chunks that are needed are opened, so
/// a large file takes no more memory than a small one.
///
/// Thread contract: constant; any thread.
class RecordedSystem {
 public:
  using Stamp = recording::Stamp;

  /// @errors  as ObjectReader::open(); failed_precondition if nothing was recorded.
  [[nodiscard]] static Result<RecordedSystem> open(const std::string& path);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Stamp begin() const { return reader_.file().statistics().start; }
  [[nodiscard]] Stamp end() const { return reader_.file().statistics().end; }

  /// Returns the graph and the ports, as `orcactl graph --json` and `orcactl ports --json` print them. If the recording does not
  /// have them, they are made up from the ports that are recorded, without connections.
  [[nodiscard]] const std::string& graph() const { return graph_; }
  [[nodiscard]] const std::string& ports() const { return ports_; }
  /// Returns the rows of `ps`.
  [[nodiscard]] std::vector<supervisor::Record> components() const;
  /// Returns the rows of `alarms` at a time: what was raised last of each, as far as it is not cleared.
  [[nodiscard]] std::vector<supervisor::Record> alarms(Stamp now) const;
  /// Returns the rows of `log` of a span of time, the newest kMostLines at most.
  /// @param who  components, hardware or processes; empty: all.
  [[nodiscard]] std::vector<supervisor::Record> log(Stamp from, Stamp to,
                                                    const std::set<std::string>& who) const;
  /// Returns the newest rows of `log` at a time. A long recording is not read as a whole; where lines may be left out, the first row says so.
  [[nodiscard]] std::vector<supervisor::Record> newest_log(Stamp now, const std::set<std::string>& who) const;
  static constexpr std::size_t kMostLines = 2000;

  /// Returns the row in which the objects of a port are recorded: its own, or that of what is connected to it; empty: none.
  [[nodiscard]] std::string row_of(const std::string& port) const;
  /// Returns the type of the objects of a row.
  [[nodiscard]] std::string type_of(const std::string& row) const;
  /// Returns the last object of a row that had passed at a time; nothing if there is none, or if it is far back in a file without
  /// an index.
  [[nodiscard]] std::optional<supervisor::Tapped> last(const std::string& row, Stamp now) const;
  /// Passes on what has passed in some rows, from one time to another one, both included.
  /// @param take  returns false to end.
  Status pass(
      const std::set<std::string>& rows, Stamp from, Stamp to,
      const std::function<bool(const std::string& row, const supervisor::Tapped& passed)>& take) const;

 private:
  struct Source {
    std::string row;
    std::string type;
  };
  struct AlarmChange {
    Stamp time;
    std::string key;                        // what identifies the alarm
    std::optional<supervisor::Record> row;  // nothing: it is cleared
  };
  explicit RecordedSystem(recording::ObjectReader reader) : reader_(std::move(reader)) {}
  void find_sources();
  void read_structure();
  void read_alarms();
  [[nodiscard]] Stamp log_begin(Stamp now) const;
  void make_up_structure();
  [[nodiscard]] supervisor::Tapped tapped(const recording::Message& message) const;
  [[nodiscard]] std::set<std::uint16_t> channels_of(const std::set<std::string>& rows) const;

  recording::ObjectReader reader_;
  std::string name_;
  std::string graph_;
  std::string ports_;
  std::map<std::uint16_t, Source> sources_;                    // by channel
  std::map<std::string, std::vector<std::string>> connected_;  // to a port
  std::vector<AlarmChange> alarm_changes_;                     // in order
};

}  // namespace orca::view
