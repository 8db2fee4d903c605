// SPDX-License-Identifier: GPL-3.0-or-later
// What an author may have linked to a library of object types.
#include <stdexcept>

namespace {

bool thrown() { throw std::runtime_error("the lamp is broken"); }

[[maybe_unused]] const bool g_thrown = thrown();

}  // namespace
