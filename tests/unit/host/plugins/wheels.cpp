// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"

namespace {

/// Takes commands as a base does, and says in whose mission it moves and what for: "moves because of goto".
class Wheels final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Outcome work() override { return orca::done(); }

  orca::Status on_command(const orca::ObjectPtr<orca::idl::MotionCommand>& command) {
    const std::string line = "moves because of " + command->cause().origin();
    if (command->kind() == orca::idl::NORMAL && (line != last_ || command->mission() != mission_))
      log_warning(line);
    last_ = line;
    mission_ = command->mission();
    return orca::ok();
  }

  orca::SendServer<orca::idl::MotionCommand> motion_{*this, "motion", &Wheels::on_command};
  std::string last_;
  std::uint64_t mission_ = 0;
};

}  // namespace

ORCA_COMPONENT(Wheels, "test.Wheels")
