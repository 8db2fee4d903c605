// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "orca/base/files/kept_file.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/navigation/slam.hpp"

namespace orca::slam {

/// The file that keeps a map from one run to the next, with all that is needed to go on with it: scans, poses and relations. PATH.old is what it was
/// before it was written last.
///
/// Thread contract: the component's strand.
class Session {
 public:
  /// Keeps to a file, and reads what is in it.
  /// @errors  unavailable if the file's folder cannot be written; those of KeptFile::read(), and data_loss, if there is a file that is no
  ///          session: with what to do.
  Status open(const std::string& path);
  [[nodiscard]] bool is_open() const { return file_.has_value(); }

  /// Returns the map of the runs before, once; nothing if there is none.
  [[nodiscard]] std::optional<nav::SlamMemory> take();

  /// Writes the map down, if it has grown since, and kPeriod has passed.
  /// @errors  those of KeptFile::write(), once; it tries again each time.
  Status keep(const nav::Slam& slam, TimePoint now);
  /// Writes the map down, if it has grown since.
  Status close(const nav::Slam& slam);

  static constexpr Duration kPeriod = std::chrono::minutes(1);

 private:
  std::optional<KeptFile> file_;
  std::optional<nav::SlamMemory> before_;
  std::size_t written_ = 0;  // nodes
  std::optional<TimePoint> since_;
  bool fails_ = false;
};

}  // namespace orca::slam
