// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

/// The one header that a component author includes, besides the objects that the ports carry.

#include "orca/component/component.hpp"
#include "orca/component/manifest.hpp"
#include "orca/component/outcome.hpp"
#include "orca/component/param.hpp"
#include "orca/component/state.hpp"
#include "orca/patterns/push.hpp"
#include "orca/patterns/query.hpp"
#include "orca/patterns/send.hpp"
#include "orca/patterns/synchronizer.hpp"
