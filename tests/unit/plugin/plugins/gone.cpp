// SPDX-License-Identifier: GPL-3.0-or-later
// A library that will not be found.
int gone();
int gone() { return 1; }
