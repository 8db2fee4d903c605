// SPDX-License-Identifier: GPL-3.0-or-later
// Starts a thread that nobody ends. The constructor does it, so that describing it is enough. It wakes often, to be in
// code that is unmapped by mistake.
#include <unistd.h>

#include <thread>

#include "orca/component.hpp"

namespace {

class ThreadLeft final : public orca::Component {
 public:
  explicit ThreadLeft(orca::ComponentHost& host) : Component(host) {
    std::thread([] {
      for (;;) usleep(20);
    }).detach();
  }
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(ThreadLeft, "test.ThreadLeft")
