// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Ask, ClientList, LogRecord, Alarm. idl/orca/system.idl gives the meaning, unit and frame of each field.
#pragma once

#include "orca/idl/generated/system.h"
#include "orca/idl/generated/system.types.hpp"
#include "orca/idl/object.hpp"
