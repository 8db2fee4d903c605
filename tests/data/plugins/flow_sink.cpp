// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Tells in the log when an object has come through other processes than the one before: "flow SOURCE RELAY SINK at
/// SECONDS", of the steady clock, which all processes of the machine share.
class FlowSink final : public orca::Component {
 public:
  explicit FlowSink(orca::ComponentHost& host) : Component(host) { lap_on("in"); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto object = in_.get_update();
    const std::string way = number(object->x()) + " " + number(object->y()) + " " + number(getpid());
    if (way != way_) log_info("flow " + way + " at " + std::to_string(seconds_now()));
    way_ = way;
    return orca::again();
  }

  static std::string number(double process) { return std::to_string(static_cast<std::int64_t>(process)); }
  static double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  orca::PushProxy<orca::idl::Odometry> in_{*this, "in"};
  std::string way_;
};

}  // namespace

ORCA_COMPONENT(FlowSink, "test.FlowSink")
