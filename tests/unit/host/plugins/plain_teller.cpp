// SPDX-License-Identifier: GPL-3.0-or-later
#include "teller.hpp"

ORCA_COMPONENT(Teller, "test.PlainTeller")
