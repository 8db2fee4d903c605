// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Ask, ClientList, LogRecord, Alarm. What each field means, its unit and frame, is said in
/// idl/orca/system.idl.
#pragma once

#include "orca/idl/generated/system.h"
#include "orca/idl/generated/system.types.hpp"
#include "orca/idl/object.hpp"
