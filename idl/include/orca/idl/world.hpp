// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// WorldPlan, WorldScene, WorldChange. idl/orca/world.idl gives the meaning, unit and frame of each field.
#pragma once

#include "orca/idl/generated/world.h"
#include "orca/idl/generated/world.types.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"
