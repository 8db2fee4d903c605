// SPDX-License-Identifier: GPL-3.0-or-later
// Any text gives a graph or errors, and a graph that loads is the same after printing.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fake_catalogue.hpp"

namespace {

std::optional<orca::graph::Graph> load(std::string_view text, bool& errors) {
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  auto graph = orca::graph::load_text(text, "/fuzz.xml", {}, catalogue, diagnostics);
  errors = diagnostics.has_errors();
  return graph;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bool errors = false;
  const auto graph = load(std::string_view(reinterpret_cast<const char*>(data), size), errors);
  if (graph.has_value() == errors) std::abort();
  if (!graph) return 0;
  const auto again = load(orca::graph::print(*graph), errors);
  if (!again || !(*again == *graph)) std::abort();
  return 0;
}
