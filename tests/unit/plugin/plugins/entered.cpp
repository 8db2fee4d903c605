// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves ways into its code and its data behind.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "orca/component.hpp"

namespace {

char g_variable[] = "ORCA_TEST_ENTERED=yes";
char g_buffer[BUFSIZ];

class Entered final : public orca::Component {
 public:
  explicit Entered(orca::ComponentHost& host) : Component(host) {
    std::signal(SIGUSR2, [](int /*signal*/) {});
    std::set_new_handler([] { std::abort(); });
    putenv(g_variable);
    std::setvbuf(stdout, g_buffer, _IOFBF, sizeof g_buffer);
  }
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Entered, "test.Entered")
