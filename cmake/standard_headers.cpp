// SPDX-License-Identifier: LGPL-3.0-or-later
// The source file that a precompiled header needs to hang on; see OrcaTargets.cmake.
