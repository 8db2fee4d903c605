// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a tree or errors, and the two readers agree about what is well-formed.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "orca/xml/document.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orca::xml::Diagnostics diagnostics;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto document = orca::xml::read_text(text, "fuzz.xml", diagnostics);
  if (!document && !diagnostics.has_errors()) std::abort();
  for (const auto& diagnostic : diagnostics.sorted())
    if (diagnostic.code == "G129") std::abort();
  return 0;
}
