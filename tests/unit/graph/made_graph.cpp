// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_graph.hpp"

#include <sstream>
#include <stdexcept>

namespace {

std::string repeated(std::size_t count, const std::string& text) {
  std::string result;
  result.reserve(count * text.size());
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

std::string components(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += "<component name='c" + std::to_string(i) + "' type='orca.Localizer'/>\n";
  return text;
}

}  // namespace

std::string made_graph(const std::string& order) {
  std::istringstream words(order);
  std::string what;
  std::size_t count = 0;
  words >> what >> count;
  const std::string start = "<graph name='made'>\n";
  const std::string end = "</graph>\n";
  if (what == "nested") return start + repeated(count, "<component>") + repeated(count, "</component>") + end;
  if (what == "components") return start + components(count) + end;
  if (what == "bytes")
    return start + "<!--" + std::string(count - start.size() - end.size() - 8, ' ') + "-->\n" + end;
  if (what == "elements") return start + repeated(count - 1, "<connect/>") + end;
  if (what == "name")
    return start + "<component name='" + repeated(count, "n") + "' type='orca.Lokalizer'/>\n" + end;
  throw std::invalid_argument("no such order: " + order);
}
