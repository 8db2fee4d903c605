// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

namespace {

/// Answers each object with one of its own, at once. Where none comes for a second, it begins.
class Answerer final : public orca::Component {
 public:
  explicit Answerer(orca::ComponentHost& host) : Component(host) { lap_on("in", std::chrono::seconds(1)); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    if (in_.new_data_arrived()) (void)in_.get_update();
    out_.push(orca::dont_care());
    return orca::again();
  }

  orca::PushProxy<orca::idl::MotionCommand> in_{*this, "in"};
  orca::PushServer<orca::idl::MotionCommand> out_{*this, "out"};
};

}  // namespace

ORCA_COMPONENT(Answerer, "test.Answerer")
