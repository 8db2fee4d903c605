// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

namespace {

using namespace std::chrono_literals;

/// A client that behaves in the manner that it is given: good, exit, kill, stop (each after a second of its life), deaf
/// (subscribes and never reads), hoard (keeps all images), push_flood or send_flood (2 kHz).
class Pest final : public orca::Component {
 public:
  explicit Pest(orca::ComponentHost& host) : Component(host) { lap_every(100ms); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    if (manner_->ends_with("_flood")) {
      flood();
    } else {
      out_.push(orca::dont_care());
    }
    if (*manner_ != "deaf") take();
    if (++laps_ == 10) vanish();
    return orca::again();
  }

  void take() {
    if (in_.new_data_arrived()) (void)in_.get_update();
    while (images_.new_data_arrived()) {
      const auto image = images_.get_update();
      if (*manner_ == "hoard") kept_.push_back(image);
    }
  }

  void flood() {
    for (int i = 0; i < 200; ++i) {
      if (*manner_ == "push_flood") out_.push(orca::dont_care());
      if (*manner_ == "send_flood") (void)sends_.send(sends_.loan());
      sleep(500us);
    }
  }

  void vanish() const {
    if (*manner_ == "exit") std::exit(0);
    if (*manner_ == "kill") (void)std::raise(SIGKILL);
    if (*manner_ == "stop") (void)std::raise(SIGSTOP);
  }

  orca::PushProxy<orca::idl::Odometry> in_{*this, "in"};
  orca::PushProxy<orca::idl::Image> images_{*this, "images", {.text = "Pictures.", .optional = true}};
  orca::PushServer<orca::idl::MotionCommand> out_{*this, "out"};
  orca::SendProxy<orca::idl::TurretCommand> sends_{*this, "sends"};
  orca::Param<std::string> manner_{*this, "manner", "good"};
  std::vector<orca::ObjectPtr<orca::idl::Image>> kept_;
  int laps_ = 0;
};

}  // namespace

ORCA_COMPONENT(Pest, "test.Pest")
