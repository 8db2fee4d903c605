// SPDX-License-Identifier: LGPL-3.0-or-later
#include "demangle.hpp"

#include <cxxabi.h>

#include <cstdlib>

namespace orca::plugin {

std::string demangled(std::string_view symbol) {
  constexpr std::size_t kLongest = 4096;  // the demangler of the C++ library recurses
  std::string name(symbol);
  if (name.size() > kLongest || !name.starts_with("_Z")) return name;
  int status = 0;
  char* const text = abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status);
  if (status == 0) name = text;
  std::free(text);
  return name;
}

}  // namespace orca::plugin
