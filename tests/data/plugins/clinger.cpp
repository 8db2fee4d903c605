// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>

#include "orca/component.hpp"

namespace {

void hang() {
  for (volatile bool forever = true; forever;) pause();
}

bool g_hangs_when_unloaded = false;

struct HangsWhenUnloaded {
  ~HangsWhenUnloaded() {
    if (g_hangs_when_unloaded) hang();
  }
};
const HangsWhenUnloaded g_last;

/// A component that hangs when nobody expects it any more. A trial does not show it, because a trial does not
/// configure anything.
class Clinger final : public orca::Component {
 public:
  explicit Clinger(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(50)); }
  ~Clinger() override {
    if (hangs_) hang();
  }

 private:
  orca::Status configure() override {
    hangs_ = *where_ == "destructor";
    g_hangs_when_unloaded = *where_ == "static";
    if (*where_ == "atexit") std::atexit(hang);
    return orca::ok();
  }
  orca::Outcome work() override { return orca::again(); }

  orca::Param<std::string> where_{*this, "where", "destructor"};
  bool hangs_ = false;
};

}  // namespace

ORCA_COMPONENT(Clinger, "test.Clinger")
