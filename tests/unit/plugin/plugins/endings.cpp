// SPDX-License-Identifier: GPL-3.0-or-later
// Has functions of its own called when the process or one of its threads ends.
#include <pthread.h>

#include <cstdlib>

#include "orca/component.hpp"

namespace {

class Leaver final : public orca::Component {
 public:
  explicit Leaver(orca::ComponentHost& host) : Component(host) {
    on_exit([](int /*status*/, void* /*nothing*/) {}, nullptr);
    pthread_key_t key{};
    pthread_key_create(&key, [](void* /*value*/) {});
  }
  orca::Outcome work() override { return orca::done(); }
};

}  // namespace

ORCA_COMPONENT(Leaver, "test.Leaver")
