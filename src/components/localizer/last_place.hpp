// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "orca/base/files/kept_file.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/navigation/particles.hpp"
#include "orca/planning/floor.hpp"

namespace orca::localizer {

/// The place where the robot was last, which a file in the user's state folder keeps from one run to the next, with the map that it is a
/// place of.
///
/// Thread contract: the component's strand.
class LastPlace {
 public:
  /// Takes over what an earlier run has kept under a name, and keeps what follows under it.
  /// @errors  unavailable if there is no folder for it: then nothing is kept. data_loss and those of KeptFile::read() if what was
  ///          kept cannot be read: then it is left out.
  Status open(const std::string& name);
  /// Leaves out what an earlier run has kept: something else says where the robot is.
  void forget() { before_.reset(); }

  /// Returns whether an earlier run has kept a place that nobody has taken yet.
  [[nodiscard]] bool waits() const { return before_.has_value(); }
  /// Takes that place, wider by how far somebody may have pushed the robot since: in the frame of the map.
  /// @pre  waits()
  /// @errors  failed_precondition if it is a place of another map.
  [[nodiscard]] Result<nav::PoseSpread> take(const planning::Floor& floor);

  /// Says that the floor has changed.
  void change_map() {
    map_.reset();
    latest_.reset();
  }
  /// Keeps a place, at most once a second, if the robot has moved by 0.1 m or 0.1 rad.
  /// @param where  in the frame of the map.
  /// @errors  those of KeptFile::write(), once; it tries again each time.
  Status keep(const planning::Floor& floor, const nav::PoseSpread& where, TimePoint now);
  /// Writes down the place that was given to keep() last.
  Status close(const planning::Floor& floor);

 private:
  struct Kept {
    std::string map_name;
    std::uint64_t map = 0;
    nav::PoseSpread where;
  };

  [[nodiscard]] std::uint64_t map_of(const planning::Floor& floor);
  Status write(const planning::Floor& floor);

  std::optional<KeptFile> file_;
  std::optional<Kept> before_;
  std::optional<std::uint64_t> map_;       // the hash of the floor that is there now
  std::optional<nav::PoseSpread> latest_;  // that keep() was given
  std::optional<nav::PoseSpread> written_;
  TimePoint written_at_{};
  bool fails_ = false;
};

}  // namespace orca::localizer
