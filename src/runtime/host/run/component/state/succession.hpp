// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/mutex.hpp"
#include "state_hooks.hpp"

namespace orca::host {

/// How an object has taken another one's place.
struct TakeOver {
  Duration pause{0};  ///< Time during which neither of them could work [s of the run's clock].
  /// The state that went from the old object to the new one; nothing: the new one began afresh.
  std::optional<StateTag> state;
};

/// How many of the last laps took longer than their period.
///
/// Thread contract: one thread.
class LateLaps {
 public:
  static constexpr std::size_t kWindow = 200;  ///< Laps that count.

  void note(bool is_late) {
    count_ += static_cast<std::size_t>(is_late) - static_cast<std::size_t>(late_[next_]);
    late_[next_] = is_late;
    next_ = (next_ + 1) % kWindow;
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::bitset<kWindow> late_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

/// The exchange of one component's object for another one while the component runs, and the way back. The old object keeps
/// its state, and goes on with it if the new one fails before confirm().
///
/// Thread contract: confirm() and take_back_reason() from anywhere, the rest on the component's strand.
class Succession {
 public:
  Succession(ComponentParts& parts, Residency& residency)
      : parts_(parts), residency_(residency), hooks_(parts, residency) {}

  /// Lets the object save its state and load it again, as its next version would: otherwise none could follow it.
  /// @errors  what its hooks say or throw.
  Status check_state(ComponentState state);
  /// Puts the successor's object in the place of the present one, with its state, and starts it if the component works. The
  /// present object goes to the successor, which must live until confirm().
  /// @param fresh  the new object begins without the state of the old one, which is not asked for it.
  /// @param state  of the component: idle, at work or suspended; or one in which the present object has failed, whose state is
  ///               then of no use.
  /// @errors  what the new object's hooks say or throw; failed_precondition if it cannot read the state. Everything is then
  ///          as before.
  Status take_over(Residency& successor, ComponentState state, bool fresh, TakeOver& report);
  /// Ends the time in which the old object may come back.
  /// @return false if it is just coming back; take_back_reason() says why as soon as it is there.
  bool confirm();

  /// Notes how long a lap has taken. Brings the old object back if too many laps of the new one have taken longer than their
  /// period, before confirm(): three more than twice as many as of the old one's last laps, since on a busy machine any lap may.
  /// @return whether it is back.
  bool judge_lap(ComponentState state, TimePoint began) {
    return is_too_slow(began) && take_back(state, too_slow_text());
  }

  /// Puts the old object back, if confirm() has not been called.
  /// @param why  the new one failed, for people.
  /// @return whether the old object is there now.
  bool take_back(ComponentState state, const std::string& why);
  /// Returns why the old object is back; nothing if it is not.
  [[nodiscard]] std::optional<std::string> take_back_reason() const;

 private:
  Status enter(ComponentState state, const std::optional<KeptState>& saved, TakeOver& report);
  Status load(const KeptState& saved, TakeOver& report);
  Status start();
  void seat(ComponentState state);
  void catch_up(ComponentState state);
  void pause_as(ComponentState state);
  Status pause();
  [[nodiscard]] Residency* leave_predecessor();
  bool is_too_slow(TimePoint began);
  [[nodiscard]] std::string too_slow_text() const;

  ComponentParts& parts_;
  Residency& residency_;
  StateHooks hooks_;
  LateLaps late_laps_;                                     // of the present object
  std::size_t allowed_late_laps_ = LateLaps::kWindow + 1;  // of the new object on probation
  mutable Mutex mutex_;
  Residency* predecessor_ ORCA_GUARDED_BY(mutex_) =
      nullptr;  // holds the old object; null: there is no way back
  bool is_going_back_ ORCA_GUARDED_BY(mutex_) = false;
  std::optional<std::string> taken_back_ ORCA_GUARDED_BY(mutex_);
};

}  // namespace orca::host
