// SPDX-License-Identifier: GPL-3.0-or-later
// A library that needs two functions that are nowhere, and one that it can do without.
namespace orca::test {
int nowhere(int value);
}

extern "C" {

int sample_nowhere();
__attribute__((weak)) int sample_perhaps();
int sample_needy();
int sample_needy() {
  return orca::test::nowhere(sample_nowhere()) + (sample_perhaps != nullptr ? sample_perhaps() : 0);
}

}  // extern "C"
