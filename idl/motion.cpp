// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/motion.hpp"

namespace orca {
namespace {

Loan<idl::MotionCommand> command(idl::MotionKind kind, double weight) {
  Loan<idl::MotionCommand> command = make_object<idl::MotionCommand>();
  command->kind(kind);
  command->weight(weight);
  return command;
}

}  // namespace

Loan<idl::MotionCommand> full_stop() { return command(idl::FULLSTOP, 1.0); }

Loan<idl::MotionCommand> dont_care() { return command(idl::DONTCARE, 0.0); }

Loan<idl::MotionCommand> head(double direction_rad, double speed, double weight) {
  Loan<idl::MotionCommand> wish = command(idl::NORMAL, weight);
  wish->steering(idl::BY_DIRECTION);
  wish->direction(direction_rad);
  wish->speed(speed);
  return wish;
}

Loan<idl::MotionCommand> turn(double rate, double speed, double weight) {
  Loan<idl::MotionCommand> wish = command(idl::NORMAL, weight);
  wish->steering(idl::BY_TURN_RATE);
  wish->turn_rate(rate);
  wish->speed(speed);
  return wish;
}

}  // namespace orca
