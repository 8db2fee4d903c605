// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Passes each object of test.FlowSource on, with the number of its own process in y.
class FlowRelay final : public orca::Component {
 public:
  explicit FlowRelay(orca::ComponentHost& host) : Component(host) { lap_on("in"); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    auto object = out_.loan();
    object->x(in_.get_update()->x());
    object->y(getpid());
    out_.push(std::move(object));
    return orca::again();
  }

  orca::PushProxy<orca::idl::Odometry> in_{*this, "in"};
  orca::PushServer<orca::idl::Odometry> out_{*this, "out"};
};

}  // namespace

ORCA_COMPONENT(FlowRelay, "test.FlowRelay")
