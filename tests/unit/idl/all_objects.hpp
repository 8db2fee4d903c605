// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>

#include "orca/idl/generated/hardware.reflection.hpp"
#include "orca/idl/generated/motion.reflection.hpp"
#include "orca/idl/generated/navigation.reflection.hpp"
#include "orca/idl/generated/sensing.reflection.hpp"
#include "orca/idl/generated/system.reflection.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

namespace orca::test {

/// Every object type; object_type_test.cpp checks that none is missing.
using AllObjects =
    std::tuple<idl::Actuator, idl::Alarm, idl::Arrived, idl::Ask, idl::AskReading, idl::Battery,
               idl::BumperReadings, idl::ClientList, idl::Contact, idl::Door, idl::Drive, idl::FusionReason,
               idl::GoalFailed, idl::GoalPoint, idl::HolonomicVelocity, idl::InfraredRangeReadings,
               idl::LaserRangeReadings, idl::LaserSensor, idl::LogRecord, idl::MotionCommand, idl::Odometry,
               idl::RangeReadings, idl::Robot, idl::RobotPose, idl::Sensor, idl::SonarRangeReadings,
               idl::SonarRing, idl::TurretAngle, idl::TurretCommand>;

}  // namespace orca::test
