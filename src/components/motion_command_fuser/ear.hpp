// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>

#include "listened.hpp"
#include "orca/component/sender_watch.hpp"
#include "voice.hpp"

namespace orca::fuse {

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
[[nodiscard]] Wish wish_of(const idl::MotionCommand& command);

}  // namespace orca::fuse
