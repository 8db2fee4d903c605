// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// GraphNode, GraphEdge, Graph (thesis 8.2: Graph). idl/orca/graph.idl gives the meaning and unit of each field.
#pragma once

#include "orca/idl/generated/graph.h"
#include "orca/idl/generated/graph.types.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"
