// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "voice.hpp"

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
  bool talks_nonsense = false;  ///< Its last message counts as none.
};

/// The behaviours that had fallen silent when the fuser listened to them last. They stay unreliable until they are heard
/// in time again, whatever client lists come in between.
class Lost {
 public:
  /// Notes the behaviours that the fuser will no longer listen to.
  void remember(const std::vector<Listened>& behaviours) {
    for (const Listened& behaviour : behaviours) {
      std::erase_if(lost_, [&](const Listened& lost) { return lost.source == behaviour.source; });
      if (behaviour.reliance.is_lost()) lost_.push_back(behaviour);
    }
  }
  [[nodiscard]] Reliance reliance_of(const MotionPort::Source& source) const {
    for (const Listened& lost : lost_)
      if (lost.source == source) return lost.reliance;
    return {};
  }

 private:
  std::vector<Listened> lost_;
};

}  // namespace orca::fuse
