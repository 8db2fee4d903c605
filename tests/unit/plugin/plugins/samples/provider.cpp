// SPDX-License-Identifier: GPL-3.0-or-later
// A library whose symbols have the version SAMPLE_1. The address of one of them is null.
extern "C" int sample_provided();
extern "C" int sample_provided() { return 1; }

__asm__(
    ".globl sample_null\n"
    ".set sample_null, 0\n");
