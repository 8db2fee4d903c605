// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// GoalPoint, Door, Path, OccupancyGrid, Arrived, GoalFailed (thesis 8.3). idl/orca/navigation.idl gives the meaning, unit
/// and frame of each field.
#pragma once

#include "orca/idl/generated/navigation.h"
#include "orca/idl/generated/navigation.types.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"
