// SPDX-License-Identifier: GPL-3.0-or-later
// Changes what all share while it is loaded.
#include <sys/stat.h>
#include <unistd.h>

#include "orca/component.hpp"

namespace {

const bool g_is_rude = [] {
  umask(0777);
  return chdir("/") == 0;
}();

class Rude final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return g_is_rude ? orca::done() : orca::again(); }
};

}  // namespace

ORCA_COMPONENT(Rude, "test.Rude")
