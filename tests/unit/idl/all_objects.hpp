// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>

#include "orca/idl/estimators.hpp"
#include "orca/idl/generated/estimators.reflection.hpp"
#include "orca/idl/generated/geometry.reflection.hpp"
#include "orca/idl/generated/graph.reflection.hpp"
#include "orca/idl/generated/hardware.reflection.hpp"
#include "orca/idl/generated/machines.reflection.hpp"
#include "orca/idl/generated/motion.reflection.hpp"
#include "orca/idl/generated/moving.reflection.hpp"
#include "orca/idl/generated/navigation.reflection.hpp"
#include "orca/idl/generated/sensing.reflection.hpp"
#include "orca/idl/generated/system.reflection.hpp"
#include "orca/idl/generated/tasks.reflection.hpp"
#include "orca/idl/generated/ways.reflection.hpp"
#include "orca/idl/generated/world.reflection.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/graph.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/machines.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/tasks.hpp"
#include "orca/idl/ways.hpp"
#include "orca/idl/world.hpp"

namespace orca::test {

/// The plain structs that travel on their own.
using TravellingStructs =
    std::tuple<idl::Acceleration, idl::Orientation2D, idl::Orientation3D, idl::Point, idl::Pose2D,
               idl::Pose3D, idl::Position2D, idl::Position3D, idl::Translation, idl::Velocity, idl::WDistance,
               idl::WorldCoordinate3D, idl::WorldCoordinate6DOF>;

/// The object types that have a header themselves.
using HeadedObjects =
    std::tuple<idl::Actuator, idl::Alarm, idl::Arrived, idl::Ask, idl::AskReading, idl::Battery,
               idl::BumperReadings, idl::ClientList, idl::Contact, idl::DeviceStatistics, idl::Door,
               idl::Drive, idl::Estimate, idl::FusionReason, idl::GoalFailed, idl::GoalPoint, idl::Graph,
               idl::GripperCommand, idl::GripperState, idl::HolonomicVelocity, idl::Image,
               idl::InfraredRangeReadings, idl::LaserRangeReadings, idl::LaserSensor, idl::Localization,
               idl::LogRecord, idl::MachineState, idl::MotionCommand, idl::MovingThings, idl::OccupancyGrid,
               idl::Odometry, idl::Path, idl::Progress, idl::RangeReadings, idl::Robot, idl::RobotPose,
               idl::Route, idl::Sensor, idl::SonarRangeReadings, idl::SonarRing, idl::TaskOrder,
               idl::TaskState, idl::TeamObject, idl::Teammate, idl::TeamState, idl::TripOrder, idl::TripState,
               idl::TurretAngle, idl::TurretCommand, idl::WorldChange, idl::WorldPlan, idl::WorldScene>;

template <class... T>
std::tuple<Travelling<T>...> with_headers(std::tuple<T...>);

/// The C++ class of every object type; object_type_test.cpp checks that none is missing.
using AllObjects = decltype(std::tuple_cat(HeadedObjects(), decltype(with_headers(TravellingStructs()))()));

}  // namespace orca::test
