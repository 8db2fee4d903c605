// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Robot, Actuator, Drive, Sensor, SonarRing, LaserSensor (thesis 8.3). idl/orca/hardware.idl gives the
/// meaning, unit and frame of each field.
#pragma once

#include "orca/idl/generated/hardware.h"
#include "orca/idl/generated/hardware.types.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"
