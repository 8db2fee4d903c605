// SPDX-License-Identifier: GPL-3.0-or-later
// A library with every kind of symbol that ElfFile tells apart.
#include <cmath>
#include <string>

extern "C" {

__attribute__((weak)) int sample_weak_elsewhere();
__attribute__((weak)) int sample_weak_here();
int sample_weak_here() { return 1; }

extern int sample_variable;
int sample_variable = 7;

double sample_function(const char* text);
double sample_function(const char* text) {
  const int more = sample_weak_elsewhere != nullptr ? sample_weak_elsewhere() : 0;
  return std::cos(std::stod(text)) + more + sample_weak_here() + sample_variable;
}

}  // extern "C"

// In assembler, because not every compiler makes unique symbols.
__asm__(
    ".data\n"
    ".globl sample_unique\n"
    ".type sample_unique, %gnu_unique_object\n"
    ".size sample_unique, 4\n"
    "sample_unique: .long 1\n"
    ".text\n");
