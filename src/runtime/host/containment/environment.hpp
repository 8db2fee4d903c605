// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <signal.h>
#include <sys/resource.h>
#include <sys/types.h>

#include <array>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "descriptors.hpp"
#include "growth.hpp"
#include "orca/base/activity.hpp"

namespace orca::host {

/// What belongs to the whole process or to a thread, and what no component may therefore change:
/// floating-point control, locale, signal mask and handlers, working folder, umask, resource limits,
/// descriptors, memory. Looks whether it is as it was when control leaves a component, puts it back, and
/// raises an alarm in the log that names component and hook, once per component and kind. Of a component that
/// closes the process's own descriptors the process ends.
///
/// Floating-point control and locale are looked at each time, because that costs next to nothing; the rest
/// around configure(), start() and stop() and at a component's first two and then each 64th turn. If several
/// components had a turn since the last look, the alarm names them all, and the next turns are looked at one
/// by one. Memory that grows much within few turns is told likewise; what a component takes in the hooks that
/// run once is its good right.
///
/// Thread contract: keep() and let_go() before and after the strands live; the rest from the strands.
class Environment {
 public:
  static Environment& of_process();

  /// From now on, what is now is what must be.
  void keep();
  void let_go();

  /// Before a hook.
  void entering(const Activity& turn);
  /// When control leaves a component, because a hook is over or begins to wait for something.
  void leaving(const Activity& turn);
  /// After a hook, instead of leaving().
  void left(const Activity& turn);

 private:
  struct Limit {
    int resource;
    const char* name;
    rlimit value;
  };
  struct Handler {
    int signal;
    struct sigaction action;
  };
  // Descriptors around start() and stop().
  struct Balance {
    Descriptors at_begin;  // of the hook
    Descriptors opened;    // in the hooks so far, and not closed since
    std::uint64_t turn = 0;
    std::uint64_t others_turns = 0;  // that were over when the hook began
    bool sound = true;               // nobody else had a turn meanwhile, as far as can be told
  };
  struct Guest {
    std::string name;
    std::string hook;  // the last one
    std::uint64_t turns = 0;
    bool suspect = false;  // had a turn since all was last looked at
    Balance balance;
  };

  Guest& guest(const Activity& turn);
  [[nodiscard]] bool is_due(Guest& guest);
  [[nodiscard]] std::vector<const Guest*> suspects() const;

  void look_at_cheap(const Guest& guest);
  void look_at_all(bool rare);
  void look_at_signals();
  void look_at_files();
  void look_at_limits();
  void look_at_descriptors(bool rare);
  void look_at_memory(bool rare);
  void begin_balance(Guest& guest);
  void end_balance(Guest& guest);

  void alarm(const Guest& guest, const char* kind, const std::string& deed);
  void alarm_suspects(const char* kind, const std::string& deed);
  /// "bad: work()", or all that it may have been.
  [[nodiscard]] std::string culprit() const;

  std::mutex mutex_;
  bool kept_ = false;
  std::uint32_t floating_point_ = 0;
  std::string locale_;
  sigset_t signal_mask_{};
  std::vector<Handler> handlers_;
  std::string folder_;
  mode_t umask_ = 0;
  std::vector<Limit> limits_;
  OwnDescriptors own_;
  Growth open_;
  Growth memory_;
  bool memory_watched_ = false;
  bool exhausted_ = false;  // there are no descriptors left
  std::vector<Guest> guests_;
  std::uint64_t turns_ = 0;  // of all guests
  std::uint64_t rare_turns_ = 0;
  int rare_running_ = 0;
  int watchful_turns_ = 0;  // left to be looked at one by one
  std::set<std::pair<std::string, std::string>> said_;
};

/// Keeps the process's environment as long as it lives.
class KeptEnvironment {
 public:
  KeptEnvironment() { Environment::of_process().keep(); }
  ~KeptEnvironment() { Environment::of_process().let_go(); }
  KeptEnvironment(const KeptEnvironment&) = delete;
  KeptEnvironment& operator=(const KeptEnvironment&) = delete;
};

}  // namespace orca::host
