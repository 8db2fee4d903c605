// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// EstimatedQuantity, Estimate (thesis 8.2: Estimators). idl/orca/estimators.idl gives the meaning and unit of each field.
#pragma once

#include "orca/idl/generated/estimators.h"
#include "orca/idl/generated/estimators.types.hpp"
#include "orca/idl/object.hpp"
