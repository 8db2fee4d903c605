// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::batch {

/// Changes what a run must not depend on, so that a second run shows whether it does.

/// Changes the environment of this process: where its home is, its time zone, the user's name and the size of the whole, which
/// moves the stack. Variables that the dynamic linker, sanitizers and Orca's tests read stay.
/// @pre  this process is a copy that is about to start another program.
void change_environment();

/// Makes the next blocks of memory come in another order, at other addresses, and filled with another pattern.
/// @thread  while there is no other.
void scramble_heap();

}  // namespace orca::batch
