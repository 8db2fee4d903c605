// SPDX-License-Identifier: GPL-3.0-or-later
// Gives standard streams what goes with its code: a buffer when it is loaded, the rest when its component is made.
#include <iostream>
#include <locale>
#include <sstream>

#include "orca/component.hpp"

namespace {

class Comma final : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

std::stringbuf g_buffer;
std::ostringstream g_stream;
const bool g_is_rude = std::cout.rdbuf(&g_buffer) != nullptr;

class RudeStreams final : public orca::Component {
 public:
  explicit RudeStreams(orca::ComponentHost& host) : Component(host) {
    std::cin.tie(&g_stream);
    std::cerr.imbue(std::locale(std::locale(), new Comma));
  }
  orca::Outcome work() override { return g_is_rude ? orca::done() : orca::again(); }
};

}  // namespace

ORCA_COMPONENT(RudeStreams, "test.RudeStreams")
