// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// TaskState, TaskOrder (thesis 11.5). idl/orca/tasks.idl gives the meaning of each field.
#pragma once

#include "orca/idl/generated/tasks.h"
#include "orca/idl/generated/tasks.types.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/time.hpp"
