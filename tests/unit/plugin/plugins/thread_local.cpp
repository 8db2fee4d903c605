// SPDX-License-Identifier: GPL-3.0-or-later
// A thread_local variable with a destructor keeps a library in memory.
#include <string>

#include "orca/component.hpp"

namespace {

thread_local std::string remembered = "long enough not to fit into the string object itself";

}  // namespace

namespace {

class Remembers final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::failed(remembered += '.'); }
};

}  // namespace

ORCA_COMPONENT(Remembers, "test.Remembers")
