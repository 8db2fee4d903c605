// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest component of docs/first_component.md.
// [hello]
#include "orca/component.hpp"

namespace {

/// Says hello once per second.
class Hello final : public orca::Component {
 public:
  explicit Hello(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::seconds(1)); }

 private:
  orca::Outcome work() override {
    log_info("hello");
    return orca::again();
  }
};

}  // namespace

ORCA_COMPONENT(Hello, "my.Hello")
// [/hello]
