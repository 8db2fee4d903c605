// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/result.hpp"
#include "orca/patterns/endpoint.hpp"

namespace orca {

/// Connects two ports of the same process: objects are handed over as they are, without copy or
/// serialisation.
///
/// @param from    a PushServer, QueryProxy or SendProxy, as in <connect from= to=>.
/// @param to      the other end.
/// @param policy  how the edge buffers, for Push and Send; without it, as the author of the receiving port
/// wants.
/// @errors  invalid_argument if the ends do not fit each other, or if the policy lets a device wait;
/// already_exists if the proxy is taken.
/// @thread  before the components of either end run.
Status connect_locally(Endpoint& from, Endpoint& to, const QueuePolicy& policy);
Status connect_locally(Endpoint& from, Endpoint& to);

}  // namespace orca
