// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "orca/component.hpp"

namespace {

/// Never waits for anything: either one lap without an end, or lap after lap without a pause.
class Hog final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Outcome work() override {
    volatile bool forever = *how_ == "one_lap";
    while (forever) {
    }
    return orca::again();
  }

  orca::Param<std::string> how_{*this, "how", "one_lap", {.choices = {"one_lap", "many_laps"}}};
};

}  // namespace

ORCA_COMPONENT(Hog, "test.Hog")
