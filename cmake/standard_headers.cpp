// SPDX-License-Identifier: LGPL-3.0-or-later
// The source file that a target with a precompiled header needs; see OrcaTargets.cmake.
