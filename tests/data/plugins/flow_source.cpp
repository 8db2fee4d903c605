// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"

namespace {

using SteadyClock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Pushes an object each 10 ms, with the number of its process in x. At its end it tells how its laps came.
class FlowSource final : public orca::Component {
 public:
  explicit FlowSource(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(10));
  }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto now = SteadyClock::now();
    if (laps_++ > 0) longest_ = std::max(longest_, Seconds(now - last_));
    last_ = now;
    auto object = out_.loan();
    object->x(getpid());
    out_.push(std::move(object));
    return orca::again();
  }

  void stop() override {
    log_info("laps " + std::to_string(laps_) + " longest " + std::to_string(longest_.count()));
  }

  orca::PushServer<orca::idl::Odometry> out_{*this, "out"};
  std::int64_t laps_ = 0;
  SteadyClock::time_point last_;
  Seconds longest_{0};
};

}  // namespace

ORCA_COMPONENT(FlowSource, "test.FlowSource")
