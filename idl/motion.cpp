// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/motion.hpp"

#include <cmath>
#include <string>
#include <utility>

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

Loan<idl::HolonomicVelocity> slide(double speed, double left, double rate, double weight) {
  Loan<idl::HolonomicVelocity> wish = make_object<idl::HolonomicVelocity>();
  wish->kind(idl::NORMAL);
  wish->weight(weight);
  wish->steering(idl::BY_TURN_RATE);
  wish->turn_rate(rate);
  wish->speed(speed);
  wish->left(left);
  return wish;
}

double sideways_speed(const ObjectPtr<idl::MotionCommand>& command) {
  const auto velocity = command.as<idl::HolonomicVelocity>();
  return velocity && velocity->kind() == idl::NORMAL ? velocity->left() : 0.0;
}

Status check_command(const ObjectPtr<idl::MotionCommand>& command) {
  const auto velocity = command.as<idl::HolonomicVelocity>();
  return velocity ? check_command(*velocity) : check_command(*command);
}

Status check_command(const idl::MotionCommand& command) {
  if (command.kind() == idl::FULLSTOP) return ok();
  const std::pair<const char*, double> numbers[] = {{"speed", command.speed()},
                                                    {"direction", command.direction()},
                                                    {"turn rate", command.turn_rate()},
                                                    {"weight", command.weight()}};
  for (const auto& [name, number] : numbers)
    if (!std::isfinite(number))
      return fail(Code::invalid_argument, "a motion command's " + std::string(name) + " is " +
                                              std::to_string(number) + "; expected a finite number");
  if (command.weight() >= 0.0) return ok();
  return fail(Code::invalid_argument, "a motion command's weight is negative");
}

Status check_command(const idl::HolonomicVelocity& velocity) {
  const idl::MotionCommand& command = velocity;
  if (Status sound = check_command(command); !sound.ok()) return sound;
  if (velocity.kind() == idl::FULLSTOP || std::isfinite(velocity.left())) return ok();
  return fail(Code::invalid_argument, "a holonomic velocity's sideways speed is not a finite number");
}

Status check_command(const idl::TurretCommand& turret) {
  if (std::isfinite(turret.angle())) return ok();
  return fail(Code::invalid_argument, "a turret's angle must be finite");
}

Status check_command(const idl::GripperCommand& gripper) {
  if (gripper.paddles() <= idl::PADDLES_CLOSE && gripper.lift() <= idl::LIFT_DOWN) return ok();
  return fail(Code::invalid_argument, "a gripper's command holds a motion that there is not");
}

}  // namespace orca
