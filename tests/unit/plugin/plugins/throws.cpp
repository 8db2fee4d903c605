// SPDX-License-Identifier: GPL-3.0-or-later
// Constructors that throw.
#include <stdexcept>

#include "orca/component.hpp"

namespace {

// Its own class: the text must be copied before the plugin is unloaded.
class Smoke final : public std::runtime_error {
 public:
  Smoke() : runtime_error("the constructor smokes") {}
};

class Throws final : public orca::Component {
 public:
  explicit Throws(orca::ComponentHost& host) : Component(host) { throw Smoke(); }
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Throws, "test.Throws")
