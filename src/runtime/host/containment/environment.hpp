// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "descriptor_watch.hpp"
#include "orca/base/activity.hpp"
#include "orca/host/alarm.hpp"
#include "watch.hpp"

namespace orca::host {

/// The state of the process and of its threads that no component may change: floating-point control, locale,
/// terminate handler, signal mask and handlers, working folder, umask, resource limits, standard streams, descriptors. When control leaves a
/// component, the watches compare this state with the reference and restore it. A change raises an alarm,
/// once per component and kind. If a component has closed the process's own descriptors, the process ends.
///
/// Floating-point control, locale and terminate handler are checked each time, because that costs next to nothing. The rest is
/// checked around configure(), start(), stop(), suspend() and resume(), and at a component's first two turns
/// and then every 64th. An alarm names a component only if no other one can have made the change. Otherwise
/// it says "one of", and from then on every turn is checked, so that a repeated change finds its author.
/// Where strands overlap, every component whose hook is not over can have changed the state of the process.
/// Only its own component can have changed the state of a thread.
///
/// Thread contract: keep() before the first strand starts and let_go() after the last one has ended; the rest
/// from the strands.
class Environment {
 public:
  static Environment& of_process();

  /// Records the present state as the reference.
  /// @param strands_overlap  whether two components can run at the same time.
  /// @param sink             takes the alarms, on the strand that raises them.
  void keep(bool strands_overlap, AlarmSink sink);
  void let_go();

  /// Makes the checks of entering() early, for a component whose code is about to be exchanged: if nothing but save_state()
  /// runs before its start(), that need not wait for them. Any thread.
  void look_ahead(const std::string& who);
  /// Notes that a hook of a component begins.
  void entering(const Activity& turn);
  /// Checks the state when a component or a hardware container gives up control to wait for something.
  void leaving(const Activity& turn);
  /// Checks the state after a hook; called instead of leaving().
  void left(const Activity& turn);
  /// Notes that the runtime itself opens descriptors, on a thread of its own: what is new until it has is nobody's. Any
  /// thread.
  void begin_own_opening() { ++opening_; }
  void end_own_opening() {
    ++own_openings_;
    --opening_;
  }
  enum class Fork { begins, is_over, is_over_in_copy };
  /// To be called around each fork(): one that a component calls in a hook is reported. A copy, such as the one where Orca tries code out,
  /// is not watched, and what another thread held does not stay held in it.
  /// @param turn  in which it is called; null: outside of all components.
  void at_fork(Fork moment, const Activity* turn);

 private:
  using Watches = std::vector<std::unique_ptr<Watch>>;
  struct Guest {
    std::string name;
    std::string hook;  // the last one
    std::uint64_t turns = 0;
    std::uint64_t last_turn = 0;  // its number among those of all guests
    int hooks_running = 0;
    bool had_turn = false;  // since the last full check
    DescriptorBalance balance;
    std::uint64_t others_turns = 0;  // turns that were over when the hook began
    std::uint64_t own_openings = 0;  // at that time
  };
  using Guests = std::vector<const Guest*>;
  // What look_ahead() has found, and what would make it out of date.
  struct Foresight {
    std::string who;
    Descriptors open;
    std::uint64_t turns;         // of all guests
    std::uint64_t own_openings;  // of the runtime
  };

  Environment();
  // Calls `body` unless let_go() was called, then raises the alarms for what it has found.
  template <class Body>
  void watched(Body&& body);
  Guest& guest(const Activity& turn);
  void begin_hook(Guest& guest);
  [[nodiscard]] bool may_be_suspect(const Guest& guest) const;
  void leave(Guest& guest, const Activity& turn);
  [[nodiscard]] bool is_due(const Guest& guest) const;
  // Returns the guests that can have changed the process since the last full check.
  [[nodiscard]] Guests suspects() const;
  // Returns the guests that can have changed the process since anybody's last turn.
  // @param leaver  the guest that gives up control; null: none does.
  [[nodiscard]] Guests suspects_of_turn(const Guest* leaver) const;
  [[nodiscard]] bool is_alone(const Guest& guest) const;
  // Returns the suspects for people: "bad: work()", "one of a, b".
  static std::string culprit(const Guests& possible);

  // Makes the checks of every turn.
  // @param leaver  the guest that gives up control; null: a guest enters.
  void look_each_turn(const Guest* leaver);
  void look_at_all(const Guest* leaver, bool may_open);
  void look_at_descriptors(const Guests& possible, bool may_open);
  void enter_rare(Guest& guest, Hook hook);
  [[nodiscard]] bool is_undisturbed() const { return hooks_running_ == 0 && opening_ == 0; }
  // Returns whether what was seen is so still, as a guest's hook begins.
  [[nodiscard]] bool holds(const Foresight& seen, const Guest& guest) const;
  void end_balance(Guest& guest, Hook hook);

  void accuse(const Guests& possible, const Finding& finding);
  void accuse_one(const Guest& guest, const Finding& finding);

  std::atomic<int> opening_{0};  // threads of the runtime that open descriptors now
  std::atomic<std::uint64_t> own_openings_{0};
  std::mutex mutex_;
  bool kept_ = false;
  bool strands_overlap_ = false;
  AlarmSink sink_;  // constant between keep() and let_go()
  Watches of_thread_each_turn_;
  Watches of_process_each_turn_;
  Watches of_thread_;
  Watches of_process_;
  DescriptorWatch descriptors_;
  std::optional<Foresight> foresight_;
  std::map<std::string, Guest, std::less<>> guests_;
  std::map<std::string_view, Guest*> active_;  // those of which may_be_suspect() holds: few of many
  std::uint64_t turns_ = 0;                    // of all guests
  int hooks_running_ = 0;                      // of all guests
  bool each_turn_ = false;                     // whether every turn is checked in full
  std::set<std::pair<std::string, AlarmKind>> said_;
  std::vector<idl::Alarm> found_;  // to be raised once the lock is released
};

/// A guard that keeps the process's environment during its own lifetime.
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
