// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

namespace {

/// Takes three commands, says which they were, and is done.
class CommandSink final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto command = motion_.get_update_wait();
    switch (command->kind()) {
      case orca::idl::FULLSTOP: log_info("got a full stop"); break;
      case orca::idl::DONTCARE: log_info("got no opinion"); break;
      default: log_info("got a speed"); break;
    }
    return ++count_ < 3 ? orca::again() : orca::done();
  }

  orca::PushProxy<orca::idl::MotionCommand> motion_{*this, "motion"};
  int count_ = 0;
};

}  // namespace

ORCA_COMPONENT(CommandSink, "test.CommandSink")
