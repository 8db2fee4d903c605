// SPDX-License-Identifier: GPL-3.0-or-later
// A library that needs no other one: it has no versions, no search path and no names of libraries.
extern "C" int sample_bare();
extern "C" int sample_bare() { return 1; }
