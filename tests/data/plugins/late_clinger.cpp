// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <string>

#include "orca/component.hpp"

namespace {

/// A component whose constructor hangs from the second time on in one process: not in a trial, which is a
/// process of its own.
class LateClinger final : public orca::Component {
 public:
  explicit LateClinger(orca::ComponentHost& host) : Component(host) {
    static int constructed = 0;
    if (++constructed == 1) return;
    for (volatile bool forever = true; forever;) pause();
  }

 private:
  orca::Outcome work() override { return orca::again(); }

  orca::Param<std::string> where_{*this, "where", "constructor"};
};

}  // namespace

ORCA_COMPONENT(LateClinger, "test.LateClinger")
