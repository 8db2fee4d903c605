// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/idl/object.hpp"

namespace orca::orcactl {

/// The identity of an object: the port that it has left through, and its number there.
struct ObjectId {
  std::string port;  ///< "component.port"; empty: no object.
  std::uint64_t seq = 0;
  auto operator<=>(const ObjectId&) const = default;
};

[[nodiscard]] ObjectId id_of(const idl::OrcaObject& object);
[[nodiscard]] ObjectId cause_of(const idl::OrcaObject& object);

/// The causes of objects that were seen, so that an answer can be followed back to the reading that it began with.
/// Only the latest objects are kept.
///
/// Thread contract: not synchronised.
class Causes {
 public:
  static constexpr std::size_t kMostObjects = 100'000;

  /// Notes an object at which a way begins.
  /// @param sensed  when its data were sensed [ns].
  void note_beginning(const ObjectId& object, std::uint64_t sensed);
  void note(const ObjectId& object, const ObjectId& cause);

  struct Way {
    std::vector<std::string>
        ports;  ///< From the first object to the last one. It is short if a cause was not seen.
    std::optional<std::uint64_t>
        sensed;            ///< When the data of the first one were sensed [ns]; nothing: it is no beginning.
    bool complete = true;  ///< Whether the cause of each was seen.
    /// Returns the way for people: "base.OdometryPush > avoid.motion", with "?" for a cause that was not seen.
    [[nodiscard]] std::string text() const;
  };
  /// Follows an object back to a beginning, or to an object without a cause.
  [[nodiscard]] Way way_to(ObjectId object) const;

 private:
  struct Known {
    ObjectId cause;
    std::optional<std::uint64_t> sensed;
  };
  void keep(const ObjectId& object, Known known);

  std::map<ObjectId, Known> known_;
  std::deque<ObjectId> order_;  // oldest first
};

}  // namespace orca::orcactl
