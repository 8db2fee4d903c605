// SPDX-License-Identifier: GPL-3.0-or-later
// The source file of the tests' precompiled header (tests/CMakeLists.txt), and the settings that every test
// program needs.
#if defined(__SANITIZE_ADDRESS__)
// Fontconfig keeps its configuration in memory until the process ends.
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
#endif
