// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "decide.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_watch.hpp"
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

/// The ear of the fuser. It takes over what a behaviour says, unless that is nothing valid, and asks once about what no robot can
/// carry out.
class Ear {
 public:
  /// @param host  of the fuser; it must outlive this.
  explicit Ear(const PluginHost& host) : host_(host), senders_(host) {}

  /// Takes over a command. One that says nothing valid counts as none: the behaviour has fallen silent.
  /// @param limit [s]  silence of the behaviour that stops the robot.
  void take(Listened& behaviour, const ObjectPtr<idl::MotionCommand>& newest, double limit);

  /// Takes note of how long it has waited for a moment. Half a second means that the process got no processor: it says so.
  void note_wait(Duration waited);

 private:
  void ask_about(const std::string& behaviour, const idl::MotionCommand& command);

  const PluginHost& host_;
  SenderWatch senders_;
  std::set<std::string> asked_;  // Behaviours.
  std::optional<TimePoint> starved_at_;
};

/// Returns what kind of thing a behaviour has said.
[[nodiscard]] Voice::Said said(const idl::MotionCommand& command);

/// Returns the wish that a command holds, at most as fast as doubt_about() believes.
[[nodiscard]] Wish wish_of(const ObjectPtr<idl::MotionCommand>& command);

/// Returns the command that a decision makes: a full stop, unless it is a wish.
[[nodiscard]] Loan<idl::MotionCommand> command_of(const Decision& decision, double steer_gain);

/// Says what a behaviour had to do with a decision.
/// @param share [1]  of its wish in the command.
void describe(const Voice& said, const Listened& behaviour, double share, idl::FusionVoice& voice);

}  // namespace orca::fuse
