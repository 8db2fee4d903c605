// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"

namespace orca::recording {
class ObjectSink;
}

namespace orca::host {

/// What a recording says of the run that it is of.
struct BagOrigin {
  std::string name;   ///< Of the graph.
  std::string graph;  ///< As graph::print() writes it.
  std::map<std::string, std::string>
      json;  ///< What the page shows of the system, by the names of attachments.
  std::map<std::string, std::string> more;  ///< "seed"
};

/// A recording of objects as an MCAP file, or as a log of CARMEN if its name ends so.
///
/// Thread contract: not synchronised.
class BagFile {
 public:
  explicit BagFile(std::string path);
  ~BagFile();

  /// @param ports  whose objects will come.
  /// @param at_once  time is virtual: the file depends on the run alone, and is written on the caller's thread.
  /// @errors  as recording::open_file().
  Status open(const BagOrigin& run, const std::vector<std::string>& ports, bool at_once);
  /// Adds an object. After an error nothing more is added; close() reports it.
  void add(const std::string& row, const ObjectRef& object, TimePoint passed);
  /// Writes what is left, and closes the file.
  /// @param lost  objects that were left out, by row.
  /// @param more  what is known of the run in the end.
  /// @errors  as Output::append().
  Status close(const std::map<std::string, std::uint64_t>& lost,
               const std::map<std::string, std::string>& more);

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  const std::string path_;
  std::unique_ptr<recording::ObjectSink> writer_;  // null: it is not open
  Status status_ = ok();
};

}  // namespace orca::host
