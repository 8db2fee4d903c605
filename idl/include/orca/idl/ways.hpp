// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Route. idl/orca/ways.idl gives the meaning of each field.
#pragma once

#include "orca/idl/generated/ways.h"
#include "orca/idl/generated/ways.types.hpp"
#include "orca/idl/object.hpp"
