// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <string>

#include "orca/component.hpp"

namespace {

/// The innocent neighbour: works by itself, a lap each 100 ms, and is done after `laps` of them.
class LapCounter final : public orca::Component {
 public:
  explicit LapCounter(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(100));
  }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    ++count_;
    if (count_ < *laps_) return orca::again();
    log_info("counted " + std::to_string(count_) + " laps");
    return orca::done();
  }

  orca::Param<std::int64_t> laps_{*this, "laps", 10, {.min = 1}};
  std::int64_t count_ = 0;
};

}  // namespace

ORCA_COMPONENT(LapCounter, "test.LapCounter")
