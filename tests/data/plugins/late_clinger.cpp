// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/stat.h>
#include <unistd.h>

#include <string>

#include "orca/component.hpp"

namespace {

// In a trial, which is a process of its own, standard output leads nowhere.
bool is_trial() {
  struct stat out {};
  struct stat null {};
  return fstat(STDOUT_FILENO, &out) == 0 && stat("/dev/null", &null) == 0 && out.st_rdev == null.st_rdev;
}

/// A component whose constructor hangs from the second time on in one process, but not in a trial.
class LateClinger final : public orca::Component {
 public:
  explicit LateClinger(orca::ComponentHost& host) : Component(host) {
    static int constructed = 0;
    if (++constructed == 1 || is_trial()) return;
    for (volatile bool forever = true; forever;) pause();
  }

 private:
  orca::Outcome work() override { return orca::again(); }

  orca::Param<std::string> where_{*this, "where", "constructor"};
};

}  // namespace

ORCA_COMPONENT(LateClinger, "test.LateClinger")
