// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/output_file.hpp"
#include "orca/text/object_table.hpp"

namespace orca::host {

/// A CSV file that grows by a line per object. The first lines are held back until every port has had an object,
/// but not more than kMostHeld of them, because they decide how many columns a sequence has.
///
/// Thread contract: not synchronised.
class TableFile {
 public:
  static constexpr std::size_t kMostHeld = 1000;

  /// @param start  beginning of the run, from which on the file counts its seconds.
  TableFile(std::string path, TimePoint start)
      : path_(std::move(path)), output_("the recording"), table_(start) {}

  /// Adds a port whose objects will come. All ports must be added before the first object.
  void add_port(const std::string& port, const ObjectType& type);

  /// @errors  as OutputFile::open().
  Status open();

  void add(const std::string& port, ObjectRef object);

  /// Writes what was held back, and closes the file. A file without objects has the line of its columns.
  /// @errors  as OutputFile::close().
  Status close();

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  void begin();

  const std::string path_;
  OutputFile output_;
  ObjectTable table_;
  std::set<std::string> silent_;  // ports that have had no object yet
  bool begun_ = false;            // the columns are fixed
  std::vector<std::pair<const std::string*, ObjectRef>> held_;
};

}  // namespace orca::host
