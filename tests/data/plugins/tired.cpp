// SPDX-License-Identifier: GPL-3.0-or-later
// A component whose constructor or destructor goes well some times, and then no more:
//   TIRED_CONSTRUCTION  the construction that does not return; 0: none
//   TIRED_DESTRUCTION   the destruction that crashes; 0: none
#include <signal.h>
#include <unistd.h>

#include "orca/component.hpp"

#ifndef TIRED_CONSTRUCTION
#define TIRED_CONSTRUCTION 0
#endif
#ifndef TIRED_DESTRUCTION
#define TIRED_DESTRUCTION 0
#endif

namespace {

int g_constructions = 0;
int g_destructions = 0;

/// Does nothing. If it is told so, its destructor does not return.
class Tired final : public orca::Component {
 public:
  explicit Tired(orca::ComponentHost& host) : Component(host) {
    lap_every(orca::from_seconds(0.1));
    while (++g_constructions == TIRED_CONSTRUCTION) rest();
  }
  ~Tired() override {
    if (++g_destructions == TIRED_DESTRUCTION) raise(SIGSEGV);
    if (*rests_) rest();
  }

 private:
  static void rest() {
    for (;;) ::sleep(1);
  }
  orca::Outcome work() override { return orca::again(); }

  orca::Param<bool> rests_{*this, "rests", false};
};

}  // namespace

ORCA_COMPONENT(Tired, "test.Tired")
ORCA_ALLOW_IN_VIRTUAL_TIME("sleep", "it is what is tested")
