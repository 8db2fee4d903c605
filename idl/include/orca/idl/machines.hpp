// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// MachineState. idl/orca/machines.idl gives the meaning of each field.
#pragma once

#include "orca/idl/generated/machines.h"
#include "orca/idl/generated/machines.types.hpp"
#include "orca/idl/object.hpp"
