// SPDX-License-Identifier: GPL-3.0-or-later
// The home of the tests' precompiled header (tests/CMakeLists.txt), and what every test program needs to be
// told.
#if defined(__SANITIZE_ADDRESS__)
// Fontconfig keeps what it has read of its configuration until the process ends.
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
#endif
