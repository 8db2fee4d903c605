// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "orca/idl/object.hpp"

namespace orca {

/// The life of the sender whose objects a port brings. A component that was lost with its process and was started again counts its
/// objects from the beginning. Its knowledge is lost, too: odometry then counts from another place.
///
/// Thread contract: as the component.
class SenderLife {
 public:
  /// Returns whether the sender of this object has started again since the object before. An object that comes twice, or from
  /// another sender, shows nothing.
  /// @pre  called with each object that is taken, in their order.
  bool begins_anew(const idl::OrcaObject& object) {
    const bool anew = object.origin() == sender_ && object.seq() < last_;
    sender_ = object.origin();
    last_ = object.seq();
    return anew;
  }

  /// Returns all of it, to be passed on to an object that takes the place of the component's.
  auto state() { return std::tie(sender_, last_); }

 private:
  std::string sender_;
  std::uint64_t last_ = 0;
};

}  // namespace orca
