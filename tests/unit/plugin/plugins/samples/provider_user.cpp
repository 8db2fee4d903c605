// SPDX-License-Identifier: GPL-3.0-or-later
// A library that uses a function of another one, which lies in a folder of the search path.
extern "C" int sample_provided();
extern "C" int sample_user();
extern "C" int sample_user() { return sample_provided(); }
