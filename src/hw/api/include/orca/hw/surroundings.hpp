// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/idl/world.hpp"

namespace orca::hw {

/// The world around hardware that is simulated, seen from outside and changed while it runs. Real hardware has none. A container
/// that has one also derives from this class, and returns itself from HardwareContainer::surroundings().
///
/// Thread contract: any strand, while the hardware is Ready or Active.
class Surroundings {
 public:
  /// Fills in what never moves.
  virtual void fill_plan(idl::WorldPlan& plan) = 0;
  /// Fills in what moves, as it is now.
  virtual void fill_scene(idl::WorldScene& scene) = 0;
  /// Changes the world now.
  /// @return what has changed, for people.
  /// @errors  invalid_argument: no world can be changed so. not_found: it has no such thing. already_exists, failed_precondition:
  ///          something is in the way; the text says what.
  virtual Result<std::string> change(const idl::WorldChange& change) = 0;

 protected:
  Surroundings() = default;
  ~Surroundings() = default;
};

}  // namespace orca::hw
