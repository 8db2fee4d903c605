// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "reliance.hpp"

namespace orca::fuse {

using MotionPort = PushProxyArray<idl::MotionCommand>;

/// A behaviour that the fuser listens to, and its last messages.
struct Listened {
  MotionPort::Source source;
  std::string name;
  TimePoint since{};  ///< When the fuser began to listen to it.
  ObjectPtr<idl::MotionCommand> last = {};
  ObjectPtr<idl::MotionCommand> last_wish = {};  ///< Opinions only.
  Reliance reliance = {};
};

}  // namespace orca::fuse
