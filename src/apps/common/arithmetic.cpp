// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "arithmetic.hpp"

#include <sys/auxv.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

#if defined(__x86_64__) && __has_include(<sys/platform/x86.h>)
#if defined(__clang__)
#define _Bool bool  // the header says it, and clang knows it in C only
#endif
#include <sys/platform/x86.h>
#undef _Bool
#endif

namespace orca::apps {
namespace {

constexpr const char* kTunables = "GLIBC_TUNABLES";
// Set during the new start, so that there is no second one if the C library ignores the tunables.
constexpr const char* kMark = "ORCA_PORTABLE_ARITHMETIC";
constexpr const char* kHwcaps = "glibc.cpu.hwcaps=";

bool library_fuses() {
#if defined(CPU_FEATURE_ACTIVE)
  return CPU_FEATURE_ACTIVE(FMA) || CPU_FEATURE_ACTIVE(FMA4);
#else
  return false;
#endif
}

std::string value_of(const char* variable) {
  const char* const value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

void restore(const std::string& tunables) {
  tunables.empty() ? unsetenv(kTunables) : setenv(kTunables, tunables.c_str(), 1);
}

}  // namespace

std::string with_portable_arithmetic(const std::string& tunables) {
  std::string hwcaps = kHwcaps;
  std::string others;
  std::istringstream entries(tunables);
  for (std::string entry; std::getline(entries, entry, ':');) {
    if (entry.starts_with(kHwcaps)) {
      hwcaps = entry + ",";  // the last one counts
    } else {
      others += entry + ":";
    }
  }
  return others + hwcaps + "-FMA,-FMA4";
}

void choose_portable_arithmetic(char** arguments) {
  if (getenv(kMark) != nullptr) {
    unsetenv(kMark);
    return;
  }
  // A program with more rights than its user (AT_SECURE) gets no tunables.
  if (!library_fuses() || getauxval(AT_SECURE) != 0) return;
  const std::string before = value_of(kTunables);
  setenv(kTunables, with_portable_arithmetic(before).c_str(), 1);
  setenv(kMark, "1", 1);
  // The path by which the system has just started the program; it needs no /proc.
  execv(reinterpret_cast<const char*>(getauxval(AT_EXECFN)), arguments);
  restore(before);
  unsetenv(kMark);
}

}  // namespace orca::apps
