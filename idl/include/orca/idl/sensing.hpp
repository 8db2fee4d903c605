// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// RobotPose, Odometry, TurretAngle, GripperState, RangeReadings, SonarRangeReadings, LaserRangeReadings (thesis 8.3),
/// InfraredRangeReadings, BumperReadings, Contact, Battery. idl/orca/sensing.idl gives the meaning, unit and frame of
/// each field.
#pragma once

#include "orca/idl/generated/sensing.h"
#include "orca/idl/generated/sensing.types.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"
