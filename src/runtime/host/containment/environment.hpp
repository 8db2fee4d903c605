// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "descriptor_watch.hpp"
#include "orca/base/activity.hpp"
#include "orca/host/alarm.hpp"
#include "watch.hpp"

namespace orca::host {

/// The state of the process and of its threads that no component may change: floating-point control, locale,
/// signal mask and handlers, working folder, umask, resource limits, descriptors. When control leaves a
/// component the watches compare it with what it was and put it back, and an alarm is raised, once per
/// component and kind. If a component has closed the process's own descriptors, the process ends.
///
/// Floating-point control and locale are looked at each time, because that costs next to nothing; the rest
/// around configure(), start(), stop(), suspend() and resume(), and at a component's first two and then each
/// 64th turn. An alarm names a component only if no other one can have done it. Else it says "one of", and
/// from then on each turn is looked at, so that whoever does it again is found. Where strands overlap, every
/// component whose hook is not over can have changed the state of the process; the state of a thread is its
/// component's alone.
///
/// Thread contract: keep() and let_go() before and after the strands live; the rest from the strands.
class Environment {
 public:
  static Environment& of_process();

  /// Records the present state as the reference.
  /// @param strands_overlap  whether two components can be at work at the same time.
  /// @param sink             takes the alarms, on the strand that raises them.
  void keep(bool strands_overlap, AlarmSink sink);
  void let_go();

  /// Before a hook of a component.
  void entering(const Activity& turn);
  /// When control leaves a component or a hardware container, because its code begins to wait for something.
  void leaving(const Activity& turn);
  /// After a hook, instead of leaving().
  void left(const Activity& turn);
  /// In the process that has called fork(), in a hook.
  void forked(const Activity& turn);

 private:
  using Watches = std::vector<std::unique_ptr<Watch>>;
  struct Guest {
    std::string name;
    std::string hook;  // the last one
    std::uint64_t turns = 0;
    int hooks_running = 0;
    bool had_turn = false;  // since everything was last looked at
    DescriptorBalance balance;
    std::uint64_t others_turns = 0;  // that were over when the hook began
  };
  using Guests = std::vector<const Guest*>;

  Environment();
  // Calls `body` unless let go, and then raises what it has found.
  template <class Body>
  void watched(Body&& body);
  Guest& guest(const Activity& turn);
  void begin_hook(Guest& guest);
  void leave(Guest& guest, const Activity& turn);
  [[nodiscard]] bool is_due(const Guest& guest) const;
  // Who can have changed the process since everything was last looked at.
  [[nodiscard]] Guests suspects() const;
  // Who can have changed the process since the last turn of anybody; null: nobody leaves.
  [[nodiscard]] Guests suspects_of_turn(const Guest* leaver) const;
  [[nodiscard]] bool is_alone(const Guest& guest) const;
  // "bad: work()", "one of a, b".
  static std::string culprit(const Guests& possible);

  // Who leaves; null: somebody enters.
  void look_each_turn(const Guest* leaver);
  void look_at_all(const Guest* leaver, bool may_open);
  void look_at_descriptors(const Guests& possible, bool may_open);
  void begin_balance(Guest& guest, Hook hook);
  void end_balance(Guest& guest, Hook hook);

  void accuse(const Guests& possible, const Finding& finding);
  void accuse_one(const Guest& guest, const Finding& finding);

  std::mutex mutex_;
  bool kept_ = false;
  bool strands_overlap_ = false;
  AlarmSink sink_;  // constant while kept
  Watches of_thread_each_turn_;
  Watches of_process_each_turn_;
  Watches of_thread_;
  Watches of_process_;
  DescriptorWatch descriptors_;
  std::map<std::string, Guest, std::less<>> guests_;
  std::uint64_t turns_ = 0;  // of all guests
  int hooks_running_ = 0;    // of all guests
  bool each_turn_ = false;   // everything is looked at
  std::set<std::pair<std::string, AlarmKind>> said_;
  std::vector<idl::Alarm> found_;  // still to be raised, without the lock
};

/// Keeps the process's environment as long as it lives.
class KeptEnvironment {
 public:
  KeptEnvironment(bool strands_overlap, AlarmSink sink) {
    Environment::of_process().keep(strands_overlap, std::move(sink));
  }
  ~KeptEnvironment() { Environment::of_process().let_go(); }
  KeptEnvironment(const KeptEnvironment&) = delete;
  KeptEnvironment& operator=(const KeptEnvironment&) = delete;
};

}  // namespace orca::host
