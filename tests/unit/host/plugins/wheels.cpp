// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

namespace {

/// Takes commands as a base does, and says in whose mission it moves and what for: "moves because of goto". Wheels that are held refuse them.
class Wheels final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Outcome work() override { return orca::done(); }

  orca::Status on_command(const orca::ObjectPtr<orca::idl::MotionCommand>& command) {
    if (*held_) return orca::fail(orca::Code::unavailable, "the wheels are held");
    const std::string line = "moves because of " + command->cause().origin();
    if (command->kind() == orca::idl::NORMAL && (line != last_ || command->mission() != mission_))
      log_warning(line);
    last_ = line;
    mission_ = command->mission();
    return orca::ok();
  }

  orca::SendServer<orca::idl::MotionCommand> motion_{*this, "motion", &Wheels::on_command};
  orca::Param<bool> held_{*this, "held", false};
  std::string last_;
  std::uint64_t mission_ = 0;
};

}  // namespace

ORCA_COMPONENT(Wheels, "test.Wheels")
